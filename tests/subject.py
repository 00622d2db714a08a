"""What the tests look at: a robot with physical parameters, its generated functions, and the same by the reference."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import sympy
from numpy.typing import ArrayLike, NDArray

from generator.derivation import derive
from generator.effects.library import library
from generator.reference import sample
from generator.reference.matter import INERTIAL
from generator.reference.quantities import Reference
from generator.reference.rigid import Rigid, rigid
from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from generator.symbolic.function import Function, Signal
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model

Vector = NDArray[np.float64]

#: Size of the random inputs by signal name [SI].
_SCALES = {
    "qd": 2.0,
    "qdd": 5.0,
    "tau": 200.0,
    "wrench": 80.0,
    "qr": 300.0,
    "qrd": 300.0,
    "tau_r": 20.0,
    "current": 20.0,
    "tau_ext": 300.0,
    "direction": 1.0,
    "width": 1.0,
    "states": 1.0,
    "warmth": 1.0,
}
#: Stems of the parameters of effects that store potential energy, that store none of any kind, and that rub.
SPRINGS = tuple(p.stem for effect in library().values() if effect.potential_energy for p in effect.parameters)
LOSSES = tuple(
    p.stem
    for effect in library().values()
    for p in effect.parameters
    if p.stem not in SPRINGS and p.stem not in ("Ia", "Iar")
)
#: Stems of the parameters of effects that follow a motor, many periods to a turn of the joint.
FAST = tuple(p.stem for effect in library().values() if "motor" in effect.needs for p in effect.parameters)
#: Stems of the parameters whose torque depends on the load, and so on all that is grouped with it.
LOADED = tuple(p.stem for effect in library().values() if "load" in effect.needs for p in effect.parameters)
FRICTION = tuple(p.stem for effect in library().values() if effect.dissipates for p in effect.parameters)
#: Elongation of an elastic drive train [rad or m].
_ELONGATION = 0.1


@cache
def bare(name: str) -> Model:
    """A robot file's model without quantities, which groupings do not need."""
    return derive(read(find_robot(name)), ())


