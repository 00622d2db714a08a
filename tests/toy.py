"""Small made-up models and random straight-line programs for the tests of the backends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy
from hypothesis import strategies as st

from generator.backends.printing.prepared import index, signal_of
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.parameters import Parameter
from generator.symbolic.function import PARAMETERS, Function, Output, Signal, Sparsity
from generator.symbolic.statements import Node, Program
from generator.symbolic.strategy import TEXTBOOK, Strategies

PARAMETER_NAMES = ("ZZ1R", "MX1", "Fc1", "class", "NQ")
STANDARD_NAMES = ("ZZ1", "MX1", "Fc1")


@dataclass(frozen=True)
class Toy:
    """What the backends read of a model."""

    program: Program
    functions: Mapping[str, Function]

    @property
    def robot(self) -> Any:
        given = {"ZZ1R": ParameterValue(-2.5, "kg m2")}
        return SimpleNamespace(
            name="toy",
            description='ends a comment */ and a """docstring""" \\',
            digest="0" * 64,
            moving=(1, 2, 3),
            joints=(),
            lengths=(),
            gravity=sympy.Matrix([0, 0, -sympy.Rational("9.81")]),
            base=sympy.eye(4),
            parameter_sets={"first": ParameterSet("first", "made up", "a table", given)},
        )

    @property
    def strategies(self) -> Strategies:
        """No bodies."""
        return TEXTBOOK

    @property
    def constants(self) -> Mapping[str, float]:
        """None is built in."""
        return {}

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return _parameters(PARAMETER_NAMES)

    base_parameters = all_parameters = parameters
    grouping = SimpleNamespace(numbers={}, base=(), numeric=dict)

    @property
    def standard_parameters(self) -> tuple[Parameter, ...]:
        return _parameters(STANDARD_NAMES)

    def default_parameters(self) -> Any:
        return np.arange(len(PARAMETER_NAMES), dtype=float)


def _parameters(names: Iterable[str]) -> tuple[Parameter, ...]:
    return tuple(Parameter(name, "kg m2", 1, "some */ parameter") for name in names)


class Inputs:
    """The input nodes of a program: signals q [3] and wrench [2], and the parameters."""

    def __init__(self, program: Program) -> None:
        self.q = [program.input("q", place) for place in range(3)]
        self.wrench = [program.input("wrench", place) for place in range(2)]
        self.parameters = [program.input(PARAMETERS, place) for place in range(len(PARAMETER_NAMES))]

    @property
    def all(self) -> list[Node]:
        return [*self.q, *self.wrench, *self.parameters]


Q = Signal("q", (3,), ("rad", "rad", "m"), "positions")
WRENCH = Signal("wrench", (2,), ("N", "N m"), "some wrench")


def function(
    program: Program,
    name: str,
    nodes: Sequence[Node],
    shape: tuple[int, ...] | None = None,
    output: str = "y",
    sparsity: Sparsity | None = None,
) -> Function:
    """A function of q and wrench with one output; a vector unless a shape is given."""
    signal = Signal(output, (len(nodes),) if shape is None else shape, ("SI",), "what comes out")
    return Function(name, f"The toy {name}.", "", (Q, WRENCH), (Output(signal, tuple(nodes)),), program, sparsity)


def toy(program: Program, *functions: Function) -> Any:
    """A model of ``functions``."""
    return Toy(program, {one.name: one for one in functions})


# -- random programs --------------------------------------------------------------------------------------------------

VALUES = {"q": (0.75, -1.25, 2.0), "wrench": (-0.3125, 1.7), PARAMETERS: (1.1, -0.7, 0.3, 2.3, -1.9)}

_constants = st.one_of(
    st.integers(-5, 5).map(Fraction),
    st.fractions(-4, 4, max_denominator=97),
    st.decimals(-3, 3, places=4, allow_nan=False).map(Fraction),
)


@st.composite
def programs(draw: st.DrawFn, outputs: int = 4, steps: int = 30) -> tuple[Program, list[Node]]:
    """A program of random operations, some of them named, and some of its nodes as outputs.

    Divisors and arguments of roots and logarithms stay away from zero; what grows is put through a sine.
    """
    program = Program((PARAMETERS,))
    nodes = Inputs(program).all
    for _ in range(draw(st.integers(1, steps))):
        node = _grown(draw, program, nodes)
        if abs(float(interpreted([node], VALUES)[node])) > 8:
            node = program.function("sin", node)
        if node.operation not in ("constant", "input", "neg") and draw(st.integers(0, 4)) == 0:
            node.name = draw(st.sampled_from(["W3_2", "q", "double", "lambda", "t1", "p1", "y", "q1", "N5_1"]))
        nodes.append(node)
    return program, draw(st.lists(st.sampled_from(nodes[-12:]), min_size=1, max_size=outputs))


def _grown(draw: st.DrawFn, program: Program, nodes: Sequence[Node]) -> Node:
    def some() -> Node:
        return program.constant(draw(_constants)) if draw(st.integers(0, 5)) == 0 else draw(st.sampled_from(nodes))

    def still() -> Node:
        return draw(st.sampled_from([node for node in nodes if node.parameter_only]))

    def moving() -> Node:
        return draw(st.sampled_from([node for node in nodes if not node.parameter_only]))

    a, b = some(), some()
    positive = a * a + 1
    grow: dict[str, Callable[[], Node]] = {
        "add": lambda: a + b,
        "sub": lambda: a - b,
        "mul": lambda: a * b,
        "div": lambda: b / positive,
        "neg": lambda: -a,
        "sin": lambda: program.function("sin", a),
        "cos": lambda: program.function("cos", a),
        "sqrt": lambda: program.function("sqrt", positive),
        "log": lambda: program.function("log", positive),
        "exp": lambda: program.function("exp", program.function("sin", a)),
        "tanh": lambda: program.function("tanh", a),
        "abs": lambda: program.function("abs", a),
        "sign": lambda: program.function("sign", a),
        "directed": lambda: program.directed(still(), moving()),
        "pow": lambda: program.power(positive, draw(st.sampled_from([Fraction(2, 3), Fraction(-7, 5), Fraction(9)]))),
    }
    return grow[draw(st.sampled_from(["add", "sub", "mul", *grow]))]()


def interpreted(roots: Iterable[Node], values: Mapping[str, Sequence[float]]) -> dict[Node, float]:
    """The value of each node, every operation rounded once, in the order of the nodes."""
    results: dict[Node, float] = {}
    for node in _nodes(roots):
        if node.number is not None:
            results[node] = float(node.number)
        elif node.operation == "input":
            results[node] = values[signal_of(node)][index(node)]
        else:
            results[node] = OPERATIONS[node.operation](*(results[argument] for argument in node.arguments))
    return results


def _nodes(roots: Iterable[Node]) -> list[Node]:
    wanted = list(roots)
    return wanted[0].program.reachable(wanted)


def uncertainty(roots: Iterable[Node], values: Mapping[str, Sequence[float]]) -> dict[Node, float]:
    """A first-order bound of each node's rounding error: two libraries cannot be asked to agree any better."""
    value, error = interpreted(roots, values), dict.fromkeys(interpreted(roots, values), 0.0)
    for node in value:
        given = [(value[argument], error[argument]) for argument in node.arguments]
        if given:
            error[node] = _passed_on(node.operation, given, value[node]) + 2**-51 * abs(value[node])
    return error


def _passed_on(operation: str, given: Sequence[tuple[float, float]], result: float) -> float:
    (a, da), (b, db) = given[0], given[-1]
    if operation == "mul":
        return abs(a) * db + abs(b) * da
    if operation == "div":
        return (da + abs(result) * db) / abs(b)
    if operation == "pow":
        return abs(b * result / a) * da
    if operation in ("sqrt", "log"):
        return da / abs(2 * result if operation == "sqrt" else a)
    if operation == "exp":
        return result * da
    if operation == "sign":
        return math.inf if abs(a) <= da else 0.0
    if operation == "directed":
        return math.inf if abs(b) <= db else da
    return sum(error for _, error in given)


OPERATIONS: dict[str, Callable[..., float]] = {
    "neg": lambda a: -a,
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "sin": math.sin,
    "cos": math.cos,
    "sqrt": math.sqrt,
    "log": math.log,
    "exp": math.exp,
    "tanh": math.tanh,
    "abs": abs,
    "sign": lambda a: float((a > 0) - (a < 0)),
    "directed": lambda size, a: size * float((a > 0) - (a < 0)),
    "pow": math.pow,
}
