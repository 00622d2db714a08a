"""Shapes between the tried ones: Gauss-Newton steps of a variant's coefficients and shape values together.

With torque x_k c_k(s), a step in the shape adds x_k dc_k/ds_i per unit: one more column each, by differences. Shapes
move by their usual steps. Where little speaks for a step it is short (Levenberg 1944).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.columns.normal_equations import inverse
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.weighing import Weighing

#: Steps, the parts of one that are tried, and what of the rank a step must gain.
_STEPS, _PARTS, _GAIN = 6, (1.0, 0.3, 0.1), 0.5
#: Difference by which columns are differentiated, and the longest step, in usual steps.
_DIFFERENCE, _LONGEST = 0.05, 1.0
#: What a usual step must lower the sum of squares by.
_DAMPING = 1.0


def refined(
    weighing: Weighing, variant: Variant, others: Sequence[Variant], steps: int = _STEPS, held: Collection[str] = ()
) -> Variant:
    """The variant with the shape that explains most beside ``others``, in at most so many ``steps``; values that are
    ``held`` by name stay.
    """
    free = [shape for shape in variant.hypothesis.shapes if shape.free and shape.name not in held]
    if not free:
        return variant
    best = weighing.of(variant, others)
    for _ in range(steps):
        again = _better(weighing, best, _ways(weighing, best.variant, free, others), others)
        if again is None:
            break
        best = again
    return best.variant


def _better(
    weighing: Weighing, best: Evidence, ways: Sequence[Mapping[str, float]], others: Sequence[Variant]
) -> Evidence | None:
    """The first that is better than the ``best`` so far: the whole or a part of one of the ``ways``; None where all are
    not.
    """
    for way in ways:
        for part in _PARTS:
            tried = _moved(weighing, best.variant, {name: part * x for name, x in way.items()})
            again = None if tried is None else weighing.of(tried, others)
            if again is not None and again.score > best.score + _GAIN:
                return again
    return None


def _ways(
    weighing: Weighing, variant: Variant, free: Sequence[ShapeRange], others: Sequence[Variant]
) -> list[dict[str, float]]:
    """Of each shape value, in its usual steps: each at its longest, and then the way of the tangent, the longest of
    which is. Where two values hold a third, as stiffness and inertia a frequency, only that stays in the valley.
    """
    neighbours = [(shape, neighbour(weighing, variant, shape)) for shape in free]
    here = variant.shape
    moved = [(shape, one, shape.steps(here[shape.name], one.shape[shape.name])) for shape, one in neighbours if one]
    A, b = tangent(weighing, variant, [(one, steps) for _, one, steps in moved], others)
    k = len(b) - len(moved)
    whole = (inverse(A + np.diag([0.0] * k + [_DAMPING] * len(moved)), 1e-9) @ b)[k:]
    ways, longest = [np.clip(whole, -_LONGEST, _LONGEST)], float(np.abs(whole).max(initial=0.0))
    if len(whole) > 1 and longest > _LONGEST:
        ways.append(whole * _LONGEST / longest)
    return [{shape.name: float(x) for (shape, _, _), x in zip(moved, way, strict=True)} for way in ways]


def tangent(
    weighing: Weighing, variant: Variant, moved: Sequence[tuple[Variant, float]], others: Sequence[Variant]
) -> tuple[Array, Array]:
    """Products A of the unknowns' columns, b with the torque: coefficients, then steps of the shape by which the
    variant was ``moved``.
    """
    x, _ = weighing.beside(variant, others)
    numbers = [*variant.columns, *(number for one, _ in moved for number in one.columns)]
    part = weighing.normal.part(numbers, columns_of(others))
    k = len(x)
    T = np.zeros((len(numbers), k + len(moved)))
    T[:k, :k] = np.eye(k)
    for i, (_, steps) in enumerate(moved):
        T[:k, k + i] = -x / steps
        T[(1 + i) * k : (2 + i) * k, k + i] = x / steps
    return T.T @ part[:-1, :-1] @ T, T.T @ part[:-1, -1]


def neighbour(weighing: Weighing, variant: Variant, shape: ShapeRange) -> Variant | None:
    """With a shape value a little larger, smaller at the upper end; None where neither is possible."""
    here = variant.shape[shape.name]
    for steps in (_DIFFERENCE, -_DIFFERENCE):
        if abs(shape.steps(here, shape.moved(here, steps))) > _DIFFERENCE / 2:
            moved = _moved(weighing, variant, {shape.name: steps})
            if moved is not None:
                return moved
    return None


def _moved(weighing: Weighing, variant: Variant, step: Mapping[str, float]) -> Variant | None:
    """With shape values moved by usual steps; None where that is impossible."""
    shapes = {one.name: one for one in variant.hypothesis.shapes}
    values = {name: shapes[name].moved(variant.shape[name], steps) for name, steps in step.items()}
    moved = weighing.bank.add(variant.hypothesis, {**variant.shape, **values})
    if moved is None:
        return None
    weighing.refresh()
    return moved.only(variant.used)
