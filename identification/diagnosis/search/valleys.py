"""Shapes from which the search between the tried ones leads to different ends.

Of an angle and a length that decide together what a balancer does, the best of the tried shapes may lie in the valley
of a worse end: each tried shape that explains more than its neighbours begins one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isclose, tau

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import Key, ShapeRange
from identification.diagnosis.search.likely import balances
from identification.diagnosis.search.refinement import refined
from identification.diagnosis.search.weighing import Weighing

#: Most valleys, and the part of the best tried shape's drop from which another one begins one.
_MOST, _PART = 4, 0.5


class Valleys:
    """The search for shapes between the tried ones, once for each hypothesis and what it stands beside."""

    def __init__(self, weighing: Weighing) -> None:
        self._weighing = weighing
        self._searched: set[tuple[Key, frozenset[Key]]] = set()

    def search(self, variant: Variant, others: Sequence[Variant]) -> None:
        """Adds to the bank shapes that explain most beside ``others``, near ``variant`` and, of a balancer, at the end
        of each valley.
        """
        stands = variant.key, frozenset(one.key for one in others)
        if stands in self._searched:
            return
        self._searched.add(stands)
        begun = self._begun(variant, others) if balances(variant.hypothesis.effect) else []
        for start in [variant, *(one for one in begun if one.shape != variant.shape)]:
            refined(self._weighing, start, others)

    def _begun(self, variant: Variant, others: Sequence[Variant]) -> list[Variant]:
        """Of the shapes of a variant's hypothesis that are tried first, those that explain more than their neighbours,
        the best first.
        """
        weighing, hypothesis = self._weighing, variant.hypothesis
        grids = {shape.name: shape for shape in hypothesis.shapes if shape.free}
        tried = [weighing.bank.add(hypothesis, shape, offered=False) for shape in hypothesis.variants]
        weighing.refresh()
        found = [(weighing.beside(one, others)[1], one) for one in tried if one is not None]
        least = _PART * max((drop for drop, _ in found), default=0.0)
        begun = [
            (drop, one)
            for drop, one in found
            if drop > least and not any(more > drop and _neighbours(one, other, grids) for more, other in found)
        ]
        return [one for _, one in sorted(begun, key=lambda pair: -pair[0])][:_MOST]


def _neighbours(one: Variant, other: Variant, grids: Mapping[str, ShapeRange]) -> bool:
    """Whether two tried shapes differ by one step of one of the ``grids``, and in nothing else."""
    different = [name for name, value in one.shape.items() if other.shape[name] != value]
    if len(different) != 1 or different[0] not in grids:
        return False
    grid = grids[different[0]]
    points = sorted(grid.grid())
    steps = abs(points.index(one.shape[grid.name]) - points.index(other.shape[grid.name]))
    return steps == 1 or (steps == len(points) - 1 and _closed(grid, points))


def _closed(grid: ShapeRange, points: Sequence[float]) -> bool:
    """Whether an angle's points go once around."""
    return grid.unit == "rad" and isclose(points[-1] - points[0] + grid.spacing, tau, rel_tol=1e-3)
