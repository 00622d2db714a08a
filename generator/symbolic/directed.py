"""Dry friction without a product: a parameter times sign(speed) is the parameter, its negative or zero."""

from __future__ import annotations

from collections.abc import Sequence

from generator.symbolic.sliding import replaced
from generator.symbolic.statements import Node, Program


def directed(program: Program, roots: Sequence[Node]) -> list[Node]:
    """The same values as ``roots``, with ``directed`` in the place of products of a parameter and a moving sign."""
    products = (node for node in program.reachable(roots) if node.operation == "mul" and not node.parameter_only)
    given: dict[Node, Node] = {}
    for node in products:
        for size, sign in (node.arguments, node.arguments[::-1]):
            if size.parameter_only and sign.operation == "sign":
                given[node] = program.directed(size, sign.arguments[0])
    return replaced(program, roots, given) if given else list(roots)
