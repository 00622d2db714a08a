"""Vector arithmetic: how much of it compiled code does, and how much of it the machine can do."""

from __future__ import annotations

import ctypes
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.compiling import C, Compiler, Missing, compiled, compilers, run
from benchmarks.peers.library import SOURCES

#: The widest registers first, with the doubles that they hold.
_REGISTERS = {"zmm": 8, "ymm": 4, "xmm": 2}
_PRODUCT = re.compile(r"\sv?(?:mul|fn?m(?:add|sub)\d*)pd\s.*%(?P<register>[xyz]mm)")
_SUM = re.compile(r"\sv?(?:add|sub)pd\s.*%(?P<register>[xyz]mm)")

_ROUNDS = 20_000


@dataclass(frozen=True)
class Work:
    """Vector instructions for ``lanes`` samples: products, fused with a sum or not, and sums apart.

    Quotients and roots are left out.
    """

    products: int
    sums: int
    lanes: int

    @property
    def total(self) -> int:
        return self.products + self.sums


@dataclass(frozen=True)
class Rates:
    """Instructions a nanosecond that all threads together reach: products alone, sums alone, both kinds at once."""

    products: float
    sums: float
    both: float

    def least(self, work: Work) -> float:
        """Nanoseconds a sample that no order of the work's instructions goes below."""
        return max(work.products / self.products, work.sums / self.sums, work.total / self.both) / work.lanes


def work(source: Path, include: Path, functions: Sequence[str], build: Path) -> Work:
    """The arithmetic of ``functions`` of a C source, compiled by whichever compiler makes it the least.

    What is in vectors stands there once, without loops: the text of the compiled code tells how much it is.
    """
    return min((_compiled(each, source, include, functions, build) for each in compilers()), key=lambda w: w.total)


def _compiled(compiler: Compiler, source: Path, include: Path, functions: Sequence[str], build: Path) -> Work:
    options = ["-fno-math-errno", f"-I{include}", "-c"]
    target = compiled(compiler, C, build / f"{source.stem}_{compiler.name}.o", [source], options)
    text = run(["objdump", "-d", "--no-show-raw-insn", target])
    bodies = "".join(part for part in text.split("\n\n") if re.match(rf"\w+ <(?:{'|'.join(functions)})[.>]", part))
    register = next((name for name in _REGISTERS if f"%{name}" in bodies), None)
    if register is None:
        raise Missing("a processor with vectors that this study knows")
    products, sums = (
        sum(found["register"] == register for found in kind.finditer(bodies)) for kind in (_PRODUCT, _SUM)
    )
    return Work(products, sums, _REGISTERS[register])


def rates(build: Path, taken: Callable[[Callable[[], object]], float], threads: int) -> Rates:
    """What the machine reaches; ``taken`` gives the nanoseconds of a call, which runs on ``threads`` threads."""
    options = ["-shared", "-fPIC", "-fopenmp"]
    path = compiled(compilers()[0], C, build / "arithmetic.so", [SOURCES / "arithmetic.c"], options)
    library = ctypes.CDLL(str(path))
    chains = ctypes.c_size_t.in_dll(library, "chains").value
    found = []
    for name, kinds in (("products", 1), ("sums", 1), ("both", 2)):
        function = getattr(library, name)
        function.argtypes, function.restype = (ctypes.c_size_t, ctypes.c_double), ctypes.c_double
        nanoseconds = taken(lambda function=function: function(_ROUNDS, 0.5))  # type: ignore[misc]
        found.append(kinds * chains * _ROUNDS * threads / nanoseconds)
    return Rates(*found)
