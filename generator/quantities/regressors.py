"""How a dense and a packed regressor are made of their columns."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal, Sparsity
from generator.symbolic.model import Model
from generator.symbolic.sparse import Columns, dense, packed, sparsity
from generator.symbolic.vectors import Array

Signals = Callable[[Model], Sequence[Signal]]


def dense_regressor(
    name: str,
    summary: str,
    details: str,
    inputs: Signals,
    columns: Callable[[Model], Columns],
    rows: Callable[[Model], int],
) -> Quantity:
    """A regressor with all its entries, row-major."""

    def outputs(model: Model) -> tuple[Signal]:
        shape = (rows(model), len(columns(model)))
        return (Signal("W", shape, ("SI",), "regressor: torque of each row per unit of each parameter"),)

    def build(model: Model) -> tuple[Array]:
        return (dense(model.program, columns(model), rows(model)),)

    return Quantity(name, summary, details, inputs, outputs, build)


def packed_regressor(
    name: str,
    summary: str,
    details: str,
    inputs: Signals,
    columns: Callable[[Model], Columns],
    rows: Callable[[Model], int],
) -> Quantity:
    """The structural nonzeros of a regressor, row by row, with their places."""

    def structure(model: Model) -> Sparsity:
        return sparsity(model.program, columns(model), rows(model))

    def outputs(model: Model) -> tuple[Signal]:
        size = len(structure(model).rows)
        return (Signal("W", (size,), ("SI",), "structural nonzeros of the regressor, row by row"),)

    def build(model: Model) -> tuple[Array]:
        return (packed(model.program, columns(model), rows(model)),)

    return Quantity(name, summary, details, inputs, outputs, build, sparsity=structure)
