"""The signals that quantities share: names, sizes, units, meanings, in one place."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from generator.robot.description import PRISMATIC
from generator.symbolic.bodies import INERTIAL
from generator.symbolic.effect_torques import STATES, WARMTH, reads
from generator.symbolic.function import Signal
from generator.symbolic.model import STANDARD, Model

_SURFACES = "of the motors, then of the elastic joints' links"
_INERTIAL_UNITS = ("kg m2",) * 6 + ("kg m",) * 3 + ("kg",)


def _per_joint(model: Model, revolute: str, prismatic: str) -> tuple[str, ...]:
    return tuple(prismatic if joint.sigma == PRISMATIC else revolute for joint in model.robot.moving)


def _elastic(model: Model, units: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(units[joint] for joint in model.elastic)


def position_units(model: Model) -> tuple[str, ...]:
    return tuple(joint.position_unit for joint in model.robot.moving)


def torque_units(model: Model) -> tuple[str, ...]:
    return tuple(joint.torque_unit for joint in model.robot.moving)


def q(model: Model) -> Signal:
    return Signal("q", (model.dof,), position_units(model), "joint positions")


def qd(model: Model) -> Signal:
    return Signal("qd", (model.dof,), _per_joint(model, "rad/s", "m/s"), "joint speeds")


def qdd(model: Model) -> Signal:
    return Signal("qdd", (model.dof,), _per_joint(model, "rad/s2", "m/s2"), "joint accelerations")


def tau(model: Model) -> Signal:
    return Signal("tau", (model.dof,), torque_units(model), "motor torques, on the joint side")


def tau_ext(model: Model) -> Signal:
    return Signal("tau_ext", (model.dof,), torque_units(model), "torques of the surroundings on the links, with tau")


def direction(model: Model) -> Signal:
    return Signal("direction", (model.dof,), ("1",), "in the place of sign(qd), joint by joint")


def width(model: Model) -> Signal:
    return renamed(qd, "width", "speeds within which the friction turns round, more than 0")(model)


def flexible_direction(model: Model) -> Signal:
    return Signal("direction", (model.flexible_dof,), ("1",), f"in the place of sign(speed): {_SURFACES}")


def flexible_width(model: Model) -> Signal:
    return renamed(flexible_qd, "width", f"speeds within which the friction turns round, more than 0: {_SURFACES}")(
        model
    )


def wrench(model: Model) -> Signal:
    units = ("N",) * 3 + ("N m",) * 3
    return Signal(
        "wrench", (6,), units, "fx fy fz mx my mz of the robot on its environment, in the tool frame, at its origin"
    )


def payload(model: Model) -> Signal:
    return Signal("payload", (10,), _INERTIAL_UNITS, f"{' '.join(INERTIAL)} of the payload in the tool frame")


def standard_parameters(model: Model) -> Signal:
    units = tuple(parameter.unit for parameter in model.standard_parameters)
    return Signal(STANDARD, (len(units),), units, "standard parameters, in their order")


def states(model: Model) -> Signal:
    units = tuple(state.unit for state in model.effect_states)
    names = " ".join(state.name for state in model.effect_states)
    return Signal(STATES, (len(units),), units, f"states of the effects: {names}")


def warmth(model: Model) -> Signal:
    return Signal(WARMTH, (model.dof,), ("1",), "warmth of the drives, 0 where the parameters hold as stated")


def of_effects(model: Model) -> tuple[Signal, ...]:
    """The signals that effects of the robot may read beside the motion."""
    found = [states(model)] if model.effect_states else []
    drives = model.robot.drives
    found += [warmth(model)] if reads(model.effects, "warmth") or (drives and drives.torque_drift) else []
    return (*found, standard_parameters(model)) if reads(model.effects, "load") else tuple(found)


def flexible_q(model: Model) -> Signal:
    units = position_units(model)
    return Signal("q", (model.flexible_dof,), units + _elastic(model, units), "[q_m; q_e]: motors, then elongations")


def flexible_qd(model: Model) -> Signal:
    units = _per_joint(model, "rad/s", "m/s")
    return Signal("qd", (model.flexible_dof,), units + _elastic(model, units), "speeds of [q_m; q_e]")


def flexible_qdd(model: Model) -> Signal:
    units = _per_joint(model, "rad/s2", "m/s2")
    return Signal("qdd", (model.flexible_dof,), units + _elastic(model, units), "accelerations of [q_m; q_e]")


def renamed(make: Callable[[Model], Signal], name: str, meaning: str) -> Callable[[Model], Signal]:
    """A signal of the same shape and units under another name."""

    def made(model: Model) -> Signal:
        signal = make(model)
        return Signal(name, signal.shape, signal.units, meaning)

    return made


def together(*makers: Callable[[Model], Signal]) -> Callable[[Model], Sequence[Signal]]:
    """The signals of several makers, in order."""
    return lambda model: tuple(make(model) for make in makers)


def matrix(name: str, rows: int, columns: int, meaning: str, units: tuple[str, ...] = ("SI",)) -> Signal:
    return Signal(name, (rows, columns), units, meaning)


def scalar(name: str, unit: str, meaning: str) -> Signal:
    return Signal(name, (), (unit,), meaning)


def motor(name: str, unit: str, meaning: str) -> Callable[[Model], Signal]:
    """A signal with one entry per motor."""
    return lambda model: Signal(name, (model.dof,), (unit,), meaning)


def motor_position(model: Model) -> Signal:
    return motor("qr", "rad", "rotor positions")(model)


def motor_speed(model: Model) -> Signal:
    return motor("qrd", "rad/s", "rotor speeds")(model)


def motor_torque(model: Model) -> Signal:
    return motor("tau_r", "N m", "electromagnetic torques of the rotors")(model)


def motor_current(model: Model) -> Signal:
    return motor("current", "A", "motor currents")(model)
