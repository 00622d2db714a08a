"""How a dense and a packed regressor are made of their columns."""

from __future__ import annotations

from collections.abc import Callable

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal, Sparsity
from generator.symbolic.model import Model
from generator.symbolic.sparse import Columns, dense, packed, sparsity
from generator.symbolic.vectors import Array

_MOTION = signals.together(signals.q, signals.qd, signals.qdd)


def dense_regressor(
    name: str,
    summary: str,
    details: str,
    columns: Callable[[Model], Columns],
) -> Quantity:
    """A regressor with all its entries, row-major."""

    def outputs(model: Model) -> tuple[Signal]:
        shape = (model.dof, len(columns(model)))
        return (Signal("W", shape, ("SI",), "regressor: torque of each row per unit of each parameter"),)

    def build(model: Model) -> tuple[Array]:
        return (dense(model.program, columns(model), model.dof),)

    return Quantity(name, summary, details, _MOTION, outputs, build)


def packed_regressor(
    name: str,
    summary: str,
    details: str,
    columns: Callable[[Model], Columns],
) -> Quantity:
    """The structural nonzeros of a regressor, row by row, with their places."""

    def structure(model: Model) -> Sparsity:
        return sparsity(model.program, columns(model), model.dof)

    def outputs(model: Model) -> tuple[Signal]:
        size = len(structure(model).rows)
        return (Signal("W", (size,), ("SI",), "structural nonzeros of the regressor, row by row"),)

    def build(model: Model) -> tuple[Array]:
        return (packed(model.program, columns(model), model.dof),)

    return Quantity(name, summary, details, _MOTION, outputs, build, sparsity=structure)
