"""From the residual of the model as it was down to the noise, finding by finding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from identification.diagnosis.evidence import columns_of
from identification.diagnosis.loop import Search
from identification.diagnosis.testing import Testing


@dataclass(frozen=True)
class Steps:
    """Findings ``named`` in words, what explains most first, and the rms of the white residual before them and with one
    after the other (``sizes``, one more), all joints together: 1 is noise alone. Parameters are fitted anew each time.

    ``tested`` tells whether it is that of runs which are not fitted.
    """

    named: tuple[str, ...]
    sizes: tuple[float, ...]
    tested: bool


def steps(found: Search, testing: Testing | None) -> Steps:
    """Of the runs that test, or where there are none of those that are fitted and validate."""
    ranked = sorted(found.choices, key=lambda one: -one.evidence.drop)
    variants = [one.evidence.variant for one in ranked]
    every = found.weighing.all
    squares, rows = [], every.rows
    for count in range(len(variants) + 1):
        some = variants[:count]
        if testing is None:
            squares.append(every.misfit(columns_of(some), every.solution(columns_of(some))[0]))
        else:
            squares.append(float(np.sum(testing.left(testing.fitted(some)[0]) ** 2)))
            rows = len(testing.torque)
    sizes = tuple(np.sqrt(np.array(squares) / max(rows, 1)).tolist())
    return Steps(tuple(one.hypothesis.named for one in variants), sizes, testing is not None)
