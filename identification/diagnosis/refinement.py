"""Shapes between the tried ones: Gauss-Newton steps of a variant's coefficients and shape values together.

With torque x_k c_k(s), a step in the shape adds x_k dc_k/ds_i per unit: one more column each, by differences.
Values that are positive are moved by their logarithms. Where little speaks for a step it is short (Levenberg 1944).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import exp, log

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Variant
from identification.diagnosis.evidence import Weighing, columns_of
from identification.diagnosis.hypothesis import ShapeRange
from identification.diagnosis.normal import inverse

Array = NDArray[np.float64]

#: Steps, the parts of one that are tried, and what of the rank a step must gain.
_STEPS, _PARTS, _GAIN = 6, (1.0, 0.3, 0.1), 0.5
#: Difference by which columns are differentiated, the longest step, and the way beyond the grid, in steps of the grid.
_DIFFERENCE, _LONGEST, _BEYOND = 0.05, 1.0, 1.0
#: Square that a step of the grid must lower the sum of squares by.
_DAMPING = 1.0


def refined(weighing: Weighing, variant: Variant, others: Sequence[Variant]) -> Variant:
    """The variant with the shape that explains most beside ``others``."""
    free = [shape for shape in variant.hypothesis.shapes if not shape.whole and len(shape.grid()) > 2]
    best, score = variant, weighing.of(variant, others).score
    for _ in range(_STEPS if free else 0):
        step = _step(weighing, best, free, others)
        for part in _PARTS:
            tried = _moved(weighing, best, {name: part * x for name, x in step.items()}, free)
            again = score if tried is None else weighing.of(tried, others).score
            if tried is not None and again > score + _GAIN:
                best, score = tried, again
                break
        else:
            break
    return best


def _step(
    weighing: Weighing, variant: Variant, free: Sequence[ShapeRange], others: Sequence[Variant]
) -> dict[str, float]:
    """Of each shape value, in steps of its grid."""
    x, _ = weighing.beside(variant, others)
    beside = [(one.name, _moved(weighing, variant, {one.name: _DIFFERENCE}, free)) for one in free]
    moved = [(name, one) for name, one in beside if one is not None]
    numbers = [*variant.columns, *(number for _, one in moved for number in one.columns)]
    part = weighing.normal.part(numbers, columns_of(others))
    k = len(x)
    # From the columns to the unknowns: the coefficients, and the steps of the shape.
    T = np.zeros((len(numbers), k + len(moved)))
    T[:k, :k] = np.eye(k)
    for i in range(len(moved)):
        T[:k, k + i] = -x / _DIFFERENCE
        T[(1 + i) * k : (2 + i) * k, k + i] = x / _DIFFERENCE
    A = T.T @ part[:-1, :-1] @ T + np.diag([0.0] * k + [_DAMPING] * len(moved))
    solution = inverse(A, 1e-9) @ (T.T @ part[:-1, -1])
    return {name: float(np.clip(solution[k + i], -_LONGEST, _LONGEST)) for i, (name, _) in enumerate(moved)}


def _moved(
    weighing: Weighing, variant: Variant, step: Mapping[str, float], free: Sequence[ShapeRange]
) -> Variant | None:
    """With shape values moved by steps of their grids; None where that is impossible."""
    shape = dict(variant.shape)
    for one in free:
        if one.name in step:
            there, back = _scale(one)
            points = np.sort([there(x) for x in one.grid()])
            unit = float(np.median(np.diff(points)))
            wanted = there(shape[one.name]) + unit * step[one.name]
            shape[one.name] = back(float(np.clip(wanted, points[0] - _BEYOND * unit, points[-1] + _BEYOND * unit)))
    moved = weighing.bank.add(variant.hypothesis, shape)
    if moved is None:
        return None
    weighing.refresh()
    return moved.only(variant.used)


def _scale(shape: ShapeRange) -> tuple[Callable[[float], float], Callable[[float], float]]:
    """To a scale on which the grid is even, and back."""
    return (log, exp) if min(shape.grid()) > 0 else (float, float)
