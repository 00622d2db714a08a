"""Common factors taken out of sums: a b + a c becomes a (b + c) where neither product serves anything else.

Terms that only parameters make are summed apart and parameters that weigh a sum go into its terms, since ``prepare``
does such work once. A product of a sum is multiplied out where each of its terms finds a common factor outside.
Mechanics makes the equations short; this takes the few operations that it leaves. Nothing that is shared is taken
apart, so that no function gets longer.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import chain

from generator.symbolic.sliding import replaced
from generator.symbolic.statements import Node, Program

#: A term of a sum: whether it is subtracted, and what.
Term = tuple[bool, Node]
#: Nodes beyond which one pass is all: a further one takes longer the longer a chain is and gains a thousandth there.
_LONG = 3000


def factored(program: Program, roots: Sequence[Node]) -> list[Node]:
    """The same values as ``roots``, with common factors taken out for as long as that makes them shorter.

    Long chains' functions take one pass.
    """
    shortest = _factored_once(program, roots, program.reachable(roots))
    fewest = _operations(program, shortest)
    while len(nodes := program.reachable(shortest)) <= _LONG:
        ways = [_factored_once(program, shortest, nodes)]
        opened = _opened(program, shortest, nodes)
        if opened != shortest:
            ways.append(_factored_once(program, opened, program.reachable(opened)))
        counts = [_operations(program, way) for way in ways]
        if min(counts) >= fewest:
            break
        fewest = min(counts)
        shortest = ways[counts.index(fewest)]
    return shortest


def _factored_once(program: Program, roots: Sequence[Node], nodes: Sequence[Node]) -> list[Node]:
    """One pass over the ``nodes`` that ``roots`` need."""
    rewriter = _Rewriter(program, _uses(nodes, roots))
    for node in nodes:
        rewriter.rewrite(node)
    return [rewriter.done[root] for root in roots]


def _opened(program: Program, roots: Sequence[Node], nodes: Sequence[Node]) -> list[Node]:
    """The same values with x (f a + g b) as f x a + g x b in sums that have other products with f and with g."""
    openings = _Rewriter(program, _uses(nodes, roots)).openings(nodes)
    return replaced(program, roots, openings) if openings else list(roots)


def _uses(nodes: Sequence[Node], roots: Sequence[Node]) -> Counter[Node]:
    return Counter(chain(roots, chain.from_iterable(node.arguments for node in nodes)))


def _operations(program: Program, roots: Sequence[Node]) -> int:
    return program.count(program.moving(roots)).total


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
        elif node.operation == "mul" and (weighted := self._weighted(*node.arguments)) is not None:
            self.done[node] = weighted
        else:
            arguments = tuple(self.done[argument] for argument in node.arguments)
            same = arguments == node.arguments
            self.done[node] = node if same else self.program.apply(node.operation, arguments)
        if node.name and self.done[node].name is None and self.done[node].arguments:
            self.done[node].name = node.name

    def openings(self, nodes: Sequence[Node]) -> dict[Node, Node]:
        """Products of sums that are worth multiplying out, with what they then are."""
        found: dict[Node, Node] = {}
        for node in nodes:
            if node.operation in ("add", "sub") and not node.parameter_only:
                products = [term for _, term in self._terms(node) if self._is_private_product(term)]
                factors = set(chain.from_iterable(map(self._factors, products)))
                for product in products:
                    if (opened := self._multiplied_out(product, factors)) is not None:
                        found[_size(product)] = opened
        return found

    def _multiplied_out(self, product: Node, factors: set[Node]) -> Node | None:
        """x (f a + g b) as f x a + g x b if f and g are among ``factors``, else None."""
        own = self._factors(product)
        sums = [node for node in own if node.operation in ("add", "sub") and self._single(node)]
        if len(sums) != 1 or sums[0].parameter_only:
            return None
        terms = self._terms(sums[0])
        for _, term in terms:
            if not self._is_private_product(term) or factors.isdisjoint(self._factors(term)):
                return None
        weight = self.program.one
        for factor in own:
            weight = weight if factor is sums[0] else weight * factor
        total = self.program.zero
        for negative, term in terms:
            total = total - weight * term if negative else total + weight * term
        return total

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

    def _weighted(self, weight: Node, node: Node) -> Node | None:
        """p (p1 x + p2 y) as (p p1) x + (p p2) y, None for anything else: products of parameters cost nothing."""
        if node.parameter_only:
            weight, node = node, weight
        inner = self.done[node]
        private = self._single(node) and node.operation in ("add", "sub") and inner.operation in ("add", "sub")
        if not weight.parameter_only or not private:
            return None
        terms = self._terms(node)
        for _, term in terms:
            if not term.parameter_only and not (self._is_private_product(term) and _has_parameter(term)):
                return None
        return self._added([(negative, self.program.multiply(weight, self.done[term])) for negative, term in terms])

    def _sum(self, terms: list[Term]) -> Node:
        still = [(negative, self.done[node]) for negative, node in terms if node.parameter_only]
        moving = [term for term in terms if not term[1].parameter_only]
        total = self._sum_of_moving(moving)
        return total + self._added(still) if still else total

    def _sum_of_moving(self, terms: list[Term]) -> Node:
        places = [place for place, (_, node) in enumerate(terms) if self._is_private_product(node)]
        factors = {place: self._factors(terms[place][1]) for place in places} if len(places) > 1 else {}
        best = _most_common(factors.values())
        if best is None:
            return self._added([(negative, self.done[node]) for negative, node in terms])
        chosen = [place for place, found in factors.items() if best in found]
        bracket = self._added(
            [(terms[k][0] != _negative(terms[k][1]), self._product_without(best, factors[k])) for k in chosen]
        )
        product = self.done[best] * bracket
        rest = [term for place, term in enumerate(terms) if place not in chosen]
        if not rest:
            return product
        return self._sum_of_moving(rest) + product

    def _factors(self, product: Node) -> list[Node]:
        """The factors of a private product, those of private products within it included."""
        inner = _size(product)
        result: list[Node] = []
        for argument in inner.arguments:
            nested = argument.operation == "mul" and self._is_private_product(argument)
            result += self._factors(argument) if nested else [argument]
        return result

    def _product_without(self, factor: Node, factors: Sequence[Node]) -> Node:
        place = factors.index(factor)
        result = self.program.one
        for other in sorted([*factors[:place], *factors[place + 1 :]], key=lambda node: not node.parameter_only):
            result = self.program.multiply(result, self.done[other])
        return result

    def _is_private_product(self, node: Node) -> bool:
        inner = _size(node)
        return inner.operation == "mul" and not inner.parameter_only and self._single(node) and self._single(inner)

    def _added(self, terms: Sequence[Term]) -> Node:
        total = self.program.zero
        for negative, node in terms:
            total = total - node if negative else total + node
        return total


def _most_common(products: Iterable[Iterable[Node]]) -> Node | None:
    """The factor of the most products, of equal ones the earliest; None where none has two."""
    counts = Counter(chain.from_iterable(map(set, products)))
    shared = [factor for factor, count in counts.items() if count > 1]
    return max(shared, key=lambda factor: (counts[factor], -factor.index), default=None)


def _negative(product: Node) -> bool:
    return product.operation == "neg"


def _size(node: Node) -> Node:
    """A node without its sign."""
    return node.arguments[0] if node.operation == "neg" else node


def _has_parameter(product: Node) -> bool:
    return any(argument.parameter_only for argument in _size(product).arguments)
