"""Common factors taken out of sums: a b + a c becomes a (b + c) where neither product serves anything else.

Mechanics makes the equations short; this takes the few multiplications that it leaves. Nothing that is shared is taken
apart, so that no function gets longer.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from generator.symbolic.statements import Node, Program

#: A term of a sum: whether it is subtracted, and what.
Term = tuple[bool, Node]


def factored(program: Program, roots: Sequence[Node]) -> list[Node]:
    """The same values as ``roots``, with common factors taken out."""
    nodes = program.reachable(roots)
    uses: Counter[Node] = Counter(roots)
    for node in nodes:
        uses.update(node.arguments)
    rewriter = _Rewriter(program, uses)
    for node in nodes:
        rewriter.rewrite(node)
    return [rewriter.done[root] for root in roots]


@dataclass
class _Rewriter:
    program: Program
    uses: Counter[Node]
    done: dict[Node, Node] = field(default_factory=dict)

    def rewrite(self, node: Node) -> None:
        """Enters the new form of ``node``; its arguments are in ``done``."""
        if node.parameter_only or not node.arguments:
            self.done[node] = node
        elif node.operation in ("add", "sub"):
            self.done[node] = self._sum(self._terms(node))
        else:
            self.done[node] = self.program.apply(node.operation, [self.done[a] for a in node.arguments])
        if node.name and self.done[node].name is None and self.done[node].arguments:
            self.done[node].name = node.name

    def _terms(self, node: Node, negative: bool = False) -> list[Term]:
        """The terms of a sum, those of sums within it that serve nothing else included."""
        terms: list[Term] = []
        for place, argument in enumerate(node.arguments):
            subtracted = negative != (node.operation == "sub" and place == 1)
            inner, turned = (argument.arguments[0], True) if argument.operation == "neg" else (argument, False)
            inside = inner.operation in ("add", "sub") and not inner.parameter_only
            if inside and self._single(argument) and self._single(inner):
                terms += self._terms(inner, subtracted != turned)
            else:
                terms.append((subtracted, argument))
        return terms

    def _single(self, node: Node) -> bool:
        return self.uses[node] == 1

    def _sum(self, terms: list[Term]) -> Node:
        products = [(place, term) for place, term in enumerate(terms) if self._is_private_product(term[1])]
        counts: Counter[Node] = Counter()
        for _, (_, product) in products:
            counts.update(set(_factors(product)))
        best = max(counts, key=lambda factor: (counts[factor], -factor.index), default=None)
        if best is None or counts[best] < 2:
            return self._added([(negative, self.done[node]) for negative, node in terms])
        chosen = {place for place, (_, product) in products if best in _factors(product)}
        picked = [terms[place] for place in sorted(chosen)]
        inner = [(negative != _negative(term), _other(term, best)) for negative, term in picked]
        bracket = self._added([(negative, self.done[node]) for negative, node in inner])
        product = self.done[best] * bracket
        rest = [term for place, term in enumerate(terms) if place not in chosen]
        if not rest:
            return product
        return self._sum(rest) + product

    def _is_private_product(self, node: Node) -> bool:
        inner = node.arguments[0] if node.operation == "neg" else node
        return inner.operation == "mul" and not inner.parameter_only and self._single(node) and self._single(inner)

    def _added(self, terms: Sequence[Term]) -> Node:
        total = self.program.zero
        for negative, node in terms:
            total = total - node if negative else total + node
        return total


def _negative(product: Node) -> bool:
    return product.operation == "neg"


def _factors(product: Node) -> tuple[Node, ...]:
    inner = product.arguments[0] if product.operation == "neg" else product
    return inner.arguments


def _other(product: Node, factor: Node) -> Node:
    inner = product.arguments[0] if product.operation == "neg" else product
    first, second = inner.arguments
    return second if first is factor else first
