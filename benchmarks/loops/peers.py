"""What the batch functions are compared with: a write of the same memory, Pinocchio in C++, FIGAROH."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from benchmarks.compiling import C, compiled, compilers, run
from benchmarks.peers.library import SOURCES
from benchmarks.peers.pinocchio import libraries
from benchmarks.peers.subject import write

FIGAROH = "figaroh==1.0.2"

Array = NDArray[np.float64]


class Loop:
    """Pinocchio's C++ functions in a loop over samples, by one compiler."""

    def __init__(self, compiler: str, path: Path, data: Path, loop: Any) -> None:
        self.compiler = compiler
        self._library, self._loop = ctypes.CDLL(str(path)), loop
        if self._library.peer_load(str(data).encode()):
            raise RuntimeError(f"{path} does not read {data}")

    def __call__(self, function: str, signals: Sequence[Array], out: Array | None = None) -> None:
        """``regressor`` or ``inverse_dynamics`` of each sample (n x nv): to ``out`` (n x size) if given."""
        n, nv = signals[0].shape
        pointers = [x.ctypes.data for x in signals]
        place, size = (None, 0) if out is None else (out.ctypes.data, out.size // n)
        self._loop(getattr(self._library, function), n, nv, *pointers, place, size)


def memory_and_loop(build: Path) -> tuple[Any, Any]:
    """The functions of stream_write.c and sample_loop.c, compiled for this machine."""
    sources = [SOURCES / "stream_write.c", SOURCES / "sample_loop.c"]
    options = ["-shared", "-fPIC", "-fopenmp", "-Wno-psabi"]
    path = compiled(compilers()[0], C, build / "loops.so", sources, options)
    library = ctypes.CDLL(str(path))
    stream, loop = library.stream_write, library.sample_loop
    stream.argtypes = (ctypes.c_void_p, ctypes.c_size_t, ctypes.c_double, ctypes.c_int)
    size, pointer = ctypes.c_size_t, ctypes.c_void_p
    loop.argtypes = (pointer, size, size, pointer, pointer, pointer, pointer, size)
    return stream, loop


def pinocchio(model: pin.Model, loop: Any, build: Path) -> list[Loop]:
    """The loops by each compiler, for a chain of joints about or along z."""
    data = write(_numbers(model), build / "pinocchio.bin")
    return [Loop(compiler, path, data, loop) for compiler, path in libraries(build, "pinocchio_samples").items()]


def _numbers(model: pin.Model) -> list[float]:
    """The chain as pinocchio_model.hpp reads it."""
    result = [*map(float, model.gravity.linear)]
    for j in range(1, model.njoints):
        place = model.jointPlacements[j]
        prismatic = float("P" in model.joints[j].shortname().removeprefix("JointModel"))
        result += [prismatic, *place.rotation.ravel(), *place.translation]
        result += [model.armature[model.idx_vs[j]], *model.inertias[j].toDynamicParameters()]
    return result


def figaroh(model: pin.Model, signals: Sequence[Array], build: Path) -> dict[str, Any]:
    """Results of figaroh_regressor.py, in an environment of its own that is made once (asks the package index).

    Raises RuntimeError where it cannot be installed.
    """
    python = build / "figaroh" / "bin" / "python"
    if not python.exists():
        run([sys.executable, "-m", "venv", build / "figaroh"])
        run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", FIGAROH])
    saved, samples, results = (build / name for name in ("model.bin", "samples.npz", "figaroh.npz"))
    model.saveToBinary(str(saved))
    np.savez(samples, **dict(zip(("q", "qd", "qdd"), signals, strict=True)))
    # -P: a file beside the script has the name of the package that it imports
    run([python, "-P", Path(__file__).parent / "figaroh_regressor.py", saved, samples, results])
    return dict(np.load(results))
