"""A rotor of a wrist that turns with a sum of joints: its inertia couples them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    along = effect.along(machine.robot)
    machine.rotor += effect.amount(machine.robot) * np.outer(along, along)


LAW = Law(
    about="inertia of a coupled rotor",
    unit="kg m2",
    typical=lambda robot, j: 0.4 * robot.chain[j].rotor,
    change=_change,
    of_rotor=True,
)
