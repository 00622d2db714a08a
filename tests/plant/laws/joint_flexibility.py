"""An elastic drive train with states of its own: motor and link between a linear spring, lightly damped. size is its
compliance.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    machine.make_elastic(
        effect.joint - 1, 1 / effect.amount(machine.robot), effect.value("damping_ratio", machine.robot)
    )


LAW = Law(
    about="joint flexibility",
    unit="rad/(N m)",
    typical=lambda robot, j: 1 / robot.chain[j].stiffness,
    values={"damping_ratio": 0.02},
    change=_change,
)
