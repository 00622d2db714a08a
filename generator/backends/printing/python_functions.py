"""Quantities as functions of a Python module: what NumPy and CasADi share.

The inputs are unpacked into one variable per entry: a parameter under its own name, entry k of another signal as the
signal's name with k counted from 1 (``q1``, ``wrench6``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

from generator.backends.printing.identifiers import Identifiers
from generator.backends.printing.language import LINE, Language
from generator.backends.printing.prepared import index, signal_of
from generator.backends.printing.signals import documented, listed
from generator.backends.printing.straight_line import Block, straight_line
from generator.robot.parameters import Parameter
from generator.symbolic.function import PARAMETERS, Function, Signal
from generator.symbolic.model import STANDARD, Model
from generator.symbolic.parameter_sets import resolved_sets
from generator.symbolic.statements import Node


@dataclass(frozen=True)
class Input:
    """An input signal as an argument: the variables that are read of it, and their places in it."""

    signal: Signal
    name: str
    variables: tuple[str, ...]
    places: tuple[int, ...]

    def unpacked(self, argument: str) -> list[str]:
        """The statement that fills the variables from ``argument``, in lines."""
        names = f"({self.variables[0]},)" if len(self.variables) == 1 else ", ".join(self.variables)
        given = [argument, *map(str, self.places)] if len(self.places) < self.signal.size else [argument]
        line = f"{names} = _entries({', '.join(given)})"
        if len(line) <= LINE - 4:
            return [line]
        rows = [[f"    {row}" for row in listed(items, LINE - 8)] for items in (self.variables, given)]
        return ["(", *rows[0], ") = _entries(", *rows[1], ")"]


@dataclass(frozen=True)
class Result:
    """An output signal with the lines of its tuple of entries, row-major."""

    signal: Signal
    name: str
    entries: tuple[str, ...]


@dataclass(frozen=True)
class PythonFunction:
    """``source`` in Python: unpack ``inputs``, run ``statements``, pack ``outputs``."""

    source: Function
    documentation: tuple[str, ...]
    inputs: tuple[Input, ...]
    statements: tuple[str, ...]
    outputs: tuple[Result, ...]

    @property
    def name(self) -> str:
        """Name of the function: that of the quantity."""
        return self.source.name


def python_function(function: Function, model: Model, language: Language) -> PythonFunction:
    """One quantity; the parameters are its first input where it uses them."""
    nodes = function.nodes
    read = [node for node in nodes if node.operation == "input"]
    signals = list(function.inputs)
    if any(signal_of(node) == PARAMETERS for node in read):
        signals.insert(0, parameter_signal(model))
    names = Identifiers(language.reserved)
    arguments = {signal.name: names.claim(language.argument.format(name=signal.name)) for signal in signals}
    results = [names.claim(output.signal.name) for output in function.outputs]
    leaves = {node: names.claim(_entry(node, model)) for node in sorted(read, key=lambda n: (signal_of(n), index(n)))}
    block = straight_line(nodes, function.roots, leaves, language, names)
    inputs = tuple(_input(signal, arguments[signal.name], leaves) for signal in signals)
    given, made = ([(one.name, one) for one in each] for each in (signals, [one.signal for one in function.outputs]))
    documentation = documented(function, given, made, LINE - 8)
    return PythonFunction(function, documentation, inputs, block.statements, tuple(_results(function, results, block)))


def parameter_signal(model: Model) -> Signal:
    """The parameter vector as an input signal."""
    units = tuple(parameter.unit for parameter in model.parameters)
    return Signal(PARAMETERS, (len(units),), units, "parameters, in the order of PARAMETERS")


def module_constants(model: Model) -> dict[str, object]:
    """What a template of a Python module needs besides its functions: names of parameters, sets, sparsities."""

    def quoted(parameters: Sequence[Parameter]) -> list[str]:
        return listed((f'"{parameter.name}"' for parameter in parameters), LINE - 4)

    return {
        "robot": model.robot,
        "parameters": quoted(model.parameters),
        "base_parameters": quoted(model.base_parameters),
        "built_in": bool(model.constants),
        "standard_parameters": quoted(model.standard_parameters),
        "parameter_sets": {
            name: listed((repr(float(values.get(p.name, 0.0))) for p in model.parameters), LINE - 8)
            for name, values in resolved_sets(model).items()
        },
        "sparsities": {
            name: (listed(map(str, pattern.rows), LINE - 8), listed(map(str, pattern.columns), LINE - 8))
            for name, function in model.functions.items()
            if (pattern := function.sparsity) is not None
        },
    }


def _entry(node: Node, model: Model) -> str:
    by_name = {PARAMETERS: model.parameters, STANDARD: model.standard_parameters}
    named = by_name.get(signal_of(node))
    return named[index(node)].name if named else f"{signal_of(node)}{index(node) + 1}"


def _input(signal: Signal, name: str, leaves: dict[Node, str]) -> Input:
    read = {index(node): variable for node, variable in leaves.items() if signal_of(node) == signal.name}
    return Input(signal, name, tuple(read.values()), tuple(read))


def _results(function: Function, names: Sequence[str], block: Block) -> list[Result]:
    entries = iter(block.results)
    return [
        Result(output.signal, name, tuple(listed(islice(entries, output.signal.size), LINE - 16)))
        for output, name in zip(function.outputs, names, strict=True)
    ]
