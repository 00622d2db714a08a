"""The C that CasADi generates from Pinocchio's template code, the robot's numbers being constants in it."""

from __future__ import annotations

from pathlib import Path

from benchmarks.compiling import CPP, SHARED, C, Compiler, compiled, compilers, package, run
from benchmarks.peers.casadi_code import wrapper
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.pinocchio import includes, numbers
from benchmarks.peers.subject import Chain, write

NAME = "CasADi, from Pinocchio"

_ARGUMENTS = {
    "inverse_dynamics": ("q", "qd", "third"),
    "inertia_matrix": ("q",),
    "direct_dynamics": ("q", "qd", "third"),
    "regressor": ("q", "qd", "third"),
    "gravity": ("q",),
}


def build(subject: Chain, folder: Path) -> list[Library]:
    """By each compiler, from C that a program in C++ writes."""
    model, nothing = write(numbers(subject), folder / "pinocchio.bin"), write([], folder / "nothing.bin")
    run([_generator(folder.parent), model, folder])
    wrapping = folder / "casadi_pinocchio_peer.c"
    wrapping.write_text(wrapper("casadi_pinocchio.h", _ARGUMENTS, 0))
    result = []
    for compiler in compilers():
        target = folder / f"casadi_pinocchio_{compiler.name}.so"
        sources = [folder / "casadi_pinocchio.c", wrapping]
        compiled(compiler, C, target, sources, [*SHARED, f"-I{SOURCES}", "-lm"])
        result.append(Library(NAME, compiler.name, target, nothing, by_columns=True, standard=True))
    return result


def _generator(folder: Path) -> Path:
    """The program; its own speed does not matter."""
    libraries = package("casadi", "casadi")
    options = [*includes(), f"-I{libraries / 'include'}", f"-L{libraries}", "-lcasadi", f"-Wl,-rpath,{libraries}"]
    return compiled(
        _with_cpp(), CPP, folder / "casadi_pinocchio", [SOURCES / "casadi_pinocchio.cpp"], options, ("-O0",)
    )


def _with_cpp() -> Compiler:
    """The last of the C++ compilers: clang takes less memory and time for these templates than gcc."""
    able = [compiler for compiler in compilers() if compiler.cpp]
    return able[-1] if able else compilers()[0]
