"""The library of the generated Python module: compiled for the machine that it is compiled on, and loaded."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

from generator.compiler import Done, compiler, run
from generator.earlier import library_of
from generator.errors import InputError, Place

_FLAGS = ("-std=c99", "-O2", "-ffp-contract=fast", "-fno-math-errno", "-shared", "-fPIC")
#: Tried in this order: threads need OpenMP's library, and not every compiler knows its own machine.
_ATTEMPTS = (("-march=native", "-fopenmp"), ("-march=native",), ("-fopenmp",), ())


def build_library(folder: Path, name: str) -> Path:
    """Compiles ``python/lib<name>.so`` from the generated C in ``folder``; returns its path.

    What is of many samples and the simulation are part of it where their folders are there.
    With OpenMP and for the processor of this machine where the compiler can. Raises InputError where there is no
    compiler or where it compiles nothing.
    """
    library = folder / library_of(name)
    sources = [folder / "c" / f"{name}.c", *sorted((folder / "batch").glob("*.c"))]
    sources += sorted((folder / "simulation").glob("*.c"))
    words = [*_FLAGS, f"-I{folder / 'c'}", *map(str, sources), "-o", str(library), "-lm"]
    done = Done(1, "")
    library.unlink(missing_ok=True)
    for flags in _ATTEMPTS:
        done = run([*compiler(), *flags, *words])
        if done.status == 0 and library.exists():
            return library
    library.unlink(missing_ok=True)
    problem = f"it cannot be compiled ({done.reason})"
    raise InputError(Place(str(library)), problem, "a C99 compiler that makes shared libraries")


def load_library(folder: Path, name: str) -> Any:
    """The generated Python module in ``folder``, on its compiled library."""
    path = folder / "python" / f"{name}.py"
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module
