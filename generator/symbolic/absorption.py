"""Effects whose torque the bodies make too: a spring that acts like a weight, say.

Where a column of an effect is a sum of other base columns, no motion can tell its parameter from theirs. It is grouped
with them like any other; its coefficients follow from the columns' numbers, to twelve digits.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.grouping.grouping import BaseParameter, Eliminated, Grouping

#: What is left of a column of unit length, below which it is a sum of the others.
_TOLERANCE = 1e-9
_DIGITS = 12


class NotGrouped(Exception):
    """Why the parameter ``name`` of an effect can be grouped with no other, and what is expected instead."""

    def __init__(self, name: str, problem: str, expected: str) -> None:
        super().__init__(f"{problem}, expected {expected}")
        self.name, self.problem, self.expected = name, problem, expected


def absorbed(
    grouping: Grouping,
    effects: Sequence[str],
    w: Mapping[str, NDArray[np.float64]],
    loading: Collection[str] = (),
    rubbing: Collection[str] = (),
) -> Grouping:
    """The grouping with those of the parameters ``effects`` grouped that the others, and those before them, make too.

    ``w`` holds the column of each standard parameter over random states. Parameters ``loading`` are part of a load that
    a friction reads, and are not grouped with ``rubbing`` ones, which are not. Raises NotGrouped where they would be,
    and for a torque that is zero at all states.
    """
    heads = [base.head for base in grouping.base]
    kept = [head for head in heads if head not in effects]
    span = _orthonormal(w, kept)
    for name in effects:
        size = float(np.linalg.norm(w[name]))
        if name not in heads:
            continue
        if not size:
            problem = f"the torque of {name} vanishes at every speed from 1e-9 on"
            raise NotGrouped(name, problem, "values that leave one")
        rest = w[name] / size
        for _ in range(2):  # once more, for what rounding leaves of the first
            rest = rest - span @ (span.T @ rest)
        if np.linalg.norm(rest) > _TOLERANCE:
            kept.append(name)
            span = np.column_stack([span, rest / np.linalg.norm(rest)])
        else:
            coefficients = _coefficients(w, name, kept)
            pairs = {one: {name, one} for one, x in coefficients.items() if x}
            mixed = [one for one, pair in pairs.items() if pair & {*loading} and pair & {*rubbing}]
            if mixed:
                problem = f"the torque of {name} is one that {_made_by(mixed)} too, and friction by the load"
                raise NotGrouped(name, f"{problem} tells them apart", "one of these effects alone")
            grouping = _grouped(grouping, name, coefficients)
    return grouping


def _made_by(names: Sequence[str]) -> str:
    return f"{' and '.join(names)} make{'s' if len(names) == 1 else ''}"


def _orthonormal(w: Mapping[str, NDArray[np.float64]], names: Sequence[str]) -> NDArray[np.float64]:
    """An orthonormal basis of independent columns."""
    columns = [w[name] / np.linalg.norm(w[name]) for name in names]
    return np.linalg.qr(np.column_stack(columns))[0] if columns else np.zeros((len(next(iter(w.values()))), 0))


def _coefficients(w: Mapping[str, NDArray[np.float64]], name: str, others: Sequence[str]) -> dict[str, sympy.Rational]:
    """The column of ``name`` as a sum of the others, which it is."""
    size = np.linalg.norm(w[name])
    scale = np.array([np.linalg.norm(w[other]) for other in others])
    columns = np.column_stack([w[other] for other in others]) / scale
    solution = np.linalg.lstsq(columns, w[name] / size, rcond=None)[0]
    solution[np.abs(solution) < _TOLERANCE] = 0.0
    exact = (sympy.Rational(f"{value:.{_DIGITS}g}") for value in solution * size / scale)
    return dict(zip(others, exact, strict=True))


def _grouped(grouping: Grouping, name: str, coefficients: Mapping[str, sympy.Rational]) -> Grouping:
    base: list[BaseParameter] = []
    numbers: dict[str, Mapping[str, float]] = {}
    titles: dict[str, str] = {}
    for parameter in grouping.base:
        if parameter.head == name:
            continue
        terms = dict(grouping.numbers[parameter.name])
        coefficient = coefficients.get(parameter.head)
        if coefficient:
            title = parameter.name if not parameter.alone else f"{parameter.name}R"
            titles[parameter.name] = title
            parameter = BaseParameter(title, (*parameter.terms, (coefficient, name)))
            terms[name] = float(coefficient)
        base.append(parameter)
        numbers[parameter.name] = terms
    gone = [replace(one, into=tuple(titles.get(title, title) for title in one.into)) for one in grouping.eliminated]
    into = tuple(titles.values())
    rule = f"its torque is one that {_made_by(into)} too"
    return Grouping(tuple(base), (*gone, Eliminated(name, rule, into)), numbers)
