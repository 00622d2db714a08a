"""How generation grows with the number of joints, from the rows of the study ``growth``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks.loglog import loglog

#: How a random chain's name ends, and the columns of the curves.
ENDING, CURVES = " joints", {"derivation": "derive [s]", "with all backends": "all [s]"}


def growth(rows: Sequence[Mapping[str, Any]]) -> str:
    """The seconds over the number of joints of the random chains, with a line that grows quadratically."""
    grown = [row for row in rows if str(row["chain"]).endswith(ENDING)]
    joints = [int(str(row["chain"]).removesuffix(ENDING)) for row in grown]
    curves = {name: [float(row[column]) for row in grown] for name, column in CURVES.items()}
    return f"{loglog('Generation time', 'joints', 'seconds', joints, curves, {'quadratic': 2.0})}\n"
