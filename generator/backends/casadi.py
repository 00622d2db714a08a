"""CasADi: a module that builds every quantity as a ``casadi.Function``, those functions saved, and an external."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from generator.backends.printing.identifiers import PYTHON_RESERVED
from generator.backends.printing.language import Language
from generator.backends.printing.python_functions import PythonFunction, module_constants, python_function
from generator.backends.printing.templates import render
from generator.symbolic.function import Signal
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "casadi"

_LANGUAGE = Language(
    calls={
        "sin": "ca.sin",
        "cos": "ca.cos",
        "sqrt": "ca.sqrt",
        "log": "ca.log",
        "exp": "ca.exp",
        "tanh": "ca.tanh",
        "abs": "ca.fabs",
        "sign": "ca.sign",
        "pow": "ca.power",
    },
    statement="{name} = {value}",
    literal="{value}",
    reserved=PYTHON_RESERVED | {"ca"},
    argument="in_{name}",
)


def emit(model: Model) -> dict[str, str | bytes]:
    """The module, every function saved as ``functions/<name>.casadi``, and the source of the external."""
    name = model.robot.name
    functions = [python_function(function, model, _LANGUAGE) for function in model.functions.values()]
    module = render("casadi/module.py.jinja", version=VERSION, functions=functions, **module_constants(model))
    files: dict[str, str | bytes] = {f"{name}.py": module, f"{name}_casadi.c": _external(model, functions)}
    return files | {f"functions/{key}.casadi": value for key, value in _saved(module, name).items()}


@dataclass(frozen=True)
class Port:
    """An input or output of an external: a dense matrix, column-major in CasADi and row-major in the C library."""

    name: str
    rows: int
    columns: int


@dataclass(frozen=True)
class External:
    """A C function with CasADi's calling convention."""

    name: str
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]


def _port(signal: Signal) -> Port:
    """A vector is a column; the leading dimensions of an array are merged."""
    columns = signal.shape[-1] if len(signal.shape) > 1 else 1
    return Port(signal.name, signal.size // columns, columns)


def _external(model: Model, functions: Sequence[PythonFunction]) -> str:
    externals = [
        External(
            function.name,
            tuple(_port(argument.signal) for argument in function.inputs),
            tuple(_port(output.signal) for output in function.outputs),
        )
        for function in functions
    ]
    ports = [port for external in externals for port in (*external.inputs, *external.outputs)]
    return render(
        "casadi/external.c.jinja",
        version=VERSION,
        robot=model.robot,
        macro=model.robot.name.upper(),
        externals=externals,
        shapes=sorted({(port.rows, port.columns) for port in ports}),
    )


def _saved(source: str, name: str) -> dict[str, bytes]:
    """Every function of a generated module, built by running it, as the bytes that ``casadi.Function.load`` reads."""
    module = ModuleType(name)
    exec(compile(source, f"{name}.py", "exec"), module.__dict__)
    saved = {}
    with tempfile.TemporaryDirectory() as folder:
        for key, function in module.functions().items():
            path = Path(folder) / f"{key}.casadi"
            function.save(str(path))
            saved[key] = path.read_bytes()
    return saved
