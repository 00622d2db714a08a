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
from scipy.linalg import solve_banded

from generator.symbolic.model import Model
from identification.diagnosis.perturbation import change_of, sensitivity
from identification.diagnosis.scene import Scene
from identification.observation import Motion

Array = NDArray[np.float64]

#: Part of a base parameter that is the rotor's inertia where nothing tells how much of it is.
_SHARE = 0.5


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

    @cached_property
    def inertia(self) -> Array:
        """Of the links about the joint (N) [kg m2, kg]."""
        motion = self.scene.motion
        quicker = motion.qdd.copy()
        quicker[self.k] += 1.0
        result: Array = self.torque_on(Motion(motion.q, motion.qd, quicker))[self.k] - self.load
        return result

    def deflection(self, stiffness: float, damping: float) -> Motion:
        """How the joint's link moves against the motor on an elastic drive train, M e'' + d e' + k e = -tau_link(q).

        ``stiffness`` is k [N m/rad, N/m], ``damping`` the ratio d / (2 sqrt(k M)) of the link on it, the motor held. To
        the first order in 1/k e is -tau_link/k, but that holds far below the resonance alone.
        """
        M, h = self.inertia, self.scene.period
        d = 2 * damping * np.sqrt(stiffness * M)
        # Central differences forward in time, from the link at rest on its spring.
        ahead, here, before = M / h**2 + d / (2 * h), stiffness - 2 * M / h**2, M / h**2 - d / (2 * h)
        bands, force = np.zeros((3, len(M))), np.zeros(len(M))
        bands[0, 2:], bands[1, 1:-1], bands[2, :-2] = ahead[1:-1], here[1:-1], before[1:-1]
        bands[0, :2], force[:2] = stiffness, -self.load[:2]
        bands[1, 0] = 0.0
        force[2:] = -self.load[1:-1]
        e: Array = solve_banded((2, 0), bands, force)
        change = change_of(self.scene, self.k, e)
        change.qdd[self.k] = -(self.load + d * change.qd[self.k] + stiffness * e) / M
        return change

    def torque_per(self, deflection: Motion) -> Array:
        """Change of the motors' torques (n x N) per unit of a change of the link's motion against the motor's."""
        return sensitivity(self.torque_on, self.scene.motion, deflection)


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


def rotor_inertia(scene: Scene, k: int) -> float:
    """Inertia of the joint's drive train [kg m2, kg]: as the fit or a parameter set of the robot's file has it, else
    half of the base parameter that it is grouped in, 0 where the model has none.
    """
    model = scene.regressors.model
    name = f"Ia{model.robot.moving[k].number}"
    if name in scene.values:
        return scene.values[name]
    for one in model.robot.parameter_sets.values():
        if name in one.values:
            return one.values[name].value
    for title, terms in model.grouping.numeric().items():
        if name in terms:
            return max(_SHARE * scene.values.get(title, 0.0) / terms[name], 0.0)
    return 0.0


def _of_motor(model: Model, number: int) -> frozenset[str]:
    """Parameters whose torque turns with the motor of a joint, or with another joint's that turns with it."""
    names: set[str] = set()
    for instance in model.effects:
        columns = instance.columns()
        if not instance.effect.on_link and any(number in column for column in columns):
            names |= set(instance.names)
    return frozenset(names)
