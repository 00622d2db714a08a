"""Runs as Parquet files, with the same columns as in text."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError, Place
from identification.arrays import Array
from identification.extras import needing
from identification.recording import Recording, by_count, digest, first_word, left_out, read_as_seconds

EXTENSIONS = (".parquet",)


def read(path: Path) -> Recording:
    """The columns of numbers, durations in s, points in time in s from the first row; a missing value is NaN. A
    column of anything else is left out, and told.

    Raises InputError for a damaged file and for a column that is there twice.
    """
    file = str(path)
    with needing(Place(file)):
        import pyarrow
        from pyarrow import parquet, types
    try:
        names = list(parquet.read_schema(path).names)
        for k, name in enumerate(names):
            if name in names[:k]:
                raise InputError(Place(file, 1, k + 1), f"column {name} is there twice", "each column once")
        table = parquet.read_table(path)
    except pyarrow.ArrowException as error:
        problem = f"this is not a whole Parquet file ({' '.join(str(error).split())})"
        raise InputError(Place(file), problem, "a Parquet file") from None
    columns: dict[str, Array] = {}
    clocks: list[str] = []
    for name in names:
        column = table.column(name)
        if any(one(column.type) for one in (types.is_integer, types.is_floating, types.is_decimal)):
            columns[name] = np.asarray(column.to_numpy(), dtype=float)
        elif types.is_duration(column.type):
            spans = column.to_numpy()
            columns[name] = _seconds(spans)
        elif types.is_timestamp(column.type):
            clocks.append(name)
            times = column.to_numpy()
            columns[name] = _seconds(times - times[:1])
    words = {
        name: first_word(str(one) if one.is_valid else "" for one in table.column(name))
        for name in names
        if name not in columns and table.num_rows
    }
    notes = (*read_as_seconds(file, clocks), *left_out(file, words))
    return Recording(file, columns, digest(path), by_count(file, names), notes, words)


def _seconds(spans: NDArray[np.timedelta64]) -> Array:
    return np.where(np.isnat(spans), np.nan, spans / np.timedelta64(1, "s"))
