"""An encoder that reads size too much."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    machine.encoder_offset[effect.joint - 1] += effect.amount(machine.robot)


LAW = Law(
    about="encoder offset",
    unit="rad",
    typical=0.01,
    change=_change,
)
