"""Gains of a first try for the cascade controller, and how fine a step of the integration must be."""

from __future__ import annotations

from typing import Any

import numpy as np

from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from identification.arrays import Array
from identification.drive_train import coupling

#: Largest phase [rad] of the fastest mode that one step of order 4 is trusted with.
_PHASE = 0.3


def value_of(module: Any, model: Any, name: str) -> float:
    """The value of a parameter, 0 where the model has none of that name."""
    return float(model.parameters[module.PARAMETERS.index(name)]) if name in module.PARAMETERS else 0.0


def inertias(module: Any, model: Any, robot: Robot, pose: Array, flexible: bool) -> tuple[Array, Array]:
    """Inertias (n each) at a pose behind each motor at its joint [kg m2, kg]: of the links, of elastic drive trains.

    Raises InputError where the parameters leave a motor without inertia.
    """
    links = np.diag(model.inertia_matrix(pose)).copy()
    motors = np.zeros(len(links))
    if flexible:
        motors = np.array([value_of(module, model, f"Iam{joint.number}") for joint in robot.moving])
    for joint, link, motor in zip(robot.moving, links, motors, strict=True):
        elastic = flexible and joint.number in robot.flexible
        if not link > 0 or (elastic and not motor > 0):
            problem = f"the parameters leave joint {joint.number} {'or its motor ' if elastic else ''}without inertia"
            raise InputError(command_line("--parameters"), problem, "a physically consistent set")
    return links, motors


def weight(module: Any, model: Any, robot: Robot, pose: Array, flexible: bool) -> tuple[Array, Array]:
    """Torques at rest (n each) [N m, N] at a pose: of the links, and of the motors that hold them, offsets included."""
    still = np.zeros(len(pose))
    links: Array = model.inverse_dynamics(pose, still, still)
    offsets = [value_of(module, model, f"Offm{joint.number}") if flexible else 0.0 for joint in robot.moving]
    return links, links + np.array(offsets)


def controller(
    module: Any, model: Any, robot: Robot, inertia: Array, load: Array, bandwidth: float, period: float, limit: Array
) -> Any:
    """The cascade for motors that each move an ``inertia`` (n) at their joints, with speed loops of ``bandwidth`` [Hz].

    Its integrals hold a ``load`` (n) [N m, N] at the joints. ``limit`` (n) is the rotors' largest torque [N m, N].
    """
    w = 2 * np.pi * bandwidth
    N = coupling(robot)
    kv = w * inertia / np.diag(N) ** 2
    result = module.Controller(model, period, w / 3, kv, w / 3, limit)
    result.z[:] = np.linalg.solve(N.T, load) / kv
    return result


def steps(module: Any, model: Any, robot: Robot, links: Array, motors: Array, period: float) -> int:
    """Steps of the integration in a ``period`` [s], by frequencies sqrt(k (1/Iam + 1/M)) of the elastic drive trains.

    ``links`` and ``motors`` (n each) [kg m2, kg] are M and Iam.

    Raises InputError where an elastic joint has no stiffness.
    """
    fastest = 0.0
    for joint, link, motor in zip(robot.moving, links, motors, strict=True):
        if joint.number not in robot.flexible or not motor:
            continue
        stiffness = value_of(module, model, f"k{joint.number}")
        if not stiffness > 0:
            problem = f"k{joint.number} is {stiffness:g}"
            raise InputError(command_line("--parameters"), problem, "stiffness of every elastic joint")
        fastest = max(fastest, float(np.sqrt(stiffness * (1 / motor + 1 / link))))
    return max(1, int(np.ceil(fastest * period / _PHASE)))
