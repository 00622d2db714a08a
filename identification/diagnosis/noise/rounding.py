"""What the steps of recorded positions make of the joints' torques.

An acceleration of rounded positions is wrong by far more than they are, and where a motion repeats so do the errors of
rounding: what periods have in common is then no sign that the model lacks anything.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from generator.robot.description import Robot
from identification.arrays import Array
from identification.dataset import Run
from identification.diagnosis.runs import position_noise
from identification.diagnosis.runs.position_noise import drawn, torque_of
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import coupling
from identification.resolution import steps

#: Part of what the motors' steps make of a joint below which its own steps are those of a sum.
_FINER = 0.5


def deviations(run: Run, robot: Robot) -> Array:
    """Standard deviation (n) [rad, m] of what rounding to steps adds to a run's positions that cross many of them.

    A joint that several motors turn is at a sum of their positions, which take steps where the sum takes none or far
    finer ones.
    """
    N = coupling(robot)
    of_joints, of_motors = steps(run.q), np.linalg.norm(np.linalg.inv(N) * steps(N @ run.q), axis=1)
    # Where joints are rounded themselves their sums take steps too.
    return np.asarray(np.where(of_joints > _FINER * of_motors, of_joints, of_motors) / sqrt(12))


def errors(run: Run, robot: Robot) -> Array:
    """Standard deviation (n) [rad, m] of all that is wrong with a run's positions, zero where they are exact.

    Rounding is noise like any other, but where a joint is so slow that its steps hide it from differences.
    """
    return np.maximum(position_noise.deviations(run.q), deviations(run, robot))


def rounding(run: Prepared, scene: Scene, number: int = 0) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be: draw ``number`` for positions that cross many steps. Zero without steps, and where nothing repeats.
    """
    rounded = deviations(scene.sampled.run, scene.robot) if run.times else np.zeros(1)
    if not rounded.any():
        return np.zeros_like(run.tau)
    return np.asarray(sqrt(run.times) * run.decimated(torque_of(drawn(scene, rounded, number), scene)))
