"""Uncertainty of coefficients when the shapes are uncertain too: shapes become columns, by how the torque changes.

It knows the noise, not what is wrong in the torque of a shape; two values that should be one tell of that.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import hypot, log

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import ELASTIC, Hypothesis
from identification.diagnosis.columns.normal_equations import inverse
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.refinement import neighbour
from identification.outcome import Value

#: Part of what a swing tells, on a spring or in a gap, of which its model is not sure: it is linear in the deflection.
_LINEAR = 0.01
#: Part of a parameter that the rows must show for it to be known at all.
_SEEN = 0.99


def deviations(
    found: Search, columns: Sequence[int], solution: Array
) -> tuple[Array, Mapping[int, Mapping[str, float]]]:
    """Standard deviations [SI] of p base parameters and of the coefficients of k chosen ``columns`` (p + k), and of
    shapes by name, by the id of their choice.

    ``solution`` (p + k) holds the values of both. What the runs do not show is infinite. A searched shape counts as one
    more parameter, linear about its value.
    """
    base = len(found.bank.base)
    value = dict(zip(columns, solution[base:].tolist(), strict=True))
    shapes = _shape_columns(found, value)
    # Columns of torque at the values found: a compliance and a stiffness differ by sixteen digits in their own units.
    units = [1.0] * base + [abs(one) or 1.0 for one in value.values()] + [one.unit for one in shapes]
    normal = found.weighing.normal
    chosen = [*range(base), *columns]
    T = np.zeros((len(normal.gram), len(units)))
    T[chosen, range(len(chosen))] = 1.0
    for k, one in enumerate(shapes, start=len(chosen)):
        for number, weight in one.change.items():
            T[number, k] += weight
    T *= units
    A = T.T @ normal.whole @ T
    fitted_apart = [one.hypothesis.preset.get(each.name) for one in found.variants for each in one.coefficients]
    preset = {i: (one.std / units[i]) ** 2 for i, one in enumerate(fitted_apart, base) if one is not None}
    std = np.sqrt(variances(A, preset)) * units
    of_shapes: dict[int, dict[str, float]] = {}
    for one, deviation in zip(shapes, std[len(chosen) :].tolist(), strict=True):
        of_shapes.setdefault(one.choice, {})[one.name] = deviation
    return std[: len(chosen)], of_shapes


@dataclass(frozen=True)
class _ShapeColumn:
    """The torque's ``change`` with the shape value ``name`` of a choice (its ``id``), by weights of columns by number;
    ``unit`` is the value's own size.
    """

    choice: int
    name: str
    unit: float
    change: Mapping[int, float]


def _shape_columns(found: Search, value: Mapping[int, float]) -> list[_ShapeColumn]:
    """Of all shape values that are searched, at coefficients ``value`` of the columns by number, by differences."""
    result = []
    for choice in found.choices:
        variant = choice.evidence.variant
        for shape in variant.hypothesis.shapes:
            moved = neighbour(found.weighing, variant, shape) if shape.free else None
            if moved is None:
                continue
            here = variant.shape[shape.name]
            step = moved.shape[shape.name] - here
            change = {
                number: sign * value[own] / step
                for own, other in zip(variant.columns, moved.columns, strict=True)
                for number, sign in ((other, 1.0), (own, -1.0))
            }
            result.append(_ShapeColumn(id(choice), shape.name, abs(here) or 1.0, change))
    return result


def variances(A: Array, preset: Mapping[int, float]) -> Array:
    """Of k coefficients (k) with products ``A`` (k x k) of their columns, over the noise's power; infinite where no row
    shows one.

    Those that are ``preset`` have these variances of their own, by another fit: their errors are in the others', beside
    the noise.
    """
    known = np.array(sorted(preset), dtype=int)
    fitted = np.setdiff1d(np.arange(len(A)), known)
    own = A[np.ix_(fitted, fitted)]
    C, error = inverse(own), np.array([preset[i] for i in known.tolist()])
    moved = C @ A[np.ix_(fitted, known)]
    result = np.empty(len(A))
    result[known] = error
    result[fitted] = np.maximum(np.diag(C), 0.0) + moved**2 @ error
    # What no row shows has no row in the pseudo-inverse's products: nothing is known of it.
    result[fitted[np.diag(C @ own) <= _SEEN]] = np.inf
    return result


def apart(
    hypothesis: Hypothesis, values: Mapping[str, Value], shape: Mapping[str, float], std: Mapping[str, float]
) -> tuple[dict[str, Value], dict[str, float]]:
    """Coefficients, and standard deviations of the ``shape``: those of a swing are never surer than its model is, and
    those that are told twice at least as unsure as the two are apart where their deviations do not explain that.
    """
    coefficients, deviation = dict(values), dict(std)
    if hypothesis.kind == ELASTIC:
        deviation = {name: hypot(one, _LINEAR * shape[name]) for name, one in std.items()}
    for name, (other, power) in hypothesis.twice.items():
        one = coefficients[name]
        if other in deviation:
            one = coefficients[name] = replace(one, std=hypot(one.std, _LINEAR * (one.value or 0.0)))
        if one.value and one.value > 0 and other in deviation:
            part = abs(log(one.value) - power * log(shape[other]))
            if part <= hypot(one.std / one.value, deviation[other] / shape[other]):
                continue
            coefficients[name] = replace(one, std=max(one.std, part * one.value))
            deviation[other] = max(deviation[other], part * shape[other])
    return coefficients, deviation
