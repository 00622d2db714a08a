"""A gear whose true ratio is 1 + size of the one that position and torque are converted with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    machine.encoder_scale[effect.joint - 1] *= 1 + effect.amount(machine.robot)


LAW = Law(
    about="wrong gear ratio",
    unit="1",
    typical=0.01,
    change=_change,
)
