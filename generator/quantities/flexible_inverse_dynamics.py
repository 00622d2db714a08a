"""Inverse dynamic model with elastic drive trains (report eq. 8, 10)."""

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.model import Model


def _outputs(model: Model) -> tuple[Signal, Signal]:
    units = signals.torque_units(model)
    elastic = tuple(units[joint] for joint in model.elastic)
    return (
        Signal("tau_mdi", (model.dof,), units, "motor torques, on the joint side"),
        Signal("tau_e", (len(elastic),), elastic, "torques that the links ask of the springs: -k q_e on a real motion"),
    )


QUANTITY = Quantity(
    name="flexible_inverse_dynamics",
    summary="Motor torques and spring torques of the robot with elastic drive trains.",
    details="Report eq. 8 to 10: tau_mdi = Iam qdd_m + tau_fm - k q_e, tau_e = M(q_a) qdd_a + H(q_a, qd_a). "
    "Of a joint with backlash q_e counts as far as it winds the spring.",
    inputs=signals.together(signals.flexible_q, signals.flexible_qd, signals.flexible_qdd),
    outputs=_outputs,
    build=lambda model: model.flexible.inverse_dynamics(),
    applies=lambda model: bool(model.elastic),
)
