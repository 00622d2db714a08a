"""Pose of every frame in the world (report eq. 1)."""

import numpy as np

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.frames import homogeneous, world_transforms
from generator.symbolic.function import Signal
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def _signal(model: Model) -> tuple[Signal]:
    shape = (len(model.robot.joints), 4, 4)
    return (Signal("T", shape, ("1, m",), "4 x 4 pose of each frame in the world frame, in the order of the frames"),)


def _build(model: Model) -> tuple[Array]:
    placed = world_transforms(model.chain)
    return (np.stack([homogeneous(model.program, rotation, position) for rotation, position in placed]),)


QUANTITY = Quantity(
    name="transforms",
    summary="Homogeneous transformations of every frame, in the world frame.",
    details="Products of report eq. 1; fixed frames and the tool frame included.",
    inputs=signals.together(signals.q),
    outputs=_signal,
    build=_build,
)
