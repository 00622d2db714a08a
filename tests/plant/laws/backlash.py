"""Play in an elastic drive train: half of size to either side without any torque.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    j = effect.joint - 1
    if not machine.flexible[j]:
        stiffness = machine.robot.chain[j].stiffness * effect.value("stiffer", machine.robot)
        machine.make_elastic(j, stiffness, effect.value("damping_ratio", machine.robot))
    machine.gap[j] += effect.amount(machine.robot) / 2


LAW = Law(
    about="backlash",
    unit="rad",
    typical=4e-4,
    values={"stiffer": 10.0, "damping_ratio": 0.1},
    change=_change,
)
