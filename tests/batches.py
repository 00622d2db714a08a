"""The generated batch functions made callable, every array between guard zones that a stray write would change."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.bound import Bound, preprocessed
from tests.compiled import SHARED, run

#: Numbers before and behind each array, and what they hold.
_GUARD, _MARK = 37, 12345.0
_WARNINGS = ("-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Wdouble-promotion", "-pedantic", "-Werror")

Array = NDArray[Any]


@dataclass(frozen=True)
class Filter:
    """What the observation functions are asked to apply."""

    taps: tuple[float, ...]
    decimation: int

    def applied(self, y: Array) -> Array:
        """Each column of ``y`` (samples first) by numpy's convolution, each r-th value of it."""
        if len(y) < len(self.taps):
            return np.zeros((0, *y.shape[1:]))
        flat = y.reshape(len(y), -1)
        columns = [np.convolve(column, self.taps[::-1], "valid")[:: self.decimation] for column in flat.T]
        return np.stack(columns, axis=-1).reshape(-1, *y.shape[1:])


class Batch:
    """The batch functions of the robot ``name`` whose C is in ``folder``, compiled strictly with ``flags`` (once)."""

    def __init__(self, folder: Path, name: str, flags: Sequence[str] = ("-O1",), compiler: str = "gcc") -> None:
        self.name = name
        self.single = any("USE_FLOAT" in flag for flag in flags)
        self.type = np.dtype(np.float32 if self.single else np.float64)
        key = hashlib.sha256(repr((compiler, *flags)).encode()).hexdigest()[:12]
        library = folder / f"lib{name}{key}.so"
        sources = [folder / "c" / f"{name}.c", folder / "batch" / f"{name}_batch.c"]
        include = f"-I{folder / 'c'}"
        if not library.exists():
            run([compiler, "-std=c99", *_WARNINGS, *SHARED, *flags, include, *sources, "-o", library, "-lm"])
        header = folder / "batch" / f"{name}_batch.h"
        self._c = Bound(name, library, header, [*flags, include])
        self._prepared = self._c.new("prepared *")
        self.sizes = _sizes(preprocessed(header, include, "-dM"), name)

    def prepare(self, parameters: ArrayLike) -> None:
        """Sets the values of the parameters."""
        params = self._c.new("params *")
        params.value = [float(value) for value in np.ravel(parameters)]
        self._c.call("prepare", params, self._prepared)

    def kept(self, n: int, chosen: Filter | None) -> int:
        """Number of samples that a filter keeps of ``n``."""
        pointer, _alive = self._filter(chosen)
        return int(self._c.call("filtered_count", pointer, n))

    def stride(self, size: int) -> int:
        return int(self._c.call("observation_stride", size))

    def inverse_dynamics(self, q: Array, qd: Array, qdd: Array) -> Array:
        """Torques (n, NQ)."""
        out = self._guarded(q.size)
        self._c.call("batch_inverse_dynamics", self._prepared, len(q), *self._given(q, qd, qdd), self._inside(out))
        return self._released(out).reshape(q.shape)

    def filtered(self, y: Array, chosen: Filter | None) -> Array:
        """Kept samples (N, NQ)."""
        pointer, _alive = self._filter(chosen)
        out = self._guarded(self.kept(len(y), chosen) * y.shape[1])
        self._c.call("batch_filter", pointer, len(y), *self._given(y), self._inside(out))
        return self._released(out).reshape(-1, y.shape[1])

    def rows(self, q: Array, qd: Array, qdd: Array, chosen: Filter | None = None, gap: int = 0) -> Array:
        """Observation matrix (N, NQ, NBASE) through the layout of rows, ``gap`` numbers between the rows."""
        pointer, _alive = self._filter(chosen)
        size, width = self.kept(len(q), chosen) * self.sizes["NQ"], self.sizes["NBASE"]
        out = self._guarded(size * (width + gap))
        self._c.call(
            "observation_matrix_rows",
            *(self._prepared, pointer, len(q), *self._given(q, qd, qdd), self._inside(out), width + gap),
        )
        found = self._released(out).reshape(size, width + gap)
        assert (found[:, width:] == _MARK).all()
        return found[:, :width].reshape(-1, self.sizes["NQ"], width)

    def columns(self, q: Array, qd: Array, qdd: Array, chosen: Filter | None = None, gap: int = 0) -> Array:
        """The same through the layout of columns, ``gap`` numbers between the columns."""
        pointer, _alive = self._filter(chosen)
        kept, width = self.kept(len(q), chosen), self.sizes["NBASE"]
        size = kept * self.sizes["NQ"]
        out = self._guarded(width * (size + gap))
        self._c.call(
            "observation_matrix_columns",
            *(self._prepared, pointer, len(q), *self._given(q, qd, qdd), self._inside(out), size + gap),
        )
        found = self._released(out).reshape(width, size + gap)
        assert (found[:, size:] == _MARK).all()
        return found[:, :size].reshape(width, self.sizes["NQ"], kept).transpose(2, 1, 0)

    def normal(self, function: str, signals: Sequence[Array], chosen: Filter | None = None) -> Array:
        """``observation_gram`` or ``observation_qr`` (NQ, NBASE + 1, NBASE + 1) of q, qd, qdd, tau."""
        pointer, _alive = self._filter(chosen)
        shape = (self.sizes["NQ"], self.sizes["NBASE"] + 1, self.sizes["NBASE"] + 1)
        out, work = self._guarded(int(np.prod(shape))), self._guarded(self.sizes["OBSERVATION_WORK"])
        given = (self._prepared, pointer, len(signals[0]), *self._given(*signals))
        self._c.call(function, *given, self._inside(out), self._inside(work))
        self._released(work)
        return self._released(out).reshape(shape)

    def _filter(self, chosen: Filter | None) -> tuple[Any, Any]:
        if chosen is None:
            return self._c.ffi.NULL, None
        taps = self._c.array(chosen.taps)
        pointer = self._c.new("filter *", (taps, len(chosen.taps), chosen.decimation))
        return pointer, taps

    def _given(self, *arrays: Array) -> list[Any]:
        """Pointers to copies that begin at no multiple of 16 bytes, and end where their memory does."""
        self._alive = [np.concatenate([[0.0], array.ravel()]).astype(self.type) for array in arrays]
        return [self._c.pointer(array[1:]) for array in self._alive]

    def _guarded(self, size: int) -> Array:
        return np.full(size + 2 * _GUARD, _MARK, self.type)

    def _inside(self, guarded: Array) -> Any:
        return self._c.pointer(guarded[_GUARD:])

    def _released(self, guarded: Array) -> Array:
        assert (guarded[:_GUARD] == _MARK).all()
        assert (guarded[-_GUARD:] == _MARK).all()
        return guarded[_GUARD:-_GUARD].copy()


def _sizes(macros: str, name: str) -> dict[str, int]:
    """The numbers of the header's macros."""
    prefix = f"#define {name.upper()}_"
    lines = [line.removeprefix(prefix).split() for line in macros.splitlines() if prefix in line]
    return {words[0]: int(words[1]) for words in lines if len(words) == 2 and words[1].isdigit()}
