"""One toy model with every kind of function, its states, and what it should compute."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np

from generator.selftest import Case
from generator.symbolic.function import PARAMETERS, Output, Signal, Sparsity
from generator.symbolic.statements import Program
from tests.toy import VALUES, Inputs, function, interpreted, toy


@cache
def example() -> Any:
    """A model with every kind of function: with and without parameters, constant, packed, scalar, of two outputs."""
    program = Program((PARAMETERS,))
    given_ = Inputs(program)
    q, wrench = given_.q, given_.wrench
    zz, mx, fc, kc, nq = given_.parameters
    mass = zz + 2 * mx
    mass.name = "MASS"
    sign = program.function("sign", q[1])
    torque = mass * program.function("cos", q[0]) + program.directed(fc, q[1]) - kc / nq * wrench[1]
    torque.name = "register"
    plain = program.function("sqrt", program.function("abs", q[2]) + 1)
    rest = program.function("log", program.constant(2)) * q[0]
    matrix = [q[0], program.zero, -q[1], q[2] * q[0], program.one, program.power(plain, Fraction(5, 3))]
    two = function(program, "two", [torque, -mass])
    scalar = Output(Signal("energy", (), ("J",), "a scalar"), (torque * torque,))
    two = type(two)(two.name, two.summary, two.details, two.inputs, (*two.outputs, scalar), program)
    return toy(
        program,
        two,
        function(program, "plain", [plain, sign, rest]),
        function(program, "constant", [program.constant(Fraction(1, 3)), program.constant(-2)]),
        function(program, "matrix", matrix, (3, 2), output="M"),
        function(program, "sparse", [*([program.zero] * 3), q[0], *([program.zero] * 18), torque, program.zero]),
        function(program, "array", [*matrix, *matrix[::-1]], (2, 3, 2), output="T"),
        function(program, "packed", [q[0], torque], sparsity=Sparsity((2, 4), (0, 1), (3, 2))),
    )


def states(count: int = 4) -> list[dict[str, list[float]]]:
    random = np.random.default_rng(7)
    return [
        {name: random.uniform(-2, 2, len(values)).tolist() for name, values in VALUES.items()} for _ in range(count)
    ]


def expected(model: Any, name: str, values: Mapping[str, Sequence[float]]) -> dict[str, np.ndarray[Any, Any]]:
    wanted = model.functions[name]
    numbers = interpreted(wanted.roots, values)
    return {
        output.signal.name: np.array([numbers[node] for node in output.nodes]).reshape(output.signal.shape)
        for output in wanted.outputs
    }


def reference_cases(model: Any, tolerance: float = 1e-13) -> list[Case]:
    return [
        Case(
            name,
            tuple(values[PARAMETERS]),
            {signal.name: tuple(values[signal.name]) for signal in wanted.inputs},
            {key: tuple(value.ravel().tolist()) for key, value in expected(model, name, values).items()},
            tolerance,
        )
        for values in states(2)
        for name, wanted in model.functions.items()
    ]


def assert_close(found: Any, wanted: Any, tolerance: float = 1e-12) -> None:
    """To ``tolerance`` of the largest entry."""
    found, wanted = np.asarray(found, dtype=float), np.asarray(wanted, dtype=float)
    assert found.shape == wanted.shape
    scale = max(np.abs(wanted).max(), 1e-300)
    assert np.abs(found - wanted).max() <= tolerance * scale
