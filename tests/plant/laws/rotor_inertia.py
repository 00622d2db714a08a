"""More inertia of a rotor than the drive's data sheet has, on the joint side."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    j = effect.joint - 1
    machine.rotor[j, j] += effect.amount(machine.robot)


LAW = Law(
    about="rotor inertia",
    unit="kg m2",
    typical=lambda robot, j: 0.2 * robot.chain[j].rotor,
    change=_change,
)
