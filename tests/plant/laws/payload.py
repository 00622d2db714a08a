"""A body in the tool's frame: size is its mass, off the axis, with a solid body's inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    robot = machine.robot
    centre = np.array([effect.value(axis, robot) for axis in ("x", "y", "z")]) + np.array([0.0, 0.0, robot.tool])
    machine.add_body(effect.amount(robot), centre, effect.value("radius", robot))


LAW = Law(
    about="payload",
    unit="kg",
    typical=lambda robot, j: 0.3 * robot.chain[-1].body[9] + 0.1 * robot.chain[-2].body[9],
    values={"x": 0.04, "y": -0.02, "z": 0.05, "radius": 0.06},
    change=_change,
)
