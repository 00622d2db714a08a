"""Regressors as columns of few entries: dense, or packed with their structure."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from numpy.typing import NDArray

from generator.symbolic.function import Sparsity
from generator.symbolic.interpret import evaluate_nodes
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, zeros

#: Columns by parameter name, each {row: entry}.
Columns = Mapping[str, Mapping[int, Node]]

#: Times that states are drawn, until effects are defined at enough of them.
_DRAWS = 500
#: Powers of ten that speeds span in half of the states: an effect may be one of low speeds alone.
_DECADES = 9


class HardlyDefined(Exception):
    """At nearly all states some columns have no real value; ``names`` are theirs."""

    def __init__(self, names: Collection[str]) -> None:
        super().__init__(f"no real value at nearly all states: {', '.join(names)}")
        self.names = names


def dense(program: Program, columns: Columns, rows: int) -> Array:
    """The matrix (rows x columns) with its structural zeros."""
    matrix = zeros(program, rows, len(columns))
    for k, column in enumerate(columns.values()):
        for row, entry in column.items():
            matrix[row, k] = entry
    return matrix


def sparsity(program: Program, columns: Columns, rows: int) -> Sparsity:
    """Where the structural nonzeros stand, row by row."""
    matrix = dense(program, columns, rows)
    places = [(i, k) for i in range(rows) for k in range(len(columns)) if matrix[i, k] is not program.zero]
    return Sparsity((rows, len(columns)), tuple(i for i, _ in places), tuple(k for _, k in places))


def sampled(
    program: Program,
    columns: Columns,
    dof: int,
    given: Mapping[str, NDArray[np.float64]],
    varying: Mapping[str, int],
) -> dict[str, NDArray[np.float64]]:
    """Each column over random states, the rows of each state together.

    ``given`` are further input signals, the same in all states; ``varying`` the sizes of those that vary as the motion.

    States where an effect is not defined (a gas chamber pressed beyond its end) are left out, and others drawn where
    these are more than half. Raises HardlyDefined where that does not help.
    """
    samples = 3 * (12 + len(columns) // max(dof, 1))
    random, slow = np.random.default_rng(0), np.random.default_rng(1)
    sizes = {**dict.fromkeys(("q", "qd", "qdd"), dof), **varying}
    reachable = program.reachable([entry for column in columns.values() for entry in column.values()])
    drawn: list[NDArray[np.float64]] = []
    for _ in range(_DRAWS):
        inputs = {name: random.uniform(-3.0, 3.0, (samples, size)) for name, size in sizes.items()}
        inputs["qd"][::2] *= 10 ** slow.uniform(-_DECADES, 0, inputs["qd"][::2].shape)
        with np.errstate(all="ignore"):
            values = evaluate_nodes(reachable, {**inputs, **given})
        rows = _rows(columns, values, samples, dof)
        finite = np.isfinite(rows)
        drawn.append(rows[:, finite.all(axis=(0, 2))])
        if 2 * sum(part.shape[1] for part in drawn) >= samples:
            together = np.concatenate(drawn, axis=1)
            return {name: together[k].ravel() for k, name in enumerate(columns)}
    raise HardlyDefined([name for name, defined in zip(columns, finite, strict=True) if not defined.all()])


def _rows(columns: Columns, values: Mapping[Node, NDArray[np.float64]], samples: int, dof: int) -> NDArray[np.float64]:
    """The columns' entries (columns x samples x dof)."""
    rows = np.zeros((len(columns), samples, dof))
    for k, column in enumerate(columns.values()):
        for row, entry in column.items():
            rows[k, :, row] = values[entry]
    return rows


def packed(program: Program, columns: Columns, rows: int) -> Array:
    """The structural nonzeros, row by row."""
    matrix, places = dense(program, columns, rows), sparsity(program, columns, rows)
    entries = np.empty(len(places.rows), dtype=object)
    entries[:] = [matrix[i, k] for i, k in zip(places.rows, places.columns, strict=True)]
    return entries
