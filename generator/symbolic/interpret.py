"""Numbers for a function, by walking its nodes: for checks, pictures and single states; backends are for speed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.symbolic.function import Function
from generator.symbolic.statements import Node

_UNARY = {
    "neg": np.negative,
    "sin": np.sin,
    "cos": np.cos,
    "sqrt": np.sqrt,
    "log": np.log,
    "exp": np.exp,
    "tanh": np.tanh,
    "abs": np.abs,
    "sign": np.sign,
}
_BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "pow": np.power,
    "directed": lambda size, x: size * np.sign(x),
}


def evaluate(function: Function, inputs: Mapping[str, ArrayLike]) -> dict[str, NDArray[np.float64]]:
    """Outputs by name, each of shape (..., *signal.shape), for inputs of shape (..., size) in SI units.

    Leading axes are samples and must agree or broadcast. ``parameters`` is one of the inputs where the function uses
    them. Raises KeyError for an input that is missing.
    """
    values = evaluate_nodes(function.nodes, inputs)
    result = {}
    for output in function.outputs:
        columns = np.broadcast_arrays(*(values[node] for node in output.nodes))
        stacked = np.stack(columns, axis=-1).astype(float)
        result[output.signal.name] = stacked.reshape(stacked.shape[:-1] + output.signal.shape)
    return result


def evaluate_nodes(nodes: list[Node], inputs: Mapping[str, ArrayLike]) -> dict[Node, Any]:
    """Value of each node; arguments must come before their users."""
    signals = {name: np.asarray(value, dtype=float) for name, value in inputs.items()}
    values: dict[Node, Any] = {}
    for node in nodes:
        if node.operation == "constant":
            values[node] = float(node.value)  # type: ignore[arg-type]
        elif node.operation == "input":
            name, place = node.source
            values[node] = signals[name][..., place]
        elif node.operation in _UNARY:
            values[node] = _UNARY[node.operation](values[node.arguments[0]])
        else:
            a, b = node.arguments
            values[node] = _BINARY[node.operation](values[a], values[b])
    return values
