"""Regressor of the robot with elastic drive trains (report eq. 10 to 13)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.model import Model
from generator.symbolic.sparse import dense
from generator.symbolic.vectors import Array


def _signal(model: Model) -> tuple[Signal]:
    columns = len(model.base_parameters) + len(model.motor_parameters)
    meaning = "rows tau_mdi, then tau_e + k q_e (zero on a real motion); columns base parameters, then motor side"
    return (signals.matrix("W", model.flexible_dof, columns, meaning),)


def _build(model: Model) -> tuple[Array]:
    link = [base.head for base in model.grouping.base]
    motor = [parameter.name for parameter in model.motor_parameters]
    columns = model.flexible.regressor_columns(link, motor)
    return (dense(model.program, columns, model.flexible_dof),)


QUANTITY = Quantity(
    name="flexible_regressor",
    summary="Regressor of the link side's base parameters and of Iam, Fvm, Fcm, Offm, k of each elastic joint.",
    details="Report eq. 10 to 13; both blocks are linear in the parameters. "
    "Of a joint with backlash q_e counts as far as it winds the spring.",
    inputs=signals.together(signals.flexible_q, signals.flexible_qd, signals.flexible_qdd),
    outputs=_signal,
    build=_build,
    applies=lambda model: bool(model.elastic),
)
