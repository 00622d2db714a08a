"""The C that CasADi (Andersson et al. 2019) generates from a recursion written by hand in base parameters."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import casadi as ca

from benchmarks.compiling import FLAGS, SHARED, C, compiled, compilers
from benchmarks.peers.casadi_code import wrapper
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.recursion import Recursion
from benchmarks.peers.subject import Chain, write

NAME = "CasADi, by hand"


def build(subject: Chain, folder: Path, flags: Sequence[str] = FLAGS) -> list[Library]:
    """By each compiler."""
    sources = generated(subject, folder)
    data = write(subject.parameters(subject.model), folder / "casadi_recursion.bin")
    result = []
    for compiler in compilers():
        target = folder / f"casadi_recursion_{compiler.name}.so"
        compiled(compiler, C, target, sources, [*SHARED, f"-I{SOURCES}", "-lm"], flags)
        result.append(Library(NAME, compiler.name, target, data, by_columns=True))
    return result


def generated(subject: Chain, folder: Path) -> list[Path]:
    """CasADi's C of every function, and what makes it a library of the comparison."""
    folder.mkdir(parents=True, exist_ok=True)
    code = ca.CodeGenerator("casadi_recursion.c", {"with_header": True})
    arguments = {}
    for name, inputs, output in Recursion(subject).expressions():
        code.add(ca.Function(f"casadi_{name}", list(inputs.values()), [output]))
        arguments[name] = list(inputs)
    code.generate(f"{folder}/")
    path = folder / "casadi_recursion_peer.c"
    path.write_text(wrapper("casadi_recursion.h", arguments, len(subject.base)))
    return [folder / "casadi_recursion.c", path]
