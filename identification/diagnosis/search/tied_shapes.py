"""Other shapes that all of an effect has: how much has the shape that was found is as much as there is of the effect.

The columns of another shape are what it makes beyond the file's. A part of the effect with another shape than the rest
would be another law: with its coefficients tied to the file's own, all of it changes.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import numpy as np
from scipy.optimize import minimize

from identification.arrays import Array
from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.growing import Products
from identification.diagnosis.columns.hypothesis import SHAPE, Hypothesis, reshaped
from identification.diagnosis.columns.normal_equations import inverse, square
from identification.diagnosis.search.weighing import Weighing

#: How far the part of an effect that has another shape may be from all of it, and the same in standard deviations.
_WHOLE, _CHANCE = 0.25, 3.0
#: Shapes that are tried for each value that is searched, and the first steps between them, in usual ones.
_TRIED, _STEP = 40, 0.5
#: Most forms of a shape that are refined.
_FORMS = 3


def tied_cost(weighing: Weighing, chosen: Sequence[Variant]) -> float:
    """``Weighing.cost`` of what was ``chosen`` with the coefficients of other shapes tied to the file's, which then are
    no values of their own.
    """
    return _tied_cost(weighing, chosen, _products(weighing, chosen))


def _products(weighing: Weighing, chosen: Sequence[Variant]) -> Array:
    """Of the base columns, of those that are ``chosen`` and of the torque."""
    at = [*weighing.normal.numbers(columns_of(chosen)), len(weighing.normal.gram) - 1]
    return weighing.normal.products(at, at)


def _tied_cost(weighing: Weighing, chosen: Sequence[Variant], G: Array) -> float:
    T = np.eye(len(G))
    ties = _ties(weighing, chosen)
    for i, place in ties:
        T[i, place] = 1.0
        T[i, i] = 0.0
    A = T.T @ G @ T
    left = A[-1, -1] - A[-1, :-1] @ inverse(A[:-1, :-1]) @ A[:-1, -1]
    return float(left) + sum(map(weighing.price, chosen)) - len(ties) * float(np.log(weighing.normal.rows))


def best_tied(weighing: Weighing, hypothesis: Hypothesis, beside: Sequence[Variant]) -> Variant | None:
    """A hypothesis of another shape with the values that cost least ``beside`` others where it is tied; None without a
    possible one. Of shapes that are not searched between the tried ones the best few are refined apart.
    """
    forms: dict[tuple[float, ...], list[tuple[float, Variant]]] = {}
    apart = [shape.name for shape in hypothesis.shapes if not shape.free]
    for one in (each for each in weighing.bank.variants if each.key == hypothesis.key):
        form = tuple(one.shape[name] for name in apart)
        forms.setdefault(form, []).append((tied_cost(weighing, [*beside, one]), one))
    begun = sorted((min(each, key=_cost) for each in forms.values()), key=_cost)[:_FORMS]
    refined = [refined_tied(weighing, one, beside) for _, one in begun]
    return min(refined, key=lambda one: tied_cost(weighing, [*beside, one]), default=None)


def _cost(one: tuple[float, Variant]) -> float:
    return one[0]


def refined_tied(weighing: Weighing, start: Variant, beside: Sequence[Variant]) -> Variant:
    """A variant of another shape with the values between the tried ones that cost least ``beside`` others where it is
    tied.
    """
    hypothesis, chosen = start.hypothesis, [*beside, start]
    free = [shape for shape in hypothesis.shapes if shape.free]
    best, least = start.shape, tied_cost(weighing, chosen)
    known, numbers = _products(weighing, beside), weighing.normal.numbers(columns_of(beside))

    def cost(steps: Array) -> float:
        nonlocal best, least
        pairs = zip(free, steps.tolist(), strict=True)
        shape = {**start.shape, **{one.name: one.moved(start.shape[one.name], x) for one, x in pairs}}
        found = weighing.bank.products(hypothesis, shape, numbers, weighing.train)
        if found is None:
            return inf
        result = _tied_cost(weighing, chosen, _with_more(known, found, start.used))
        if result < least:
            best, least = shape, result
        return result

    if not free:
        return start
    zero = np.zeros(len(free))
    simplex = np.vstack([zero, _STEP * np.eye(len(free))])
    options = {"maxfev": _TRIED * len(free), "initial_simplex": simplex, "xatol": 1e-2, "fatol": 0.1}
    minimize(cost, zero, method="Nelder-Mead", options=options)
    found = weighing.bank.add(hypothesis, best, offered=False)
    weighing.refresh()
    return start if found is None else found.only(start.used)


def _with_more(G: Array, found: Array, used: Sequence[int]) -> Array:
    """Products with columns more, of all those ``found`` (``Bank.products``) with the ``used`` ones."""
    products, old = Products(G.copy()), len(G) - 1
    grown = products.join(len(found))
    grown[old:-1], grown[:, old:-1] = found, found.T
    return square(grown, np.array([*range(old), *(old + i for i in used), len(grown) - 1]))


def whole(weighing: Weighing, one: Variant, chosen: Sequence[Variant]) -> bool:
    """Whether ``one`` of those that are ``chosen`` is of all of its effect, as far as the rows show what else there is
    of it.
    """
    if one.hypothesis.kind != SHAPE:
        return True
    solution, covariance = weighing.fitted(chosen)
    numbers = [*range(len(weighing.bank.base)), *columns_of(chosen)]
    pairs = [(i, place) for i, place in _ties(weighing, chosen) if numbers[i] in one.columns]
    most = max((abs(solution[i]) for i, _ in pairs), default=0.0)
    for i, place in pairs:
        # Of a torque that all rows together hardly hold nothing is told by them.
        if most**2 * weighing.normal.gram[place, place] < _CHANCE**2:
            continue
        variance = covariance[i, i] + covariance[place, place] - 2 * covariance[i, place]
        if abs(solution[i] - solution[place]) > _WHOLE * most + _CHANCE * float(np.sqrt(max(variance, 0.0))):
            return False
    return True


def _ties(weighing: Weighing, chosen: Sequence[Variant]) -> list[tuple[int, int]]:
    """Places, among the base and the columns of those ``chosen``, of coefficients of another shape, and of the base
    parameters that they are to be as large as.
    """
    base = weighing.bank.base
    place = {reshaped(name): k for k, name in enumerate(base)}
    shaped = [one.hypothesis.kind == SHAPE for one in chosen for _ in one.columns]
    names = [each.name for one in chosen for each in one.coefficients]
    return [
        (len(base) + k, place[name])
        for k, (name, is_shape) in enumerate(zip(names, shaped, strict=True))
        if is_shape and name in place
    ]
