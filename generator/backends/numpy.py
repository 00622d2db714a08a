"""NumPy: a module of plain functions, vectorised over samples."""

from __future__ import annotations

from generator.backends.printing.identifiers import PYTHON_RESERVED
from generator.backends.printing.language import Language
from generator.backends.printing.python_functions import module_constants, python_function
from generator.backends.printing.templates import render
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "numpy"

_LANGUAGE = Language(
    calls={
        "sin": "np.sin",
        "cos": "np.cos",
        "sqrt": "np.sqrt",
        "log": "np.log",
        "exp": "np.exp",
        "tanh": "np.tanh",
        "abs": "np.abs",
        "sign": "np.sign",
        "pow": "np.power",
    },
    statement="{name} = {value}",
    literal="{value}",
    reserved=PYTHON_RESERVED | {"np", "samples"},
)


def emit(model: Model) -> dict[str, str | bytes]:
    """The module, by its path."""
    functions = [python_function(function, model, _LANGUAGE) for function in model.functions.values()]
    text = render("numpy/module.py.jinja", version=VERSION, functions=functions, **module_constants(model))
    return {f"{model.robot.name}.py": text}
