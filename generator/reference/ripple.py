"""Torques that repeat with a turning part, and the work against them from position zero."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from generator.reference.arithmetic import cosine, sine
from generator.reference.law import At, Columns, Law


def _law(stem: str, along: Literal["joint", "motor"]) -> Law:
    def torque(at: At) -> Columns:
        slope = at.shape["order"] * at.ratio
        return cosine(slope * at.q), sine(slope * at.q)

    def potential(at: At) -> Columns:
        slope = at.shape["order"] * at.ratio
        return sine(slope * at.q) / slope, (1 - cosine(slope * at.q)) / slope

    return Law((f"{stem}c", f"{stem}s"), torque, potential=potential, along=along)


#: By the effects' ids.
LAWS: Mapping[str, Law] = {
    "motor_ripple": _law("Rm", along="motor"),
    "wave_generator_ripple": _law("Rw", along="motor"),
    "cycloid_ripple": _law("Ry", along="joint"),
}
