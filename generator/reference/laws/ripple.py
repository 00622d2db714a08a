"""Torques that repeat with a turning part, and the work against them from position zero."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import Literal

from generator.reference.arithmetic import cosine, sine
from generator.reference.law import At, Columns, Law, Values


def _law(stem: str, along: Literal["joint", "motor"], defaults: Values) -> Law:
    stems = f"{stem}c", f"{stem}s", f"{stem}2c", f"{stem}2s"

    def torque(at: At) -> Columns:
        phase = at.shape["order"] * at.ratio * at.q
        return cosine(phase), sine(phase), cosine(2 * phase), sine(2 * phase)

    def potential(at: At) -> Columns:
        slope = at.shape["order"] * at.ratio
        phase = slope * at.q
        first = sine(phase) / slope, (1 - cosine(phase)) / slope
        return *first, sine(2 * phase) / (2 * slope), (1 - cosine(2 * phase)) / (2 * slope)

    ranges = dict.fromkeys(stems, (-3.0, 3.0))
    return Law(stems, torque, potential=potential, along=along, loads=True, ranges=ranges, defaults=defaults)


#: By the effects' ids.
LAWS: Mapping[str, Law] = {
    "motor_ripple": _law("Rm", "motor", {"order": Decimal(1)}),
    "wave_generator_ripple": _law("Rw", "motor", {"order": Decimal(2)}),
    "cycloid_ripple": _law("Ry", "joint", {}),
}
