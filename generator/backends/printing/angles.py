"""Sines and cosines gathered, so that a function computes those of all its angles in one go, side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from generator.backends.printing.identifiers import Identifiers
from generator.backends.printing.straight_line import Step
from generator.symbolic.statements import Node

#: What writes the code: from nodes, the angles' texts and the scope's names to statements and a text for each node.
Writer = Callable[[Sequence[Node], Sequence[Node], Sequence[str], Identifiers], tuple[Sequence[str], Sequence[str]]]

_TRIGONOMETRIC = ("sin", "cos")


def gathered(nodes: Sequence[Node], write: Writer) -> list[Node | Step]:
    """``nodes`` with their sines and cosines brought together, after what these need.

    The angles that depend on no sine or cosine come first, then those that depend on sines and cosines of the first,
    and so on; otherwise the order stays. ``nodes`` have arguments before users; ``write`` is called with the sines and
    cosines, their angles, the text of each angle and the names of the scope.
    """
    depth: dict[Node, int] = {}
    for node in nodes:
        inner = max((depth.get(argument, 0) for argument in node.arguments), default=0)
        depth[node] = inner + (node.operation in _TRIGONOMETRIC)
    result: list[Node | Step] = []
    done: set[Node] = set()
    for level in range(1, max(depth.values(), default=0) + 1):
        together = [node for node in nodes if node.operation in _TRIGONOMETRIC and depth[node] == level]
        if together:
            needed = _needed(together)
            result += [node for node in nodes if node in needed and node not in done]
            angles = tuple(sorted({node.arguments[0] for node in together}, key=lambda node: node.index))
            result.append(Step(angles, tuple(together), partial(write, together, angles)))
            done |= needed | set(together)
    return result + [node for node in nodes if node not in done]


def _needed(together: Sequence[Node]) -> set[Node]:
    """What the angles of ``together`` are computed from, themselves included."""
    found: set[Node] = set()
    pending = [node.arguments[0] for node in together]
    while pending:
        node = pending.pop()
        if node not in found:
            found.add(node)
            pending += node.arguments
    return found
