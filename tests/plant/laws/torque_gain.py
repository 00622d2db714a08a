"""A motor that gives 1 + size of the torque that its constant promises."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    machine.gain[effect.joint - 1] += effect.amount(machine.robot)


LAW = Law(
    about="torque-gain error",
    unit="1",
    typical=-0.06,
    change=_change,
)
