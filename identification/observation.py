"""The regressor of whole runs: the one place where generated code meets recorded motion.

The generated NumPy module computes it, block by block: most of the time of a fit is spent elsewhere
(docs/identification.md).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from types import ModuleType
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.backends import numpy as numpy_backend
from generator.derivation import derive
from generator.robot.description import Robot
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.effect_torques import STATES, WARMTH, reads
from generator.symbolic.model import Model
from identification.arrays import Array
from identification.effect_states import beginning, integrated

#: The coordinate whose torque jumps, and (coordinate, weight) of the speeds whose sum's sign it follows.
Jump = tuple[int, tuple[tuple[int, float], ...]]

#: The generated functions that identification calls.
FUNCTIONS = ("regressor_packed", "payload_regressor", "inverse_dynamics", "inertia_matrix", "effect_rates")

#: Motions in which everything moves every way, and the rounding of what they ask for [1].
_ALL_WAYS, _EXACT = 100, 1e-9

#: Samples that stay in the processor's cache while a block is computed.
_BLOCK = 4096


@dataclass(frozen=True)
class Motion:
    """Positions, speeds and accelerations (n x N each) [rad, m, s].

    ``states`` inside effects (s x N) and the drives' ``warmth`` (n x N) are zero where they are None.
    """

    q: Array
    qd: Array
    qdd: Array
    states: Array | None = None
    warmth: Array | None = None

    def part(self, start: int, end: int) -> Motion:
        """Samples ``start`` to ``end``, not included."""
        return self.at(slice(start, end))

    def at(self, samples: slice | NDArray[np.int64]) -> Motion:
        """Some of the samples."""
        signals = (self.q, self.qd, self.qdd, self.states, self.warmth)
        return Motion(*(None if one is None else one[:, samples] for one in signals))  # type: ignore[arg-type]

    def mixed(self, A: Array) -> Motion:
        """The motion with joints moving by ``A`` (n x n) times how they did; the states stay what they were."""
        return replace(self, q=A @ self.q, qd=A @ self.qd, qdd=A @ self.qdd)

    def turned(self, k: int) -> Motion:
        """The motion with joint k moving the other way; the states stay what they were."""
        way = np.ones((len(self.q), 1))
        way[k] = -1.0
        return replace(self, q=way * self.q, qd=way * self.qd, qdd=way * self.qdd)

    def shifted(self, k: int, by: float) -> Motion:
        """The motion with joint k further ``by`` [rad, m]; the states stay what they were."""
        q = self.q.copy()
        q[k] += by
        return replace(self, q=q)

    @property
    def samples(self) -> int:
        """N."""
        return int(self.q.shape[-1])

    @property
    def signals(self) -> tuple[Array, Array, Array]:
        """Positions, speeds, accelerations (n x N each) [rad, m, s]."""
        return self.q, self.qd, self.qdd


class Regressors:
    """The regressors of one robot over many samples.

    Where a column reads the load it is that of the parameters ``values`` by name [SI], absent ones zero.
    """

    def __init__(self, robot: Robot) -> None:
        self.model: Model = derive(robot, names=FUNCTIONS)
        self.values: Mapping[str, float] = {}

    def loaded_by(self, values: Mapping[str, float]) -> Regressors:
        """The same with the load that ``values`` make."""
        result = copy(self)
        result.values = dict(values)
        return result

    def carrying(self, body: Sequence[float]) -> Regressors:
        """The same with the load of a body in the tool frame as well: XX XY XZ YY YZ ZZ MX MY MZ M [SI]."""
        more = dict(zip(self.names, (self._of_body @ np.array(body)).tolist(), strict=True))
        return self.loaded_by({**self.values, **{name: self.values.get(name, 0.0) + x for name, x in more.items()}})

    def described(self, robot: Robot) -> Regressors:
        """The same of a ``robot`` whose file says more of it, or less, that changes no equation."""
        result = copy(self)
        result.model = copy(self.model)
        result.model.robot = robot
        return result

    @property
    def reads_load(self) -> bool:
        """Whether a column depends on the parameters, by the load that they make."""
        return reads(self.model.effects, "load")

    def completed(self, motion: Motion, period: float) -> Motion:
        """The motion, sampled every ``period`` [s], with the states inside effects."""
        if not self.model.effect_states:
            return motion
        numbers = self.model.robot.numbers
        start = beginning(motion.qd)[[numbers.index(state.joint) for state in self.model.effect_states]]
        rates = self._generated.effect_rates
        return replace(motion, states=integrated(rates, motion.q, motion.qd, period, start))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The base parameters, in order."""
        return tuple(parameter.name for parameter in self.model.base_parameters)

    @cached_property
    def rotors(self) -> tuple[Mapping[str, float], ...]:
        """Per joint, the base parameters by name that make the torque ``qdd`` of an inertia which turns with the motor
        of this joint alone, one of each as many times as said [1]; none where they do not hold it.
        """
        motion = self._all_ways
        own = np.zeros((self.model.dof, *motion.qdd.shape))
        own[range(self.model.dof), range(self.model.dof)] = motion.qdd
        solution, exact = self._held(motion, own)
        return tuple(
            {name: float(x) for name, x in zip(self.names, each, strict=True) if abs(x) > _EXACT} if held else {}
            for each, held in zip(solution.T, exact, strict=True)
        )

    @cached_property
    def _of_body(self) -> Array:
        """The change of the base parameters (p x 10) [SI] that a body in the tool frame makes, by its parameters."""
        torques = np.stack(self.payload(self._all_ways)).transpose(1, 0, 2)
        return self._held(self._all_ways, torques)[0]

    @property
    def _all_ways(self) -> Motion:
        return Motion(*np.random.default_rng(0).uniform(-1.0, 1.0, (3, self.model.dof, _ALL_WAYS)))

    def _held(self, motion: Motion, torques: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Base parameters (p x k) that make ``torques`` (k x n x N) along a motion, and which of these exactly."""
        columns = np.zeros((len(self.names), self.model.dof, motion.samples))
        for row, (names, found) in enumerate(zip(self.structure, self.base(motion), strict=True)):
            columns[[self.names.index(name) for name in names], row] = found
        flat, wanted = columns.reshape(len(columns), -1).T, torques.reshape(len(torques), -1).T
        solution, *_ = np.linalg.lstsq(flat, wanted, rcond=None)
        return np.asarray(solution, dtype=float), np.asarray(np.abs(flat @ solution - wanted).max(axis=0) < _EXACT)

    @cached_property
    def structure(self) -> tuple[tuple[str, ...], ...]:
        """Per joint, the names of the base parameters that its torque can depend on."""
        rows, columns = self._generated.SPARSITY["regressor_packed"]
        return tuple(
            tuple(self.names[c] for r, c in zip(rows, columns, strict=True) if r == row)
            for row in range(self.model.dof)
        )

    def base(self, motion: Motion) -> list[Array]:
        """Per joint, torque per unit of each parameter of ``structure`` (columns x N)."""
        sizes = [len(row) for row in self.structure]
        packed = self._blocks("regressor_packed", motion, sum(sizes), self.values)
        return np.split(packed, np.cumsum(sizes)[:-1])

    def payload(self, motion: Motion) -> list[Array]:
        """Per joint, torque per unit of XX XY XZ YY YZ ZZ MX MY MZ M of a body in the tool frame (10 x N)."""
        flat = self._blocks("payload_regressor", motion, self.model.dof * len(INERTIAL_STEMS), self.values)
        return list(flat.reshape(self.model.dof, len(INERTIAL_STEMS), -1))

    def torques(self, parameters: Mapping[str, float], motion: Motion) -> Array:
        """Joint torques (n x N) for values of the base parameters by name, absent ones zero."""
        return self._blocks("inverse_dynamics", motion, self.model.dof, parameters)

    def inertia(self, parameters: Mapping[str, float], q: Array) -> Array:
        """M (N x n x n) at positions ``q`` (n x N) for values of the base parameters by name, absent ones zero."""
        still = np.zeros_like(q)
        return self._evaluated("inertia_matrix", Motion(q, still, still), parameters)

    @cached_property
    def signs(self) -> tuple[Jump, ...]:
        """Where torques jump with the sign of a speed."""
        coordinate = {joint.number: k for k, joint in enumerate(self.model.robot.moving)}
        found = set()
        for instance in self.model.effects:
            for column in instance.columns():
                for joint, torque in column.items():
                    for jump in torque.atoms(sympy.sign):
                        found.add((coordinate[joint], _weights(jump.args[0], coordinate)))
        return tuple(sorted(found))

    def _blocks(self, name: str, motion: Motion, rows: int, parameters: Mapping[str, float]) -> Array:
        """Outputs of a generated function (rows x N), given what it reads."""
        result = np.empty((rows, motion.samples))
        for start in range(0, motion.samples, _BLOCK):
            part = motion.part(start, start + _BLOCK)
            values = self._evaluated(name, part, parameters)
            result[:, start : start + part.samples] = values.reshape(part.samples, rows).T
        return result

    def _evaluated(self, name: str, motion: Motion, parameters: Mapping[str, float]) -> Array:
        """A generated function along a motion (N x ...), given what it reads."""
        function = self.model.functions[name]
        states = np.zeros((len(self.model.effect_states), 1)) if motion.states is None else motion.states
        warmth = np.zeros((self.model.dof, 1)) if motion.warmth is None else motion.warmth
        signals = {"q": motion.q, "qd": motion.qd, "qdd": motion.qdd, STATES: states, WARMTH: warmth}
        inputs = [signals[signal.name].T for signal in function.inputs]
        if function.uses_parameters:
            inputs.insert(0, self._vector(parameters))
        result: Array = getattr(self._generated, name)(*inputs)
        return result

    def _vector(self, values: Mapping[str, float]) -> Array:
        """Values by name as the generated functions take them, with nominal lengths where they are absent."""
        vector = self.model.default_parameters()
        for k, parameter in enumerate(self.model.parameters):
            vector[k] = values.get(parameter.name, vector[k])
        return vector

    @cached_property
    def _generated(self) -> Any:
        return generated_module(self.model)


def generated_module(model: Model) -> Any:
    """The module that the NumPy backend writes for the model's functions, imported."""
    (text,) = numpy_backend.emit(model).values()
    module = ModuleType(model.robot.name)
    exec(compile(text, f"<{model.robot.name}>", "exec"), module.__dict__)
    return module


def _weights(speed: sympy.Expr, coordinate: Mapping[int, int]) -> tuple[tuple[int, float], ...]:
    """The linear form of speeds that ``speed`` is."""
    names = {sympy.Symbol(f"qd{number}", real=True): k for number, k in coordinate.items()}
    return tuple(sorted((k, float(speed.coeff(symbol))) for symbol, k in names.items() if speed.has(symbol)))


def followed(jumps: Iterable[Jump], qd: Array) -> Iterator[tuple[int, Array]]:
    """The coordinates whose torques jump, each with the speed (N) whose sign it follows, along speeds qd (n x N)."""
    for joint, weights in jumps:
        yield joint, np.asarray(sum(weight * qd[k] for k, weight in weights))


def standing(signs: Iterable[Jump], qd: Array, thresholds: Array) -> NDArray[np.bool_]:
    """Samples (n x N) in which a joint's torque follows the sign of a speed within its threshold (n) [rad/s, m/s]."""
    result = np.zeros(qd.shape, dtype=bool)
    for joint, speed in followed(signs, qd):
        result[joint] |= np.abs(speed) <= thresholds[joint]
    return result
