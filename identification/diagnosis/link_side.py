"""The robot on the link side of one joint's drive train, where the log has the motor's motion.

With q_l = q + e the link's position and q the motor's over the gear, what the motor must supply changes by
(dtau_link/dq) e + (dtau_link/dqd) e' + (dtau_link/dqdd) e'' (report eq. 7, 8). The drive train's own inertia and friction
turn with the motor and do not see e.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from generator.symbolic.model import Model
from identification.diagnosis.hypothesis import ShapeRange
from identification.diagnosis.perturbation import change_of, sensitivity
from identification.diagnosis.scene import Scene
from identification.observation import Motion

Array = NDArray[np.float64]

#: Parts of a base parameter that are tried for a rotor's inertia that is grouped in it.
_SHARES = (0.1, 0.9)


@dataclass(frozen=True)
class LinkSide:
    """Past the drive train of coordinate ``k``, whose inertia on the joint side is ``rotor`` [kg m2, kg]."""

    scene: Scene
    k: int
    rotor: float

    @cached_property
    def values(self) -> dict[str, float]:
        """Base parameters without what turns with the motor."""
        return without_drive_train(self.scene, self.k, self.rotor)

    def torque_on(self, motion: Motion) -> Array:
        """Torques (n x N) of all but the joint's drive train."""
        return self.scene.regressors.torques(self.values, motion)

    @cached_property
    def load(self) -> Array:
        """What the drive train transmits (N) [N m, N]."""
        result: Array = self.torque_on(self.scene.motion)[self.k]
        return result

    def torque_per(self, deflection: Array) -> Array:
        """Change of the motors' torques (n x N) per unit of a deflection q_l - q (N) [rad, m]."""
        return sensitivity(self.torque_on, self.scene.motion, change_of(self.scene, self.k, deflection))


def without_drive_train(scene: Scene, k: int, rotor: float) -> dict[str, float]:
    """The scene's values with those of the joint's own drive-train effects taken out, ``rotor`` from where it is
    grouped.
    """
    model = scene.regressors.model
    own = _of_motor(model, model.robot.moving[k].number)
    inertia = f"Ia{model.robot.moving[k].number}"
    result = dict(scene.values)
    for name, terms in model.grouping.numeric().items():
        if set(terms) <= own:
            result[name] = 0.0
        elif inertia in own & set(terms):
            result[name] = result.get(name, 0.0) - terms[inertia] * rotor
    return result


def rotor_inertia(scene: Scene, k: int) -> float | ShapeRange | None:
    """Inertia of the joint's drive train [kg m2, kg]: as the robot's file or the fit has it, else what to search in.

    None where the base parameter that holds it has no positive value, so that nothing can be said.
    """
    model = scene.regressors.model
    joint = model.robot.moving[k]
    name = f"Ia{joint.number}"
    if name in scene.values:
        return scene.values[name]
    for one in model.robot.parameter_sets.values():
        if name in one.values:
            return one.values[name].value
    for title, terms in model.grouping.numeric().items():
        if name in terms:
            whole = scene.values.get(title, 0.0) / terms[name]
            unit = "kg m2" if joint.sigma == 0 else "kg"
            return ShapeRange("Iam", unit, *(share * whole for share in _SHARES), 4, log=False) if whole > 0 else None
    return 0.0


def _of_motor(model: Model, number: int) -> frozenset[str]:
    """Parameters whose torque turns with the motor of a joint, or with another joint's that turns with it."""
    names: set[str] = set()
    for instance in model.effects:
        columns = instance.columns()
        if not instance.effect.on_link and any(number in column for column in columns):
            names |= set(instance.names)
    return frozenset(names)
