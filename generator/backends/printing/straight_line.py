"""Nodes to straight-line code: assignments and expressions whose order of rounding is that of the nodes.

A node that a reviewer knows by name keeps it as the name of its variable (of several nodes of one name, the last one
does). Another node is given a variable if it is used more than once or if its user's line would grow too long, and is
written into its user's expression otherwise. A minus never has a variable of its own. A result that has a place is put
there as soon as it is known.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from generator.backends.printing.identifiers import Identifiers
from generator.backends.printing.language import Language
from generator.symbolic.statements import Node

#: How tightly an expression holds together; a minus in front binds as a product, which it may share (-a*b is exact).
_SUM, _PRODUCT, _ATOM = 1, 2, 3
_INFIX = {"add": (" + ", _SUM), "sub": (" - ", _SUM), "mul": ("*", _PRODUCT), "div": ("/", _PRODUCT)}


@dataclass(frozen=True)
class Block:
    """Statements in order, and one expression per root that is valid after them."""

    statements: tuple[str, ...]
    results: tuple[str, ...]


@dataclass(frozen=True)
class Step:
    """Nodes that a language computes together from ``arguments``.

    ``write`` takes the arguments' texts and the names of the scope; it returns statements and the text of each node.
    """

    arguments: tuple[Node, ...]
    nodes: tuple[Node, ...]
    write: Callable[[Sequence[str], Identifiers], tuple[Sequence[str], Sequence[str]]]


class _Text(NamedTuple):
    text: str
    binding: int


def straight_line(
    nodes: Sequence[Node | Step],
    roots: Sequence[Node],
    leaves: Mapping[Node, str],
    language: Language,
    names: Identifiers,
    places: Mapping[Node, Sequence[str]] | None = None,
) -> Block:
    """The code that computes ``roots``.

    ``nodes`` are in order, arguments before users; ``leaves`` gives the text of every node that is not computed here
    (inputs, and what was computed elsewhere). ``names`` holds the names already taken in the scope. ``places`` are
    variables that take the value of a computed root.
    """
    printer = _Printer(nodes, roots, leaves, language, names, places or {})
    for node in nodes:
        if isinstance(node, Step):
            printer.together(node)
        elif node not in leaves and node.operation != "constant":
            printer.visit(node)
    return Block(tuple(printer.statements), tuple(printer.text(root).text for root in roots))


class _Printer:
    def __init__(
        self,
        nodes: Sequence[Node | Step],
        roots: Sequence[Node],
        leaves: Mapping[Node, str],
        language: Language,
        names: Identifiers,
        places: Mapping[Node, Sequence[str]],
    ) -> None:
        self.statements: list[str] = []
        self._language = language
        self._names = names
        self._places = places
        self._uses = _uses(nodes, roots, leaves)
        # a recursion that starts from rest names terms of the complete quantity like the whole, which comes later
        single = [node for node in nodes if not isinstance(node, Step)]
        self._named = {node.name: node for node in single if node.name is not None and node not in leaves}
        self._texts = {node: _Text(text, _ATOM) for node, text in leaves.items()}
        self._placed = set(leaves)

    def visit(self, node: Node) -> None:
        text = self._compose(node)
        if node.operation == "neg":
            self._texts[node] = text
        elif node.name is not None and self._named[node.name] is node:
            self._assign(node, text, self._names.claim(node.name))
        elif self._uses[node] > 1:
            self._assign(node, text, self._names.temporary())
        else:
            self._texts[node] = text
        self._put(node)

    def together(self, step: Step) -> None:
        statements, results = step.write([self.text(argument).text for argument in step.arguments], self._names)
        self.statements += statements
        self._texts |= {node: _Text(text, _ATOM) for node, text in zip(step.nodes, results, strict=True)}
        self._placed |= set(step.nodes)
        for node in step.nodes:
            self._put(node)

    def _put(self, node: Node) -> None:
        self.statements += [f"{place} = {self.text(node).text};" for place in self._places.get(node, ())]

    def text(self, node: Node) -> _Text:
        if node.number is None:
            return self._texts[node]
        literal = self._language.number(abs(node.number))
        return _Text(f"-{literal}", _PRODUCT) if node.number < 0 else _Text(literal, _ATOM)

    def _assign(self, node: Node, text: _Text, name: str) -> None:
        self.statements.append(self._language.assign(name, text.text))
        self._texts[node] = _Text(name, _ATOM)
        self._placed.add(node)

    def _compose(self, node: Node) -> _Text:
        """The node's expression; while it is too long, its longest written-in argument becomes a temporary."""
        text = self._expression(node)
        while len(text.text) > self._language.width:
            written_in = [a for a in node.arguments if a.number is None and not self._is_placed(a)]
            if not written_in:
                break
            longest = max(written_in, key=lambda a: len(self.text(a).text))
            computed = _computed(longest)
            self._assign(computed, self._expression(computed), self._names.temporary())
            if longest is not computed:
                self._texts[longest] = self._expression(longest)
            text = self._expression(node)
        return text

    def _is_placed(self, node: Node) -> bool:
        return node in self._placed or _computed(node) in self._placed

    def _expression(self, node: Node) -> _Text:
        if node.operation == "neg":
            return self._negative(node.arguments[0])
        if node.operation in _INFIX:
            sign, binding = _INFIX[node.operation]
            left, right = node.arguments
            return _Text(f"{self._within(left, binding)}{sign}{self._within(right, binding + 1)}", binding)
        if node.operation == "directed" and node.operation not in self._language.calls:
            size, of = self._within(node.arguments[0], _PRODUCT), self.text(node.arguments[1]).text
            return _Text(f"{size}*{self._language.calls['sign']}({of})", _PRODUCT)
        arguments = ", ".join(self.text(argument).text for argument in node.arguments)
        return _Text(f"{self._language.calls[node.operation]}({arguments})", _ATOM)

    def _negative(self, argument: Node) -> _Text:
        text = self.text(argument)
        if argument.operation == "sub" and text.binding == _SUM:
            left, right = argument.arguments
            return _Text(f"{self._within(right, _SUM)} - {self._within(left, _PRODUCT)}", _SUM)
        return _Text(f"-{self._within(argument, _PRODUCT)}", _PRODUCT)

    def _within(self, node: Node, binding: int) -> str:
        text = self.text(node)
        return text.text if text.binding >= binding else f"({text.text})"


def _computed(node: Node) -> Node:
    return node.arguments[0] if node.operation == "neg" else node


def _uses(nodes: Sequence[Node | Step], roots: Sequence[Node], leaves: Mapping[Node, str]) -> Counter[Node]:
    """How often each node is written; a minus is no use of its own but passes its users on."""
    uses = Counter(roots)
    for node in reversed(nodes):
        if isinstance(node, Step):
            uses.update(node.arguments)
            continue
        if node in leaves:
            continue
        times = uses[node] if node.operation == "neg" else 1
        for argument in node.arguments:
            uses[argument] += times
    return uses
