"""A payload as what it is to the model: part of the last body, whose parameters the base parameters hold."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from generator.robot.description import Robot
from generator.symbolic.bodies import INERTIAL
from identification.observation import Motion, Regressors

#: Random motions; many times the unknowns.
_SAMPLES = 400


def carried(robot: Robot, payload: Mapping[str, float]) -> dict[str, float]:
    """What a payload adds to the base parameters by name [SI].

    ``payload`` holds values of XX XY XZ YY YZ ZZ MX MY MZ M in the tool frame [SI], absent ones zero. Its torques are
    those of base parameters on every motion (report eq. 50), so that random ones find them by least squares.
    """
    regressors = Regressors(robot)
    motion = Motion(*np.random.default_rng(0).uniform(-3.0, 3.0, (3, len(robot.moving), _SAMPLES)))
    body = np.array([payload.get(stem, 0.0) for stem in INERTIAL])
    names, rows, torques = regressors.names, [], []
    for structure, W, P in zip(regressors.structure, regressors.base(motion), regressors.payload(motion), strict=True):
        row = np.zeros((_SAMPLES, len(names)))
        row[:, [names.index(name) for name in structure]] = W.T
        rows.append(row)
        torques.append(body @ P)
    matrix = np.concatenate(rows)
    size = np.linalg.norm(matrix, axis=0)
    added = np.linalg.lstsq(matrix / size, np.concatenate(torques), rcond=None)[0] / size
    return dict(zip(names, added.tolist(), strict=True))
