"""Runs as MATLAB files up to version 7: vectors, matrices with a column a joint, scalars that hold for all samples."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io
from numpy.typing import NDArray

from generator.errors import InputError, Place
from identification.arrays import Array
from identification.recording import Recording, by_count, digest, first_word, left_out

EXTENSIONS = (".mat",)


def read(path: Path) -> Recording:
    """The numeric variables of a file; a matrix ``q`` of n columns gives ``q1`` to ``qn``, a scalar a constant column.

    The number of samples is that of ``t``, else of the longest variable. What has another length is left out, and told,
    as is a text a sample.
    Raises InputError for a file that is not of this format, and for a column that two variables make.
    """
    file = str(path)
    try:
        variables: dict[str, Any] = scipy.io.loadmat(file)
    except NotImplementedError:
        raise InputError(Place(file), "a MATLAB file of version 7.3", "one of version 7 (save -v7)") from None
    except OSError:
        raise
    except Exception as error:  # a damaged file makes scipy raise errors of many kinds
        problem = f"this is not a whole MATLAB file ({' '.join(str(error).split()) or type(error).__name__})"
        raise InputError(Place(file), problem, "a MATLAB file up to version 7") from None
    arrays = {name: np.atleast_2d(np.asarray(value, dtype=float)) for name, value in _of_kind(variables, "fiu").items()}
    texts = _of_kind(variables, "UO")
    length = _length(arrays) or _length(texts)
    columns: dict[str, Array] = {}
    notes: list[str] = []
    for name, value in arrays.items():
        found = _columns(name, value, length)
        if not found:
            size = " x ".join(map(str, value.shape))
            notes.append(f"{file}: {name} is {size}, of runs of {length} samples: it is left out")
        if twice := columns.keys() & found.keys():
            raise InputError(Place(file), f"column {min(twice)} is there twice", "each column once")
        columns |= found
    words = {name: first_word(map(_text, value.ravel())) for name, value in texts.items() if value.size == length}
    where = by_count(file, [*columns, *words])
    return Recording(file, columns, digest(path), where, (*notes, *left_out(file, words)), words)


def _of_kind(variables: Mapping[str, Any], kinds: str) -> dict[str, NDArray[Any]]:
    """Vectors and matrices that hold something, of NumPy's ``kinds``."""
    return {
        name: value
        for name, value in variables.items()
        if not name.startswith("__") and isinstance(value, np.ndarray) and value.dtype.kind in kinds
        if value.ndim <= 2 and value.size
    }


def _length(arrays: Mapping[str, NDArray[Any]]) -> int:
    """Samples of a run of these variables."""
    return max(arrays["t"].shape) if "t" in arrays else max((max(a.shape) for a in arrays.values()), default=0)


def _text(value: Any) -> str:
    """What a text says, or a cell that holds one."""
    return str(np.squeeze(value)) if np.size(value) else ""


def _columns(name: str, value: Array, length: int) -> dict[str, Array]:
    if value.size == 1:
        return {name: np.broadcast_to(value.ravel(), (length,))}
    upright = value if value.shape[0] == length else value.T
    if upright.shape[0] != length:
        return {}
    if upright.shape[1] == 1:
        return {name: np.ascontiguousarray(upright[:, 0])}
    return {f"{name}{k}": np.ascontiguousarray(column) for k, column in enumerate(upright.T, start=1)}
