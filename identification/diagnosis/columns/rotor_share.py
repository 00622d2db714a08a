"""How much of an inertia is a drive train's, where the runs alone tell no more than its sum with that of the link."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.runs.link_side import LinkSide, LinkSides, rotor_is_fitted, rotor_is_told
from identification.diagnosis.runs.scene import Scene

#: Parts of an inertia that are a rotor's where nothing tells it, and the least part of it that a rotor or a link has.
_PARTS, _LEAST = (0.3, 0.6, 0.9), 0.02
#: Step by which a rotor's inertia is searched, in parts of the link's.
_STEP = 0.1


def rotor_range(side: LinkSide, scenes: Sequence[Scene], unit: str) -> ShapeRange | None:
    """The inertia ``Iam`` of the drive train [kg m2, kg] where no base parameter tells it from the link's: how the link
    swings and falls tells its own. None where one does, or the robot has none.
    """
    if side.rotor <= 0 or rotor_is_fitted(side.scene, side.k):
        return None
    sides = LinkSides(side)
    lightest = min(float(np.min(sides.along(scene, side.rotor).inertia)) for scene in scenes)
    if lightest <= 0:
        return None
    whole = side.rotor + lightest
    return ShapeRange("Iam", unit, _LEAST * whole, whole - _LEAST * lightest, log=False, step=_STEP * lightest)


def tried(side: LinkSide, rotor: ShapeRange | None) -> list[LinkSide]:
    """Those past drive trains of the inertias that are tried first; as it is where that is known."""
    if rotor is None or rotor_is_told(side.scene, side.k):
        return [side]
    sides = LinkSides(side)
    return [sides.along(side.scene, part * rotor.high) for part in _PARTS]
