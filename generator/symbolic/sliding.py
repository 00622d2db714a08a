"""Dry friction with something else in the place of sign(speed): a smooth stand-in, or a direction given from outside.

Whatever effect writes sign(speed) of a surface that slides is meant, on the joints and on the motor side of elastic
ones; the program's nodes are replaced, so that no effect needs to know.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from generator.symbolic.flexible import FlexibleDynamics
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, Nodes


def smooth(program: Program, speeds: Nodes, widths: Nodes) -> list[Node]:
    """x / sqrt(x^2 + width^2) of each speed x: sign(x) but for a few widths about zero.

    A square root and a division, where tanh would be a call into the mathematics library; it nears +-1 more slowly,
    by (width/x)^2 / 2.
    """
    return [x / program.function("sqrt", x * x + width * width) for x, width in zip(speeds, widths, strict=True)]


def surfaces(flexible: FlexibleDynamics) -> list[Node]:
    """Speeds of the surfaces that slide in a flexible model: of each motor, then of the link of each elastic joint."""
    return [*flexible.qd[: flexible.dof], *(flexible.link.qd[joint] for joint in flexible.elastic)]


def sliding(program: Program, outputs: Nodes, speeds: Nodes, directions: Nodes) -> Array:
    """``outputs`` with ``directions`` in the places of the signs of ``speeds``."""
    given = {}
    for speed, direction in zip(speeds, directions, strict=True):
        sign = program.function("sign", speed)
        if sign.operation == "neg":
            sign, direction = sign.arguments[0], -direction
        given[sign] = direction
    return np.array(replaced(program, list(outputs), given), dtype=object)


def replaced(program: Program, roots: Sequence[Node], given: Mapping[Node, Node]) -> list[Node]:
    """``roots`` with the nodes ``given`` replaced."""
    done = dict(given)
    # As they were made: what is deep in a sum stays deep, and printed code keeps its order.
    for node in sorted(program.reachable(roots, known=given), key=lambda n: n.index):
        if any(done[argument] is not argument for argument in node.arguments):
            done[node] = program.apply(node.operation, [done[argument] for argument in node.arguments])
            if node.name and done[node].name is None and done[node].arguments:
                done[node].name = node.name
        else:
            done[node] = node
    return [done[root] for root in roots]
