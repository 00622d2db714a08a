"""A motor whose torque constant falls with the winding's heat: a first-order winding, heated by the square of the
current.

size is the part of the constant that is lost at the rated current for ever.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    j, robot = effect.joint - 1, machine.robot
    machine.heat_drop[j] = effect.amount(robot)
    machine.heat_time[j] = effect.value("time", robot)
    machine.heat_current[j] = effect.value("rated", robot)
    machine.heat[j] = effect.value("start", robot)


LAW = Law(
    about="drift of the torque constant",
    unit="1",
    typical=0.3,
    largest=0.9,
    values={"time": 60.0, "rated": lambda robot, j: 0.3 * robot.chain[j].peak, "start": 0.0},
    change=_change,
)
