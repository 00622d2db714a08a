"""Regressor of a payload's ten parameters (report eq. 50)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from generator.symbolic.sparse import dense
from generator.symbolic.vectors import Array


def _build(model: Model) -> tuple[Array]:
    number = model.robot.tool.number
    columns = model.base.regressor_columns([f"{stem}{number}" for stem in INERTIAL_STEMS])
    return (dense(model.program, columns, model.dof),)


QUANTITY = Quantity(
    name="payload_regressor",
    summary="Regressor of a payload's ten inertial parameters in the tool frame.",
    details="IDM_L of report eq. 50.",
    inputs=signals.together(signals.q, signals.qd, signals.qdd),
    outputs=lambda model: (signals.matrix("W", model.dof, 10, "torque per unit of XX XY XZ YY YZ ZZ MX MY MZ M"),),
    build=_build,
)
