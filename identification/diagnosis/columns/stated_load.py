"""Friction by load that the robot's file states, under the loads that the diagnosis knows.

The generated regressor makes them of the bodies in the file alone; a payload, or what was found, loads the drives too.
"""

from __future__ import annotations

import numpy as np
import sympy

from identification.arrays import Array
from identification.diagnosis.runs.scene import Scene


def columns(scene: Scene) -> dict[str, Array]:
    """Torques (N) [N m, N] per unit of each parameter that reads a load, by its name, on its joint along a scene."""
    found: dict[str, Array] = {}
    for one in scene.regressors.model.effects:
        if "load" not in one.effect.needs:
            continue
        at, k = one.site, scene.robot.moving.index(one.joint)
        signals = [scene.motion.q[k], scene.motion.qd[k], scene.motion.qdd[k], scene.load[k]]
        for name, column in zip(one.names, one.columns(), strict=True):
            law = sympy.lambdify([at.q, at.qd, at.qdd, at.load], column[one.joint.number], "numpy")
            found[name] = np.asarray(law(*signals))
    return found
