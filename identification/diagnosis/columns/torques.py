"""What a hypothesis makes along runs: the rows of the joints on which it acts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene

#: Part of a column's largest value on any joint below which it is zero on a joint.
_NOTHING = 1e-9
#: Part of the largest torque that is none, per unit of a coefficient.
_ROUNDING = 1e-12
#: Torque per unit from which a motion has run away.
_ENDLESS = 1e30


@dataclass(frozen=True)
class Torques:
    """The ``coordinates`` on which a hypothesis with k coefficients acts, none where it makes no torque,
    and of each run each one's ``rows`` (k x N) [N m, N per unit].
    """

    coordinates: tuple[int, ...] = ()
    rows: tuple[tuple[Array, ...], ...] = ()


def torques(
    hypothesis: Hypothesis, shape: Mapping[str, float], runs: Sequence[Prepared], scenes: Sequence[Scene]
) -> Torques | None:
    """Of a hypothesis with a shape along ``runs``, whose ``scenes`` are in the same order; None where that is
    impossible along one.
    """
    per_run = []
    for scene in scenes:
        columns = made(hypothesis, scene, shape)
        if columns is None:
            return None
        per_run.append(columns)
    largest = max(np.abs(columns).max(initial=0.0) for columns in per_run)
    if largest <= _ROUNDING * max(float(np.abs(run.tau).max(initial=0.0)) for run in runs):
        return Torques()
    most = np.max([np.abs(columns).max(axis=(0, 2), initial=0.0) for columns in per_run], axis=0)
    joints = tuple(np.flatnonzero(most > _NOTHING * largest).tolist())
    rows = [tuple(run.decimated(columns[:, j]) for j in joints) for run, columns in zip(runs, per_run, strict=True)]
    return Torques(joints, tuple(rows))


def made(hypothesis: Hypothesis, scene: Scene, shape: Mapping[str, float]) -> Array | None:
    """Columns (k x n x N) of a hypothesis with a shape along a scene; None where the motion makes that impossible."""
    # It shows in numbers that are not finite.
    with np.errstate(all="ignore"):
        columns = hypothesis.columns(scene, shape)
    return columns if np.all(np.abs(columns) < _ENDLESS) else None
