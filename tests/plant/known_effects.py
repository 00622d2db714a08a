"""Effects of a simulated robot as its robot file would have them: the textbook's law that is nearest to the plant's."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from tests.plant.effect import Effect
from tests.plant.robot import Array, Robot


@dataclass(frozen=True)
class Entry:
    """An effect of a robot file by its id, on a joint (from 1): ``values`` as text, ``parameters`` by stem.

    Parameters that the joint has already are added to.
    """

    effect: str
    joint: int
    values: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, tuple[float, str]] = field(default_factory=dict)

    @property
    def line(self) -> str:
        """For the list of effects."""
        values = ", ".join(f"{name}: {text}" for name, text in self.values.items())
        return f"  - {{effect: {self.effect}, joint: {self.joint}" + (f", values: {{{values}}}}}" if values else "}")

    def merged(self, other: Entry) -> Entry:
        """One entry of both: parameters of either."""
        return Entry(self.effect, self.joint, {**self.values, **other.values}, {**self.parameters, **other.parameters})


@dataclass(frozen=True)
class _Units:
    """Of a joint: position, speed, torque, torque per speed, per position, per its cube, inertia."""

    position: str
    speed: str
    torque: str
    viscous: str
    stiffness: str
    hardening: str
    inertia: str


_TURNING = _Units("rad", "rad/s", "N m", "N m s/rad", "N m/rad", "N m/rad3", "kg m2")
_SLIDING = _Units("m", "m/s", "N", "N s/m", "N/m", "N/m3", "kg")


def entry(effect: Effect, robot: Robot) -> Entry | None:
    """The entry of an effect, None where a robot file has no such effect.

    Where the textbook's law is another one than the plant's, as docstrings of ``laws/`` say, so is the entry.
    """
    make = _ENTRIES.get(effect.law)
    if make is None:
        return None
    units = _SLIDING if robot.chain[effect.joint - 1].prismatic else _TURNING
    return make(effect, robot, units)


def textbook(effect: Effect, robot: Robot, q: Array, qd: Array) -> Array | None:
    """Torque (T) of the entry's law with the effect's values along a motion (T x n), None where the plant's law is the
    textbook's.
    """
    make = _TEXTBOOK.get(effect.law)
    if make is None:
        return None
    along = effect.along(robot)
    return np.asarray(make(effect, robot, q @ along, qd @ along))


def _spring_balancer(effect: Effect, robot: Robot, units: _Units) -> Entry:
    stiffness = effect.amount(robot)
    parameters = {"Kr": (stiffness, "N/m"), "K0": (-stiffness * effect.value("free_length", robot), "N")}
    return Entry("spring_balancer", effect.joint, _crank(effect, robot), parameters)


def _gas_balancer(effect: Effect, robot: Robot, units: _Units) -> Entry:
    exponent = effect.value("exponent", robot) if effect.law == "gas_polytrope" else 1.0
    shape = {**_crank(effect, robot), "l0": f"{effect.value('l0', robot)!r} m", "exponent": f"{exponent:g}"}
    return Entry("gas_balancer", effect.joint, shape, {"F0": (effect.amount(robot), "N")})


def _crank(effect: Effect, robot: Robot) -> dict[str, str]:
    return {
        name: f"{effect.value(name, robot)!r} {unit}" for name, unit in (("d21", "m"), ("d22", "m"), ("phi", "rad"))
    }


def _coupled_rotor(effect: Effect, robot: Robot, units: _Units) -> Entry:
    along = effect.along(robot)
    (other,) = (j for j in np.flatnonzero(along) if j != effect.joint - 1)
    size = effect.amount(robot)
    shape = {"other": str(other + 1), "ratio": repr(float(along[other] / along[effect.joint - 1]))}
    if effect.law == "wrist_inertia":
        return Entry("coupled_rotor", effect.joint, shape, {"Iar": (size, units.inertia)})
    friction = {"Fvr": (size / effect.value("speed", robot), units.viscous), "Fcr": (size, units.torque)}
    return Entry("coupled_rotor", effect.joint, shape, friction)


def _stribeck(effect: Effect, robot: Robot, units: _Units) -> Entry:
    shape = {"vs": f"{effect.value('speed', robot)!r} {units.speed}"}
    return Entry("stribeck_friction", effect.joint, shape, {"Fst": (effect.amount(robot), units.torque)})


def _asymmetric(effect: Effect, robot: Robot, units: _Units) -> Entry:
    return Entry(
        "asymmetric_coulomb",
        effect.joint,
        {},
        {"Fcp": (effect.amount(robot), units.torque), "Fcn": (0.0, units.torque)},
    )


def _quadratic(effect: Effect, robot: Robot, units: _Units) -> Entry:
    return Entry("power_friction", effect.joint, {}, {"Fp": (effect.amount(robot), units.torque)})


def _cable(effect: Effect, robot: Robot, units: _Units) -> Entry:
    shape = {"neutral": f"{effect.value('rest', robot)!r} {units.position}"}
    linear = {"kc": (effect.amount(robot), units.stiffness), "kch": (0.0, units.hardening)}
    return Entry("cable_spring", effect.joint, shape, linear)


def _position(effect: Effect, robot: Robot, units: _Units) -> Entry:
    size, phase = effect.amount(robot), effect.value("phase", robot)
    parts = {"Fqc": (size * float(np.cos(phase)), units.torque), "Fqs": (size * float(np.sin(phase)), units.torque)}
    return Entry("position_friction", effect.joint, {}, parts)


def _motor_ripple(effect: Effect, robot: Robot, units: _Units) -> Entry:
    size, phase, order = effect.amount(robot), effect.value("phase", robot), effect.value("order", robot)
    parts = {"Rmc": (size * float(np.cos(phase)), units.torque), "Rms": (-size * float(np.sin(phase)), units.torque)}
    return Entry("motor_ripple", effect.joint, {"order": f"{order:g}"}, parts)


def _load(effect: Effect, robot: Robot, units: _Units) -> Entry:
    return Entry("load_friction", effect.joint, {}, {"Fl": (effect.amount(robot), "1")})


def _gradual(effect: Effect, robot: Robot, units: _Units) -> Entry:
    size = effect.amount(robot)
    shape = {"v0": f"{effect.value('speed', robot)!r} {units.speed}"}
    # It stands in the place of as much Coulomb friction.
    parts = {"Fg": (size, units.torque), "Fc": (-size, units.torque)}
    return Entry("gradual_friction", effect.joint, shape, parts)


_ENTRIES: Mapping[str, Callable[[Effect, Robot, _Units], Entry]] = {
    "asymmetric_coulomb": _asymmetric,
    "cable_spring": _cable,
    "gas_isotherm": _gas_balancer,
    "gas_polytrope": _gas_balancer,
    "gradual_rise": _gradual,
    "load_friction": _load,
    "position_friction": _position,
    "quadratic_viscous": _quadratic,
    "ripple_motor": _motor_ripple,
    "spring_balancer": _spring_balancer,
    "stribeck": _stribeck,
    "wrist_friction": _coupled_rotor,
    "wrist_inertia": _coupled_rotor,
}

_TEXTBOOK: Mapping[str, Callable[[Effect, Robot, Array, Array], Array]] = {
    "cable_spring": lambda e, robot, q, v: e.amount(robot) * (q - e.value("rest", robot)),
    "coulomb": lambda e, robot, q, v: e.amount(robot) * np.sign(v),
    "gradual_rise": lambda e, robot, q, v: e.amount(robot) * (np.tanh(v / e.value("speed", robot)) - np.sign(v)),
    "position_friction": lambda e, robot, q, v: e.amount(robot) * np.cos(q - e.value("phase", robot)) * np.sign(v),
    "stribeck": lambda e, robot, q, v: e.amount(robot) * np.exp(-((v / e.value("speed", robot)) ** 2)) * np.sign(v),
    "wrist_friction": lambda e, robot, q, v: e.amount(robot) * (np.sign(v) + v / e.value("speed", robot)),
}
