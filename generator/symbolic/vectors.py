"""Vectors and matrices of program nodes: numpy object arrays, with the products that numpy lacks for them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generator.symbolic.statements import Node, Program

#: An array of nodes; numpy cannot type the elements of object arrays.
Array = NDArray[Any]

#: One node per joint, as an array or any other sequence.
Nodes = Array | Sequence[Node]


def array(program: Program, rows: Sequence[Any]) -> Array:
    """The array of nodes with the shape of nested ``rows`` of nodes and exact numbers."""
    plain = np.array(rows, dtype=object)
    flat = [program.node(entry) for entry in plain.ravel()]
    result = np.empty(len(flat), dtype=object)
    result[:] = flat
    return result.reshape(plain.shape)


def zeros(program: Program, *shape: int) -> Array:
    """An array of that shape of the program's zero."""
    return np.full(shape, program.zero, dtype=object)


def identity(program: Program, size: int) -> Array:
    """The unit matrix (size x size)."""
    return array(program, np.eye(size, dtype=int).tolist())


def cross(a: Array, b: Array) -> Array:
    """The cross product of two 3-vectors."""
    product = np.empty(3, dtype=object)
    product[:] = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return product


def dot(a: Array, b: Array) -> Node:
    """The scalar product of two vectors."""
    product: Any = a @ b
    node: Node = product
    return node


def skew(a: Array) -> Array:
    """The matrix of the cross product: skew(a) b = a x b."""
    zero = a[0].program.zero
    return np.array([[zero, -a[2], a[1]], [a[2], zero, -a[0]], [-a[1], a[0], zero]], dtype=object)


def named(prefix: str, frame: int, values: Array) -> Array:
    """Gives the entries of a frame's vector or matrix the name a reviewer reads, ``W3_2``: quantity, frame, component.

    A trailing n tells that the negative is what is computed.
    """
    for place, node in np.ndenumerate(values):
        _name_node(node, f"{prefix}{frame}_{''.join(str(index + 1) for index in place)}")
    return values


def _name_node(node: Node, name: str) -> None:
    """Names a computed node; leaves, and nodes that have a name, keep theirs."""
    target, suffix = (node.arguments[0], "n") if node.operation == "neg" else (node, "")
    if target.arguments and target.name is None:
        target.name = name + suffix
