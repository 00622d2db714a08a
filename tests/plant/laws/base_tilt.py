"""A base that leans by size about a horizontal line, against what the robot's file says."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    angle = effect.value("towards", machine.robot)
    machine.lean(effect.amount(machine.robot), angle)


LAW = Law(
    about="base tilt",
    unit="rad",
    typical=0.02,
    values={"towards": 0.6},
    change=_change,
)
