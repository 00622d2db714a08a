"""Documents as programs: named code blocks become files, console sessions are run, printed output is compared.

A fenced block whose info string names a file (``c main.c``) is that file; one that names a generated file is an excerpt
of it; a ``diff`` is applied to the file that it names; in a ``console`` block each line ``$ command`` is followed by what
the command prints on standard output. A line ``...`` stands for any number of lines. Numbers agree to nine digits.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isclose
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GENERATED = "generated/"

_FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
_ELISION = "..."


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, the file that its info string names (empty for none), its text."""

    language: str
    name: str
    text: str
    line: int


@dataclass(frozen=True)
class Step:
    """A command of a console session and the lines that it is said to print."""

    command: str
    expected: tuple[str, ...]


def blocks(document: Path) -> list[Block]:
    """The fenced blocks of a document, in order."""
    text = document.read_text(encoding="utf-8")
    return [Block(m[1], m[2] or "", m[3], text.count("\n", 0, m.start()) + 1) for m in _FENCE.finditer(text)]


def steps(session: str) -> Iterator[Step]:
    """The commands of a console session; a command goes on in the next line after a backslash."""
    for part in re.split(r"^\$ ", session, flags=re.MULTILINE)[1:]:
        command, _, printed = re.sub(r"\\\n", "", part).partition("\n")
        yield Step(command, tuple(printed.splitlines()))


class Workshop:
    """A folder where a document's commands work as they do in a checkout whose environment has been set up."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._shims = folder / ".shims"
        self._shims.mkdir()
        # The recipe is the Makefile's; only the environment is that of the tests, and the folder this one.
        self._shim("make", f'exec make --no-print-directory -C "{ROOT}" RUNTIME=Makefile '
                   f'COUNTERPOISE="{sys.executable} -m generator" out="$PWD/generated" "$@"')
        self._shim("counterpoise", f'exec "{sys.executable}" -m generator "$@"')
        self._shim("python", f'exec "{sys.executable}" "$@"')

    def play(self, document: Path) -> None:
        """Writes, applies, runs and compares every block of a document, in order."""
        for block in blocks(document):
            place = f"{document.name}:{block.line}"
            if block.language == "console":
                for step in steps(block.text):
                    agree(self.run(step.command), step.expected, f"{place}: $ {step.command}")
            elif block.language == "diff":
                self._apply(block, place)
            elif block.name.startswith(GENERATED):
                lines = (self.folder / block.name).read_text(encoding="utf-8").splitlines()
                agree(lines, (_ELISION, *block.text.splitlines(), _ELISION), place)
            elif block.name:
                path = self.folder / block.name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(block.text, encoding="utf-8")

    def run(self, command: str) -> list[str]:
        """The lines that a shell command prints, paths made relative; fails the test if the command fails."""
        path = os.pathsep.join((str(self._shims), os.environ["PATH"]))
        done = subprocess.run(
            ["/bin/sh", "-c", command],
            cwd=self.folder,
            env={**os.environ, "PATH": path, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"$ {command}\n{done.stdout}{done.stderr}"
        return done.stdout.replace(f"{self.folder}/", "").splitlines()

    def _shim(self, name: str, line: str) -> None:
        script = self._shims / name
        outer = 'PATH="${PATH#*:}"\n'  # so that a shim finds the command that it stands before
        script.write_text(f"#!/bin/sh\n{outer}{line}\n", encoding="utf-8")
        script.chmod(0o755)

    def _apply(self, block: Block, place: str) -> None:
        """Context and additions; the context must stand once in the file."""
        path = self.folder / block.name
        text, lines = path.read_text(encoding="utf-8"), block.text.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if not line.startswith("+"))
        after = "".join(line[1:] for line in lines if not line.startswith("-"))
        assert text.count(before) == 1, f"{place}: the context does not stand once in {block.name}"
        path.write_text(text.replace(before, after), encoding="utf-8")


def agree(printed: Sequence[str], expected: Sequence[str], what: str) -> None:
    """Fails the test unless the lines are those expected."""
    told = f"{what}\nexpected\n" + "\n".join(expected) + "\nprinted\n" + "\n".join(printed)
    assert _matches(list(printed), list(expected)), told


def _matches(printed: list[str], expected: list[str]) -> bool:
    if not expected:
        return not printed
    if expected[0] == _ELISION:
        return any(_matches(printed[skipped:], expected[1:]) for skipped in range(len(printed) + 1))
    return bool(printed) and same(printed[0], expected[0]) and _matches(printed[1:], expected[1:])


def same(printed: str, expected: str) -> bool:
    """Whether two lines are the same but for what rounding does to the last digits of their numbers."""
    if _NUMBER.sub("#", printed.rstrip()) != _NUMBER.sub("#", expected.rstrip()):
        return False
    pairs = zip(_NUMBER.findall(printed), _NUMBER.findall(expected), strict=True)
    return all(isclose(float(a), float(b), rel_tol=1e-9, abs_tol=1e-9) for a, b in pairs)
