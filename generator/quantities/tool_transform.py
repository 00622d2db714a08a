"""Pose of the tool frame."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.frames import homogeneous, world_transforms
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    return (homogeneous(model.program, *world_transforms(model.chain)[model.chain.tool.number - 1]),)


QUANTITY = Quantity(
    name="tool_transform",
    summary="Homogeneous transformation of the tool frame, in the world frame.",
    details="Report eq. 1.",
    inputs=signals.together(signals.q),
    outputs=lambda model: (signals.matrix("T", 4, 4, "pose of the tool frame in the world frame", ("1, m",)),),
    build=_build,
)
