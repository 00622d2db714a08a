"""A finding that a test writes down."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis
from identification.diagnosis.verdict.finding import Finding
from identification.outcome import Value


def finding(effect: str, kind: str, std: float) -> Finding:
    """On joint 2, whose torque reaches joint 1."""
    hypothesis = Hypothesis(
        effect, effect, 2, (Coefficient("c", "rad"),), lambda scene, shape: np.zeros((1, 2, 1)), kind=kind
    )
    evidence: Any = SimpleNamespace(score=100.0, size=5.0)
    return Finding(
        hypothesis=hypothesis,
        joints=(2,),
        shape={},
        parameters={"c": Value(1e-3, std, "rad")},
        evidence=evidence,
        alternatives=(),
        amplitude={1: 0.2, 2: 3.0},
        shape_std={},
    )
