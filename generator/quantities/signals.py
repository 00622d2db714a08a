"""The signals that quantities share: names, sizes, units, meanings, in one place; n joints move, e of them elastic."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from generator.robot.parameters import INERTIAL_STEMS, INERTIAL_UNITS
from generator.symbolic.effect_torques import STATES, WARMTH, reads
from generator.symbolic.function import Signal
from generator.symbolic.model import STANDARD, Model

_SURFACES = "of the motors, then of the elastic joints' links"


def _elastic(model: Model, units: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(units[joint] for joint in model.elastic)


def position_units(model: Model) -> tuple[str, ...]:
    """Units of the joint positions (n): rad, on a prismatic joint m."""
    return tuple(joint.position_unit for joint in model.robot.moving)


def _speed_units(model: Model) -> tuple[str, ...]:
    return tuple(f"{unit}/s" for unit in position_units(model))


def _acceleration_units(model: Model) -> tuple[str, ...]:
    return tuple(f"{unit}/s2" for unit in position_units(model))


def torque_units(model: Model) -> tuple[str, ...]:
    """Units of the joint torques (n): N m, on a prismatic joint N."""
    return tuple(joint.torque_unit for joint in model.robot.moving)


def q(model: Model) -> Signal:
    """Joint positions (n) [rad, m]."""
    return Signal("q", (model.dof,), position_units(model), "joint positions")


def qd(model: Model) -> Signal:
    """Joint speeds (n) [rad/s, m/s]."""
    return Signal("qd", (model.dof,), _speed_units(model), "joint speeds")


def qdd(model: Model) -> Signal:
    """Joint accelerations (n) [rad/s2, m/s2]."""
    return Signal("qdd", (model.dof,), _acceleration_units(model), "joint accelerations")


def tau(model: Model) -> Signal:
    """Torques that the motors supply (n) [N m, N], on the joint side, positive along z of the joint."""
    return Signal("tau", (model.dof,), torque_units(model), "motor torques, on the joint side")


def tau_ext(model: Model) -> Signal:
    """Torques of the surroundings on the links (n) [N m, N], with the sign of tau, to which they add."""
    return Signal("tau_ext", (model.dof,), torque_units(model), "torques of the surroundings on the links, with tau")


def direction(model: Model) -> Signal:
    """Directions of sliding (n) [1], read in the place of sign(qd)."""
    return Signal("direction", (model.dof,), ("1",), "in the place of sign(qd), joint by joint")


def width(model: Model) -> Signal:
    """Speeds w > 0 (n) [rad/s, m/s]: qd / sqrt(qd^2 + w^2) is read in the place of sign(qd)."""
    return renamed(qd, "width", "speeds within which the friction turns round, more than 0")(model)


def flexible_direction(model: Model) -> Signal:
    """Directions of sliding (n + e) [1], in the place of sign(speed): of motors, then of the elastic joints' links."""
    return Signal("direction", (model.flexible_dof,), ("1",), f"in the place of sign(speed): {_SURFACES}")


def flexible_width(model: Model) -> Signal:
    """Speeds w > 0 (n + e) [rad/s, m/s], x / sqrt(x^2 + w^2) for sign(x): as ``flexible_direction``."""
    return renamed(flexible_qd, "width", f"speeds within which the friction turns round, more than 0: {_SURFACES}")(
        model
    )


def wrench(model: Model) -> Signal:
    """Force [N] and moment [N m] of the robot on its environment (6), in the tool frame's axes, about its origin."""
    units = ("N",) * 3 + ("N m",) * 3
    return Signal(
        "wrench", (6,), units, "fx fy fz mx my mz of the robot on its environment, in the tool frame, at its origin"
    )


def payload(model: Model) -> Signal:
    """Inertial parameters of the payload (10) [kg m2, kg m, kg], in the tool frame's axes, about its origin."""
    return Signal("payload", (10,), INERTIAL_UNITS, f"{' '.join(INERTIAL_STEMS)} of the payload in the tool frame")


def standard_parameters(model: Model) -> Signal:
    """Standard parameters [SI], as many as ``model.standard_parameters`` and in that order."""
    units = tuple(parameter.unit for parameter in model.standard_parameters)
    return Signal(STANDARD, (len(units),), units, "standard parameters, in their order")


def states(model: Model) -> Signal:
    """States inside the effects, in the order and units of ``model.effect_states``."""
    units = tuple(state.unit for state in model.effect_states)
    names = " ".join(state.name for state in model.effect_states)
    return Signal(STATES, (len(units),), units, f"states of the effects: {names}")


def warmth(model: Model) -> Signal:
    """How warm the joints' drives are (n) [1]: 0 where the parameters hold as stated, 1 where the drift is whole."""
    return Signal(WARMTH, (model.dof,), ("1",), "warmth of the drives, 0 where the parameters hold as stated")


def of_effects(model: Model) -> tuple[Signal, ...]:
    """The signals that effects of the robot may read beside the motion."""
    found = [states(model)] if model.effect_states else []
    drives = model.robot.drives
    found += [warmth(model)] if reads(model.effects, "warmth") or (drives and drives.torque_drift) else []
    return (*found, standard_parameters(model)) if reads(model.effects, "load") else tuple(found)


def flexible_q(model: Model) -> Signal:
    """[q_m; q_e] (n + e) [rad, m]: motors in joint units, then elongations of the elastic joints (report eq. 7)."""
    units = position_units(model)
    return Signal("q", (model.flexible_dof,), units + _elastic(model, units), "[q_m; q_e]: motors, then elongations")


def flexible_qd(model: Model) -> Signal:
    """Speeds of [q_m; q_e] (n + e) [rad/s, m/s]."""
    units = _speed_units(model)
    return Signal("qd", (model.flexible_dof,), units + _elastic(model, units), "speeds of [q_m; q_e]")


def flexible_qdd(model: Model) -> Signal:
    """Accelerations of [q_m; q_e] (n + e) [rad/s2, m/s2]."""
    units = _acceleration_units(model)
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
    """A matrix (rows x columns), its entries row-major; ``units`` are one for all or one per entry."""
    return Signal(name, (rows, columns), units, meaning)


def scalar(name: str, unit: str, meaning: str) -> Signal:
    """A single number, of shape ()."""
    return Signal(name, (), (unit,), meaning)


def motor(name: str, unit: str, meaning: str) -> Callable[[Model], Signal]:
    """A signal with one entry per motor."""
    return lambda model: Signal(name, (model.dof,), (unit,), meaning)


def motor_position(model: Model) -> Signal:
    """Rotor positions qr = N q (n) [rad] (report eq. 14)."""
    return motor("qr", "rad", "rotor positions")(model)


def motor_speed(model: Model) -> Signal:
    """Rotor speeds qrd = N qd (n) [rad/s] (report eq. 14)."""
    return motor("qrd", "rad/s", "rotor speeds")(model)


def motor_torque(model: Model) -> Signal:
    """Electromagnetic torques of the rotors (n) [N m]; N^T tau_r is tau on the joint side."""
    return motor("tau_r", "N m", "electromagnetic torques of the rotors")(model)


def motor_current(model: Model) -> Signal:
    """Motor currents (n) [A]; each times its torque constant is the rotor's torque (report eq. 16)."""
    return motor("current", "A", "motor currents")(model)
