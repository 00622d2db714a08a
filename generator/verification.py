"""The groupings against the regressor's numerical rank, at every generation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.grouping.observability import STEMS
from generator.symbolic.function import PARAMETERS
from generator.symbolic.model import Model

#: Singular values below this part of the largest are zero; the columns are scaled to unit length before.
_RANK_TOLERANCE = 1e-9
_FIT_TOLERANCE = 1e-8
#: A column this much smaller than the largest is rounding.
_ROUNDING = 1e-7


class GroupingMismatch(Exception):
    """The symbolic groupings do not agree with the numerical rank: a defect of the rules, not of the robot's file."""


def check_grouping(model: Model) -> None:
    """Compares groupings and regressor over random states; raises GroupingMismatch naming the columns, and InputError
    where an effect's torque is so nearly one that others make that numbers cannot decide.

    Two facts are checked: the base columns are independent, and the standard regressor equals the base columns times
    the groupings' coefficients.
    """
    names = [parameter.name for parameter in model.standard_parameters]
    w = _observation_matrix(model, names)
    heads = [names.index(base.head) for base in model.grouping.base]
    coefficients = _coefficients(model, names)
    scale = np.maximum(np.linalg.norm(w, axis=0), 1e-30)
    involved = _dependent(w[:, heads] / scale[heads], [names[k] for k in heads])
    if involved:
        _refuse_undecided(model, involved)
        raise GroupingMismatch(f"the base columns of {', '.join(involved)} depend on each other")
    error = np.linalg.norm(w - w[:, heads] @ coefficients, axis=0)
    allowed = _FIT_TOLERANCE * np.maximum(scale, _ROUNDING * scale.max())
    bad = [name for name, e, most in zip(names, error, allowed, strict=True) if e > most]
    if bad:
        _refuse_undecided(model, bad)
        raise GroupingMismatch(f"groupings of {', '.join(bad)} do not reproduce their columns of the regressor")


def _refuse_undecided(model: Model, names: Sequence[str]) -> None:
    """Raises InputError where there are parameters of effects that no exact rule groups among ``names``."""
    for one in sorted(model.effects, key=lambda one: not one.effect.shapes):
        pairs = zip(one.names, one.effect.parameters, strict=True)
        undecided = [name for name, parameter in pairs if name in names and parameter.stem not in STEMS]
        if undecided:
            problem = f"the torque of {' and '.join(undecided)} is hardly another than other parameters make"
            place = model.robot.use(one.effect.id, one.joint.number).place
            raise InputError(place, problem, f"values of {one.effect.id} with which it is, or the effect left out")


def _dependent(base: NDArray[np.float64], names: Sequence[str]) -> list[str]:
    """The columns that take part in a dependency, none where all are independent."""
    _, singular, right = np.linalg.svd(base, full_matrices=False)
    vanishing = right[singular < _RANK_TOLERANCE * singular[0]]
    weight = np.abs(vanishing).max(axis=0, initial=0.0)
    return [name for name, size in zip(names, weight, strict=True) if size > 1e-3]


def _coefficients(model: Model, names: Sequence[str]) -> NDArray[np.float64]:
    matrix = np.zeros((len(model.grouping.base), len(names)))
    for row, terms in enumerate(model.grouping.numeric().values()):
        for name, coefficient in terms.items():
            matrix[row, names.index(name)] = coefficient
    return matrix


def _observation_matrix(model: Model, names: Sequence[str]) -> NDArray[np.float64]:
    """The standard regressor over random states, one under the other."""
    columns = model.sampled_columns(model.standard_columns, {PARAMETERS: model.default_parameters()})
    return np.stack([columns[name] for name in names], axis=1)
