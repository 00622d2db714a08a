"""What the batch functions are compared with: a write of the same memory, Pinocchio in C++, FIGAROH."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

SOURCES = Path(__file__).parent
FIGAROH = "figaroh==1.0.2"

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Loop:
    """Nanoseconds a sample of Pinocchio's C++ loops, and what they gave for the first samples."""

    regressor: float
    inverse_dynamics: float
    W: Array
    tau: Array


def run(words: Sequence[str | Path], **options: Any) -> str:
    """What a command prints; raises RuntimeError with all that it said if it fails."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return str(done.stdout)


def stream_write(build: Path) -> Any:
    """The function of stream_write.c, compiled for this machine."""
    library = build / "stream_write.so"
    flags = ("-std=gnu99", "-O2", "-march=native", "-fopenmp", "-Wno-psabi", "-shared", "-fPIC")
    run([os.environ.get("CC", "gcc"), *flags, SOURCES / "stream_write.c", "-o", library])
    function = ctypes.CDLL(str(library)).stream_write
    function.argtypes = (ctypes.c_void_p, ctypes.c_size_t, ctypes.c_double, ctypes.c_int)
    return function


def pinocchio(model: pin.Model, signals: Sequence[Array], build: Path) -> Loop:
    """Pinocchio's loops over the samples, compiled for this machine with the flags of the generated code."""
    prefix = Path(str(distribution("libpinocchio").locate_file("cmeel.prefix")))
    eigen = Path(str(distribution("casadi").locate_file("casadi/include/eigen3")))
    program, saved, samples, results = (build / name for name in ("loops", "model.bin", "samples.bin", "results.bin"))
    if not program.exists() or program.stat().st_mtime < (SOURCES / "pinocchio_loops.cpp").stat().st_mtime:
        limits = ("LIST_SIZE=30", "VECTOR_SIZE=30")
        macros = ["-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", *(f"-DBOOST_MPL_LIMIT_{limit}" for limit in limits)]
        macros += ["-DBOOST_FUSION_INVOKE_MAX_ARITY=12", "-DNDEBUG"]
        flags = ("-std=c++17", "-O2", "-march=native", "-ffp-contract=fast")
        include, lib = ("-isystem", prefix / "include", "-isystem", eigen), prefix / "lib"
        link = (f"-L{lib}", "-lpinocchio_default", "-lboost_serialization", f"-Wl,-rpath,{lib}")
        source = SOURCES / "pinocchio_loops.cpp"
        run([shutil.which("g++") or "c++", *flags, *macros, *include, source, *link, "-o", program])
    model.saveToBinary(str(saved))
    np.stack(signals, axis=1).tofile(samples)
    regressor, inverse_dynamics = map(float, run([program, saved, samples, results]).split())
    found = np.fromfile(results).reshape(200, -1)
    W, tau = found[:, : -model.nv], found[:, -model.nv :]
    return Loop(regressor, inverse_dynamics, W.reshape(200, model.nv, -1), tau)


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
    run([python, SOURCES / "figaroh_regressor.py", saved, samples, results])
    return dict(np.load(results))
