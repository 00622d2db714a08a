"""The groupings against the regressor's numerical rank, at every generation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.quantities.regressors import standard_columns
from generator.symbolic.function import PARAMETERS
from generator.symbolic.interpret import evaluate_nodes
from generator.symbolic.model import Model

#: Singular values below this part of the largest are zero; the columns are scaled to unit length before.
_RANK_TOLERANCE = 1e-9
_FIT_TOLERANCE = 1e-8


#: Effects whose parameters take part in the exact groupings.
_GROUPED = ("rotor_inertia", "offset")


class GroupingMismatch(Exception):
    """The symbolic groupings do not agree with the numerical rank: a defect of the rules, not of the robot's file."""


def check_grouping(model: Model) -> None:
    """Compares groupings and regressor over random states; raises GroupingMismatch naming the columns.

    Raises InputError at an effect whose torque other parameters make too (a spring that acts like a weight, say).

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
        _refuse(model, involved)
    error = np.linalg.norm(w - w[:, heads] @ coefficients, axis=0)
    bad = [name for name, e in zip(names, error, strict=True) if e > _FIT_TOLERANCE * max(scale.max(), 1.0)]
    if bad:
        raise GroupingMismatch(f"groupings of {', '.join(bad)} do not reproduce their columns of the regressor")


def _dependent(base: NDArray[np.float64], names: Sequence[str]) -> list[str]:
    """The columns that take part in a dependency, none where all are independent."""
    _, singular, right = np.linalg.svd(base, full_matrices=False)
    vanishing = right[singular < _RANK_TOLERANCE * singular[0]]
    weight = np.abs(vanishing).max(axis=0, initial=0.0)
    return [name for name, size in zip(names, weight, strict=True) if size > 1e-3]


def _refuse(model: Model, involved: list[str]) -> None:
    """An effect that repeats what other parameters do is the file's fault, any other dependency the rules'."""
    for use in model.robot.effects:
        mine = [n for i in model.effects if i.effect.id == use.effect for n in i.names if n in involved]
        if mine and use.effect not in _GROUPED:
            others = [name for name in involved if name not in mine]
            raise InputError(
                use.place,
                f"the torque of {' and '.join(mine)} is one that {' and '.join(others)} make too",
                "an effect that the robot's motion can tell from the others",
            )
    raise GroupingMismatch(f"the base columns of {', '.join(involved)} depend on each other")


def _coefficients(model: Model, names: Sequence[str]) -> NDArray[np.float64]:
    matrix = np.zeros((len(model.grouping.base), len(names)))
    for row, terms in enumerate(model.grouping.numeric().values()):
        for name, coefficient in terms.items():
            matrix[row, names.index(name)] = coefficient
    return matrix


def _observation_matrix(model: Model, names: Sequence[str]) -> NDArray[np.float64]:
    """The standard regressor over random states, one under the other."""
    columns = standard_columns(model)
    samples = 12 + len(names) // max(model.dof, 1)
    random = np.random.default_rng(0)
    inputs = {name: random.uniform(-3.0, 3.0, (samples, model.dof)) for name in ("q", "qd", "qdd")}
    nodes = [entry for column in columns.values() for entry in column.values()]
    values = evaluate_nodes(model.program.reachable(nodes), {**inputs, PARAMETERS: model.default_parameters()})
    w = np.zeros((samples, model.dof, len(names)))
    for k, name in enumerate(names):
        for row, entry in columns[name].items():
            w[:, row, k] = values[entry]
    return w.reshape(samples * model.dof, len(names))
