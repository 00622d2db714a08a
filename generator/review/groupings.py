"""Groupings as equations: a base parameter on the left, its standard parameters link by link on the right."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import groupby

from generator.grouping.grouping import BaseParameter, Grouping
from generator.review.decimals import rounded
from generator.review.formula import ONE, Equation, Formula, Name, Negative, Number, polynomial, times, total


def symbolic(parameter: BaseParameter) -> Equation:
    """``XX2R = XX2 - YY2 - d3^2 (M3 + M4)``: neighbours with an equal coefficient other than one share it."""
    terms: list[Formula] = []
    for coefficient, group in groupby(parameter.terms, key=lambda term: term[0]):
        names = [Name(name) for _, name in group]
        factor = polynomial(coefficient)
        if factor in (ONE, Negative(ONE)):
            terms += [times(factor, name) for name in names]
        else:
            terms.append(times(factor, total(names)))
    return Equation(Name(parameter.name), total(terms))


def numeric(parameter: BaseParameter, coefficients: Mapping[str, float]) -> Equation:
    """``XX2R = XX2 - YY2 - 1.69 M3 - 1.69 M4``: one term a standard parameter, as the literature prints it."""
    terms = [times(_number(coefficients[name]), Name(name)) for _, name in parameter.terms]
    return Equation(Name(parameter.name), total(terms))


def equations(grouping: Grouping) -> list[tuple[BaseParameter, Equation, Equation]]:
    """Every parameter that stands for more than itself, with its symbolic and its numeric equation."""
    numbers = grouping.numeric()
    return [(p, symbolic(p), numeric(p, numbers[p.name])) for p in grouping.base if not p.alone]


def alone(grouping: Grouping) -> tuple[str, ...]:
    """The standard parameters that are base parameters as they are."""
    return tuple(parameter.name for parameter in grouping.base if parameter.alone)


def without_effect(grouping: Grouping) -> tuple[str, ...]:
    """The standard parameters that appear in no torque."""
    return tuple(gone.name for gone in grouping.eliminated if not gone.into)


def _number(value: float) -> Formula:
    size = Number(Fraction(rounded(Fraction(abs(value)))))
    return Negative(size) if value < 0 else size
