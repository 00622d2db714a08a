"""Compiling what is measured: the compilers that are there, the flags that all share, nothing built twice."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

#: The flags of everything that is timed.
FLAGS = ("-O2", "-ffp-contract=fast", "-march=native")
#: What a shared library needs besides.
SHARED = ("-shared", "-fPIC", "-fvisibility=hidden")

C, CPP = "-std=c99", "-std=c++17"


class Missing(Exception):
    """A tool, a package or a feature of this machine is not there; says which in a few words."""


@dataclass(frozen=True)
class Compiler:
    """A family of compilers, and the commands of its C and of its C++ compiler."""

    name: str
    c: str
    cpp: str | None

    def command(self, standard: str) -> str:
        """The command for a language standard; raises Missing if there is none."""
        if standard == C:
            return self.c
        if self.cpp is None:
            raise Missing(f"no C++ compiler of {self.name}")
        return self.cpp


def compilers() -> list[Compiler]:
    """The compilers of this machine; raises Missing if there is none."""
    found = []
    for c, cpp in (("gcc", "g++"), ("clang", "clang++")):
        if shutil.which(c):
            found.append(Compiler(c, c, cpp if shutil.which(cpp) else None))
    if not found:
        raise Missing("neither gcc nor clang")
    return found


@cache
def version(command: str) -> str:
    """The first line of what a compiler says of itself."""
    return run([command, "--version"]).splitlines()[0]


def package(name: str, folder: str) -> Path:
    """A folder of an installed distribution; raises Missing if it is not installed."""
    try:
        path = Path(str(distribution(name).locate_file(folder)))
    except PackageNotFoundError:
        path = None
    if path is None or not path.is_dir():
        raise Missing(f"the Python package {name}") from None
    return path


def compiled(
    compiler: Compiler,
    standard: str,
    target: Path,
    sources: Sequence[Path],
    options: Sequence[str],
    flags: Sequence[str] = FLAGS,
) -> Path:
    """``target`` compiled from ``sources``; ``options`` come behind them. Headers count through the sources' folders.

    A target that an earlier run made from the same text by the same command is taken as it is.
    Raises RuntimeError with the compiler's words if it fails.
    """
    words = [compiler.command(standard), standard, *flags, *map(str, sources), *options]
    headers = {file for source in sources for file in source.parent.glob("*.h*")}
    content = [version(words[0]), *words, *(path.read_text() for path in sorted({*sources, *headers}))]
    digest, stamp = hashlib.sha256("\0".join(content).encode()).hexdigest(), target.with_suffix(".made")
    if not (target.exists() and stamp.exists() and stamp.read_text() == digest):
        target.parent.mkdir(parents=True, exist_ok=True)
        run([*words, "-o", str(target)])
        stamp.write_text(digest)
    return target


def run(words: Sequence[str | Path], errors_too: bool = False) -> str:
    """What a command prints; raises RuntimeError with all that it said if it fails, Missing if there is none."""
    if not shutil.which(words[0]):
        raise Missing(str(words[0]))
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr if errors_too else done.stdout
