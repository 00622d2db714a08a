"""Play in an elastic drive train: half of size to either side without any torque.

Where nothing else makes the drive train elastic, its compliance is in proportion to the play: a tenth of the robot's
at the typical play, so that both vanish together.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine

_TYPICAL = 4e-4


def _change(machine: Machine, effect: Effect) -> None:
    j = effect.joint - 1
    if not machine.flexible[j]:
        stiffer = effect.value("stiffer", machine.robot) * _TYPICAL / effect.amount(machine.robot)
        stiffness = machine.robot.chain[j].stiffness * stiffer
        machine.make_elastic(j, stiffness, effect.value("damping_ratio", machine.robot))
    machine.gap[j] += effect.amount(machine.robot) / 2


LAW = Law(
    about="backlash",
    unit="rad",
    typical=_TYPICAL,
    values={"stiffer": 10.0, "damping_ratio": 0.1},
    change=_change,
)
