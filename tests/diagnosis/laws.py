"""Laws of effects as the search knows them, without columns."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

from identification.diagnosis.columns.hypothesis import EFFECT
from identification.outcome import Value


def variant(
    effect: str,
    joints: tuple[int, ...],
    variable: str = "qd",
    preset: Mapping[str, Value] | None = None,
    joint: int | None = None,
    kind: str = EFFECT,
) -> Any:
    joint = joints[0] + 1 if joint is None else joint
    hypothesis = SimpleNamespace(
        effect=effect,
        joint=joint,
        kind=kind,
        stated=False,
        variable=variable,
        preset=preset or {},
        beyond=(),
        shapes=(),
    )
    return SimpleNamespace(hypothesis=hypothesis, coordinates=joints, coefficients=(), used=(), key=(effect, joint))
