"""Python: a class on the compiled C library, whose methods read and write NumPy arrays in place."""

from __future__ import annotations

from dataclasses import dataclass

from generator.backends.printing.identifiers import C_RESERVED, PYTHON_RESERVED, Identifiers
from generator.backends.printing.language import LINE
from generator.backends.printing.many_samples import DYNAMICS, REGRESSOR, of_many_samples
from generator.backends.printing.observation import layout
from generator.backends.printing.plants import plants, turns_rotors
from generator.backends.printing.prepared import prepare
from generator.backends.printing.python_functions import module_constants
from generator.backends.printing.runge_kutta import METHODS
from generator.backends.printing.signals import documented, listed
from generator.backends.printing.templates import render
from generator.symbolic.function import Function, Signal
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "python"

_RESERVED = PYTHON_RESERVED | {"self", "out", "np"}


@dataclass(frozen=True)
class Argument:
    """A signal as an argument or a result of a method."""

    name: str
    signal: Signal


@dataclass(frozen=True)
class Method:
    """A quantity as a method: its documentation in lines, its arguments and results."""

    name: str
    documentation: tuple[str, ...]
    inputs: tuple[Argument, ...]
    outputs: tuple[Argument, ...]


def emit(model: Model) -> dict[str, str | bytes]:
    """The module, by its path; nothing for a model without the functions that the batch functions are made of."""
    if not {DYNAMICS, REGRESSOR} <= model.functions.keys():
        return {}
    structure = model.functions[REGRESSOR].sparsity
    assert structure is not None
    context = {
        "version": VERSION,
        "methods": [_method(function) for function in model.functions.values()],
        "prefix": model.robot.name,
        "plants": plants(model),
        "drives": turns_rotors(model),
        "integrators": METHODS,
        "many": of_many_samples(model),
        "width": len(model.base_parameters),
        "work": layout(structure).work,
        "parameter_count": len(model.parameters),
        "prepared_count": len(prepare(model.functions.values(), model.parameters, C_RESERVED).fields),
        "defaults": listed((repr(float(value)) for value in model.default_parameters()), LINE - 4),
    }
    return {f"{model.robot.name}.py": render("python/module.py.jinja", **context, **module_constants(model))}


def _method(function: Function) -> Method:
    names = Identifiers(_RESERVED)
    inputs = tuple(Argument(names.claim(signal.name), signal) for signal in function.inputs)
    outputs = tuple(Argument(names.claim(output.signal.name), output.signal) for output in function.outputs)
    read, made = ([(one.name, one.signal) for one in arguments] for arguments in (inputs, outputs))
    return Method(function.name, documented(function, read, made, LINE - 12), inputs, outputs)
