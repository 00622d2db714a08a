"""How much of an inertia is a drive train's, where the runs alone tell no more than its sum with that of the link."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.runs.link_side import LinkSides
from identification.diagnosis.runs.rotor import rotor_is_apart
from identification.diagnosis.runs.scene import Scene

#: Least part of an inertia that a rotor or a link has.
_LEAST = 0.02
#: Step by which a rotor's inertia is searched, in parts of the link's.
_STEP = 0.1


def rotor_range(sides: LinkSides, scenes: Sequence[Scene], unit: str) -> ShapeRange | None:
    """The inertia ``Iam`` of the drive train [kg m2, kg] where no base parameter tells it from the link's: how the link
    swings and falls tells its own. None where one does, or the robot has none.
    """
    first = sides.first
    if first.rotor <= 0 or rotor_is_apart(first.scene, first.k):
        return None
    lightest = min(float(np.min(sides.along(scene, first.rotor).inertia)) for scene in scenes)
    if lightest <= 0:
        return None
    whole = first.rotor + lightest
    return ShapeRange("Iam", unit, _LEAST * whole, whole - _LEAST * lightest, log=False, step=_STEP * lightest)
