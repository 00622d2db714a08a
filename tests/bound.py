"""Compiled C of a robot, bound by cffi: its functions, its types and arrays of its numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cffi  # type: ignore[import-untyped]
import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.compiled import run


def preprocessed(header: Path, *options: str) -> str:
    """A header as the compiler has it before it compiles."""
    return run(["gcc", "-std=c99", "-E", "-P", *options, header])


class Bound:
    """The compiled ``library`` of the robot ``name``, called by the names of its ``header`` without the robot's.

    ``flags`` are those of the compiler; of them the header needs macros and folders.
    """

    def __init__(self, name: str, library: Path, header: Path, flags: Sequence[str] = ()) -> None:
        self.name = name
        self.ffi = cffi.FFI()
        self.ffi.cdef(_declarations(preprocessed(header, *(flag for flag in flags if flag[:2] in ("-D", "-I"))), name))
        self.library = self.ffi.dlopen(str(library))

    def call(self, function: str, *arguments: Any) -> Any:
        return getattr(self.library, f"{self.name}_{function}")(*arguments)

    def new(self, kind: str, *initial: Any) -> Any:
        """A new object of one of the robot's types."""
        return self.ffi.new(f"{self.name}_{kind}", *initial)

    def array(self, values: ArrayLike) -> Any:
        """A new array of the robot's numbers."""
        return self.new("real[]", [float(value) for value in np.ravel(values)])

    def pointer(self, array: NDArray[Any]) -> Any:
        """To the numbers of ``array``, which are of the robot's type."""
        return self.ffi.cast(f"{self.name}_real *", array.ctypes.data)


def _declarations(text: str, name: str) -> str:
    """What the headers declare: from the robot's first type on, without what is the system's, and without the
    assertions, which C99 writes as array types.
    """
    first = re.search(rf"typedef (?:float|double) {name}_real\b", text)
    assert first, f"no type {name}_real"
    return "\n".join(line for line in text[first.start() :].splitlines() if not line.startswith("typedef char "))
