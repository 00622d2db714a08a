"""Effects whose torque the bodies make too: a spring that acts like a weight, say.

Where a column of an effect is a sum of other base columns, no motion can tell its parameter from theirs. It is grouped
with them like any other; its coefficients follow from the columns' numbers, to twelve digits.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.errors import InputError, Place
from generator.grouping.grouping import BaseParameter, Eliminated, Grouping

#: What is left of a column of unit length, below which it is a sum of the others.
_TOLERANCE = 1e-9
_DIGITS = 12


def absorbed(
    grouping: Grouping,
    effects: Sequence[str],
    w: Mapping[str, NDArray[np.float64]],
    loaded: Mapping[str, Place],
) -> Grouping:
    """The grouping with those of the parameters ``effects`` grouped that the others, and those before them, make too.

    ``w`` holds the column of each standard parameter over random states. ``loaded`` are those among the parameters
    whose columns depend on the load, with where the file asks for them: no constant coefficient groups them.

    Raises InputError for one of them that other parameters imitate.
    """
    heads = [base.head for base in grouping.base]
    kept = [head for head in heads if head not in effects]
    nothing = _TOLERANCE * max(float(np.linalg.norm(w[head])) for head in heads)
    for name in effects:
        if name not in heads:
            continue
        if name in loaded and np.linalg.norm(w[name]) <= nothing:
            grouping = _grouped(grouping, name, {})
            continue
        coefficients = _coefficients(w[name], np.stack([w[head] for head in kept], axis=1)) if kept else None
        if coefficients is None:
            kept.append(name)
        elif name in loaded:
            problem = f"the load of {name} is constant: other friction of the joint cannot be told from it"
            raise InputError(loaded[name], problem, "a joint whose load changes, or Coulomb friction alone")
        else:
            grouping = _grouped(grouping, name, dict(zip(kept, coefficients, strict=True)))
    return grouping


def _coefficients(column: NDArray[np.float64], others: NDArray[np.float64]) -> list[sympy.Rational] | None:
    """The column as a sum of the others, None if it is none."""
    scale = np.linalg.norm(others, axis=0)
    size = np.linalg.norm(column)
    solution = np.linalg.lstsq(others / scale, column / size, rcond=None)[0]
    if np.linalg.norm(others / scale @ solution - column / size) > _TOLERANCE:
        return None
    solution[np.abs(solution) < _TOLERANCE] = 0.0
    return [sympy.Rational(f"{value:.{_DIGITS}g}") for value in solution * size / scale]


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
    rule = f"its torque is one that {' and '.join(into)} make too" if into else "nothing loads the joint"
    return Grouping(tuple(base), (*gone, Eliminated(name, rule, into)), numbers)