@dataclass(frozen=True)
class Subject:
    """A model and one set of values: standard and motor-side parameters, torque constants, lengths, by name.

    Symbolic lengths are moved away from their nominal values, so that a number frozen in their place shows.
    """

    model: Model
    values: Mapping[str, float]

    @property
    def robot(self) -> Robot:
        return self.model.robot

    @property
    def dof(self) -> int:
        return self.model.dof

    @cached_property
    def base_values(self) -> dict[str, float]:
        """Values of the base parameters: the groupings, evaluated at these lengths."""
        numbers = {sympy.Symbol(length.name, real=True): length.value for length in self.robot.lengths}
        numbers |= {symbol: self.values[symbol.name] for symbol in numbers if symbol.name in self.values}
        return {
            base.name: sum(float(c.subs(numbers)) * self.values.get(name, 0.0) for c, name in base.terms)
            for base in self.model.grouping.base
        }

    @cached_property
    def parameters(self) -> Vector:
        """The generated code's parameter vector."""
        known = {**self.values, **self.base_values}
        return np.array([known.get(parameter.name, 0.0) for parameter in self.model.parameters])

    @property
    def kept(self) -> Subject:
        """The same torques from fewer standard parameters: those that stay carry the groupings, the others are zero."""
        base = dict(zip(self.heads, self.base_values.values(), strict=True))
        others = {name: value for name, value in self.values.items() if name not in self.standard}
        return Subject(self.model, base | others)

    def hides(self, *stems: str) -> bool:
        """Whether a grouping mixes parameters of these stems with others.

        Constant offsets hide in the weight of what slides along a fixed slope, a spring in that of an arm whose axis
        does not move; the base parameters then hold their sum alone.
        """
        mixed = (base for base in self.model.grouping.base if len(base.terms) > 1)
        return any(self._stems[name] in stems for base in mixed for _, name in base.terms)

    @property
    def loaded(self) -> bool:
        """Whether a torque depends on the load."""
        return any(self._stems[name] in LOADED for name in self.standard)

    @cached_property
    def rigid(self) -> Rigid:
        """The reference's rigid robot, for many states."""
        return rigid(self.robot, self.values)

    @cached_property
    def _reference(self) -> Reference:
        return Reference(self.robot, self.values)

    @property
    def heads(self) -> list[str]:
        """Standard parameters whose columns the base regressor keeps."""
        return [base.head for base in self.model.grouping.base]

    @property
    def standard(self) -> list[str]:
        """Names of the standard parameters, in order."""
        return [parameter.name for parameter in self.model.standard_parameters]

    def with_values(self, values: Mapping[str, float]) -> Subject:
        """The same model with other parameter values; the lengths stay."""
        lengths = {name: value for name, value in self.values.items() if name in self._symbolic}
        return Subject(self.model, {**values, **lengths})

    def only(self, *stems: str) -> Subject:
        """The same model with all parameters zero but those of these stems, and the lengths."""
        return self.with_values({name: v for name, v in self.values.items() if self._stems.get(name) in stems})

    def without(self, *stems: str) -> Subject:
        """The same model with the parameters of these stems zero."""
        return self.with_values({name: v for name, v in self.values.items() if self._stems.get(name) not in stems})

    @property
    def bodies_alone(self) -> Subject:
        """Without any effect."""
        return self.only(*INERTIAL)

    def generated(self, name: str, inputs: Mapping[str, ArrayLike]) -> dict[str, Vector]:
        """Outputs of a generated function; states and warmth are zero, standard parameters the arm's, if not given."""
        beside = {
            "states": np.zeros(len(self.model.effect_states)),
            "warmth": np.zeros(self.dof),
            "standard_parameters": [self.values.get(name, 0.0) for name in self.standard],
        }
        given = {**beside, **inputs}
        return evaluate(self.model.functions[name], {**given, "parameters": self.parameters})

    def expected(self, name: str, inputs: Mapping[str, ArrayLike]) -> dict[str, Vector]:
        """Outputs of the same quantity by the reference."""
        return self._reference(name, inputs, self._columns(name))

    def output(self, name: str, **inputs: ArrayLike) -> Vector:
        """The only output of a generated function."""
        (value,) = self.generated(name, inputs).values()
        return value

    def state(self, seed: int) -> tuple[Vector, Vector, Vector]:
        """Positions inside the limits, speeds and accelerations (n each)."""
        q = sample.positions(self.robot, seed)
        return (np.array(q), *(self._signal(name, self.dof, seed) for name in ("qd", "qdd")))

    def inputs(self, function: Function, seed: int) -> dict[str, Vector]:
        """One sample of every input signal of ``function``."""
        return {signal.name: self._sample(signal, seed) for signal in function.inputs}

    def _sample(self, signal: Signal, seed: int) -> Vector:
        if signal.name == "q":
            elongations = sample.signal(signal.size - self.dof, seed + 50, _ELONGATION)
            return np.array(sample.positions(self.robot, seed) + elongations)
        if signal.name == "payload":
            return np.array(sample.payload(seed))
        if signal.name == "standard_parameters":
            return np.array([self.values.get(name, 0.0) for name in self.standard])
        drawn = self._signal(signal.name, signal.size, seed)
        return np.abs(drawn) if signal.name == "width" else drawn

    def _signal(self, name: str, size: int, seed: int) -> Vector:
        return np.array(sample.signal(size, seed + list(_SCALES).index(name), _SCALES[name]))

    def _columns(self, name: str) -> Sequence[str]:
        return {
            "regressor": self.heads,
            "regressor_standard": self.standard,
            "flexible_regressor": self.heads + [parameter.name for parameter in self.model.motor_parameters],
        }.get(name, ())

    @property
    def _stems(self) -> dict[str, str]:
        named = (*self.model.standard_parameters, *self.model.motor_parameters)
        return {parameter.name: parameter.name.removesuffix(str(parameter.joint)) for parameter in named}

    @property
    def _symbolic(self) -> set[str]:
        return {length.name for length in self.robot.lengths if length.symbolic}


def subject(robot: Robot, seed: int = 1, names: Sequence[str] | None = None) -> Subject:
    """A robot derived (its groupings checked), with physical parameters; ``names`` limits the quantities."""
    model = derive(robot, names)
    values = sample.physical_parameters(robot, seed) | dict(_lengths(robot)) | dict(_torque_constants(model))
    return Subject(model, values)


def _lengths(robot: Robot) -> Iterator[tuple[str, float]]:
    for k, length in enumerate(robot.lengths):
        if length.symbolic:
            yield length.name, float(length.value) + 0.05 + 0.03 * k


def _torque_constants(model: Model) -> Iterator[tuple[str, float]]:
    for k, parameter in enumerate(model.torque_constants):
        yield parameter.name, 1.1 + 0.07 * k


def close(actual: ArrayLike, expected: ArrayLike, tolerance: float = 1e-10) -> bool:
    """Whether two arrays agree to ``tolerance`` of the largest expected entry (of 1e-3, if that is more)."""
    actual, expected = np.asarray(actual, dtype=float), np.asarray(expected, dtype=float)
    if actual.shape != expected.shape:
        return False
    scale = max(np.max(np.abs(expected), initial=0.0), 1e-3)
    return bool(np.max(np.abs(actual - expected), initial=0.0) <= tolerance * scale)


def slope(function: object, step: float = 1e-3) -> Vector:
    """Derivative at zero of a function of one number: five points, error of the fourth order."""
    f = [np.asarray(function(k * step)) for k in (-2, -1, 1, 2)]  # type: ignore[operator]
    return (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * step)
