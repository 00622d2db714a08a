"""How much of the inertia about a joint turns with its motor, before the drive train gives way."""

from __future__ import annotations

import numpy as np

from generator.robot.description import Robot
from identification.diagnosis.runs.perturbation import quicker
from identification.diagnosis.runs.scene import Scene

#: Part of an inertia that is the rotor's where nothing tells how much of it is.
_SHARE = 0.5


def rotor_is_apart(scene: Scene, k: int) -> bool:
    """Whether the inertia of the joint's drive train is a base parameter by itself, which the runs tell, or was found
    as an effect of its own.
    """
    name = f"Ia{scene.robot.moving[k].number}"
    return name in scene.values or bool(scene.found(name))


def rotor_is_told(scene: Scene, k: int) -> bool:
    """Whether the fit or a parameter set of the robot's file has the inertia of the joint's drive train."""
    return _told_rotor(scene, k) is not None


def rotor_inertia(scene: Scene, k: int) -> float:
    """Inertia of the joint's drive train [kg m2, kg]: as the fit or a parameter set of the robot's file has it, else
    half of the least inertia about the joint along the run, 0 where the model would have it apart and has none.

    The base parameters that hold it tell no more: what else is grouped there may be more, or less than nothing.
    """
    if (known := _told_rotor(scene, k)) is not None:
        return known
    return usual_rotor(scene, k) if scene.regressors.rotors[k] else 0.0


def usual_rotor(scene: Scene, k: int) -> float:
    """Half of the least inertia about joint ``k`` along the run, of links and what is told of the drive train
    [kg m2, kg]; not less than 0.
    """
    still, quick = (scene.torque_of(scene.values, one) for one in (scene.motion, quicker(scene.motion, k)))
    return max(_SHARE * float(np.min((quick - still)[k])), 0.0)


def _told_rotor(scene: Scene, k: int) -> float | None:
    robot = scene.robot
    number = robot.moving[k].number
    if rotor_is_apart(scene, k):
        return scene.values.get(f"Ia{number}", scene.found(f"Ia{number}"))
    return told(robot, f"Ia{number}", f"Iam{number}")


def told(robot: Robot, *names: str) -> float | None:
    """What the first parameter set of the robot's file says that has one of the ``names``; None where none has."""
    values = (one.values[name].value for one in robot.parameter_sets.values() for name in names if name in one.values)
    return next(values, None)
