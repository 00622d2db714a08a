"""Runs as Parquet files, with the same columns as in text."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from generator.errors import InputError, Place
from identification.extras import needing
from identification.recording import Array, Recording, digest

EXTENSIONS = (".parquet",)


def read(path: Path) -> Recording:
    """The columns; a missing value is NaN. Raises InputError for a damaged file and a column that is not of numbers."""
    file = str(path)
    with needing(Place(file)):
        import pyarrow
        from pyarrow import parquet
    try:
        table = parquet.read_table(path)
    except pyarrow.ArrowException as error:
        problem = f"this is not a whole Parquet file ({' '.join(str(error).split())})"
        raise InputError(Place(file), problem, "a Parquet file") from None
    names = list(table.column_names)
    columns: dict[str, Array] = {}
    for k, name in enumerate(names, start=1):
        try:
            columns[name] = np.asarray(table.column(name).to_numpy(), dtype=float)
        except (TypeError, ValueError):
            raise InputError(Place(file, 1, k), f"column {name} is {table.column(name).type}", "numbers") from None
    return Recording(file, columns, digest(path), lambda row, column: _place(file, names, row, column))


def _place(file: str, names: list[str], row: int | None, column: str) -> Place:
    """Row and column of the table count as line and column."""
    return Place(file, 1 if row is None else row + 1, names.index(column) + 1 if column in names else 1)
