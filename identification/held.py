"""A joint that is held, so that its drive train yields and does no more."""

from __future__ import annotations

import numpy as np

from generator.errors import InputError
from generator.robot.description import Joint
from identification.dataset import Run
from identification.drive_train import YIELDS


def check_held(run: Run, k: int, joint: Joint, expected: str) -> None:
    """Raises InputError, telling what was ``expected``, where ``joint``, coordinate k, moves as if it was free."""
    motion, unit = float(np.ptp(run.q[k])), joint.position_unit
    if motion > YIELDS:
        problem = f"joint {joint.number} moves by {motion:.3g} {unit}"
        raise InputError(run.place, problem, f"{expected}, at most {YIELDS:g} {unit}")
