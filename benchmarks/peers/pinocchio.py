"""Pinocchio in C++ (Carpentier et al. 2019), compiled from the headers of its wheel."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from benchmarks.compiling import CPP, SHARED, Compiler, Missing, compiled, compilers, package
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.subject import Chain, write

NAME = "Pinocchio"

#: What the wheel's CMake file asks of those who include its headers.
_LIMITS = (
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
)


def build(subject: Chain, folder: Path) -> list[Library]:
    """By each C++ compiler; the library is the same for every robot."""
    data = write(numbers(subject), folder / "pinocchio.bin")
    built = libraries(folder.parent).items()
    return [Library(NAME, compiler, path, data, standard=True) for compiler, path in built]


def libraries(folder: Path, source: str = "pinocchio") -> dict[str, Path]:
    """A source file compiled into ``folder`` by each C++ compiler: the libraries by the names of the compilers."""
    able = [compiler for compiler in compilers() if compiler.cpp]
    if not able:
        raise Missing("neither g++ nor clang++")
    options = [*SHARED, "-DNDEBUG", *includes()]

    def made(compiler: Compiler) -> Path:
        target = folder / f"{source}_{compiler.name}.so"
        return compiled(compiler, CPP, target, [SOURCES / f"{source}.cpp"], options)

    with ThreadPoolExecutor(max_workers=2) as pool:
        return dict(zip((compiler.name for compiler in able), pool.map(made, able), strict=True))


def includes() -> list[str]:
    """Options to find the headers of Pinocchio and of Eigen, which comes with CasADi's wheel."""
    pinocchio, eigen = package("libpinocchio", "cmeel.prefix/include"), package("casadi", "casadi/include/eigen3")
    return [*_LIMITS, "-isystem", str(pinocchio), "-isystem", str(eigen)]


def numbers(subject: Chain) -> list[float]:
    """The robot as pinocchio_model.hpp reads it."""
    result = [float(g) for g in subject.robot.gravity]
    for link in subject.links:
        result += [float(link.prismatic), *link.rotation.ravel(), *link.position]
        result += [subject.rotor(link), *subject.body(link)]
    return result
