"""Jacobian of every frame."""

import numpy as np

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.kinematics import jacobian
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def _signal(model: Model) -> tuple[Signal]:
    shape = (len(model.robot.joints), 6, model.dof)
    meaning = "Jacobian of each frame, in world axes: rows vx vy vz of its origin, then wx wy wz"
    return (Signal("J", shape, ("SI",), meaning),)


def _build(model: Model) -> tuple[Array]:
    return (np.stack([jacobian(model.chain, frame) for frame in model.chain.frames]),)


QUANTITY = Quantity(
    name="jacobians",
    summary="Jacobians of every frame: velocity of its origin and angular velocity per joint speed, in world axes.",
    details="Fixed frames and the tool frame included.",
    inputs=signals.together(signals.q),
    outputs=_signal,
    build=_build,
)
