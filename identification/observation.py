"""The regressor of whole runs: the one place where generated code meets recorded motion.

Today the generated NumPy module computes it, block by block. Whatever evaluates a base regressor faster (compiled code
over many samples, say) comes in here and changes nothing above.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.backends import numpy as numpy_backend
from generator.derivation import derive
from generator.robot.description import Robot
from generator.symbolic.bodies import INERTIAL
from generator.symbolic.model import Model

Array = NDArray[np.float64]

#: The generated functions that identification calls.
FUNCTIONS = ("regressor_packed", "payload_regressor", "inverse_dynamics", "inertia_matrix")

#: Samples that stay in the processor's cache while a block is computed.
_BLOCK = 4096


@dataclass(frozen=True)
class Motion:
    """Positions, speeds and accelerations (n x N each) [rad, m, s]."""

    q: Array
    qd: Array
    qdd: Array

    def part(self, start: int, end: int) -> Motion:
        """Samples ``start`` to ``end``, not included."""
        return Motion(self.q[:, start:end], self.qd[:, start:end], self.qdd[:, start:end])

    @property
    def samples(self) -> int:
        """N."""
        return int(self.q.shape[-1])

    @property
    def signals(self) -> tuple[Array, Array, Array]:
        """Positions, speeds, accelerations."""
        return self.q, self.qd, self.qdd


class Regressors:
    """The regressors of one robot over many samples."""

    def __init__(self, robot: Robot) -> None:
        self.model: Model = derive(robot, names=FUNCTIONS)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The base parameters, in order."""
        return tuple(parameter.name for parameter in self.model.base_parameters)

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
        packed = self._blocks("regressor_packed", motion, sum(sizes))
        return np.split(packed, np.cumsum(sizes)[:-1])

    def payload(self, motion: Motion) -> list[Array]:
        """Per joint, torque per unit of XX XY XZ YY YZ ZZ MX MY MZ M of a body in the tool frame (10 x N)."""
        flat = self._blocks("payload_regressor", motion, self.model.dof * len(INERTIAL))
        return list(flat.reshape(self.model.dof, len(INERTIAL), -1))

    def torques(self, parameters: Mapping[str, float], motion: Motion) -> Array:
        """Joint torques (n x N) for values of the base parameters by name, absent ones zero."""
        vector = self.model.default_parameters()
        for k, parameter in enumerate(self.model.parameters):
            vector[k] = parameters.get(parameter.name, vector[k] if k >= len(self.names) else 0.0)
        tau: Array = self._generated.inverse_dynamics(vector, motion.q.T, motion.qd.T, motion.qdd.T)
        return tau.T

    @cached_property
    def signs(self) -> tuple[tuple[int, tuple[tuple[int, float], ...]], ...]:
        """Where a torque jumps: the joint's coordinate, and (coordinate, weight) of the speeds whose sum it follows."""
        coordinate = {joint.number: k for k, joint in enumerate(self.model.robot.moving)}
        found = set()
        for instance in self.model.effects:
            for column in instance.columns():
                for joint, torque in column.items():
                    for jump in torque.atoms(sympy.sign):
                        found.add((coordinate[joint], _weights(jump.args[0], coordinate)))
        return tuple(sorted(found))

    def _blocks(self, name: str, motion: Motion, rows: int) -> Array:
        """Outputs of a generated function (rows x N)."""
        function: Any = getattr(self._generated, name)
        needed = [self._lengths] if self.model.functions[name].uses_parameters else []
        result = np.empty((rows, motion.samples))
        for start in range(0, motion.samples, _BLOCK):
            part = motion.part(start, start + _BLOCK)
            values = function(*needed, part.q.T, part.qd.T, part.qdd.T)
            result[:, start : start + part.samples] = values.reshape(part.samples, rows).T
        return result

    @cached_property
    def _lengths(self) -> Array:
        """The parameter vector of a regressor, which depends on symbolic lengths alone."""
        return self.model.default_parameters()

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


def standing(
    signs: Sequence[tuple[int, tuple[tuple[int, float], ...]]], qd: Array, thresholds: Array
) -> NDArray[np.bool_]:
    """Samples (n x N) in which a joint's torque follows the sign of a speed below its threshold (n) [rad/s, m/s]."""
    result = np.zeros(qd.shape, dtype=bool)
    for joint, weights in signs:
        speed = sum(weight * qd[k] for k, weight in weights)
        result[joint] |= np.abs(speed) < thresholds[joint]
    return result
