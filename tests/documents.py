"""Documents as programs: named code blocks become files, console sessions are run, printed output is compared.

A fenced block whose info string names a file (``c main.c``) is that file; one that names a generated file is an
excerpt of it; a ``diff`` is applied to the file that it names; in a ``console`` block each line ``$ command`` is
followed by what the command prints on standard output. A line ``...`` stands for any number of lines. Numbers agree to
nine digits.

``python -m tests.documents`` puts what the commands print today into the documents; ``git diff`` then shows it.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import isclose
from pathlib import Path

from tests.commands import ROOT

#: The documents that hold sessions, and whether they are played in a copy of the tree, which they change.
SESSIONS = {
    "README.md": False,
    "docs/batch.md": False,
    "docs/conventions.md": False,
    "docs/extending.md": True,
    "docs/output_error.md": False,
    "docs/simulation.md": False,
}

_GENERATED = "generated/"
_FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
_ELISION = "..."
_OF_MAKE = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES", "robot", "out")


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, the file that its info string names (empty for none), its text."""

    language: str
    name: str
    text: str


@dataclass(frozen=True)
class Step:
    """A command of a console session as it is written, and the lines that it is said to print."""

    written: str
    expected: tuple[str, ...]

    @property
    def command(self) -> str:
        """The command in one line."""
        return self.written.replace("\\\n", "")


def blocks(text: str) -> list[Block]:
    """The fenced blocks of a document, in order."""
    return [_block(match) for match in _FENCE.finditer(text)]


def steps(session: str) -> Iterator[Step]:
    """The commands of a console session; a command goes on in the next line after a backslash."""
    for part in re.split(r"^\$ ", session, flags=re.MULTILINE)[1:]:
        written, _, printed = re.sub(r"\\\n", "\0", part).partition("\n")
        yield Step(written.replace("\0", "\\\n"), tuple(printed.splitlines()))


class Workshop:
    """A folder where a document's commands work as they do in a checkout whose environment has been set up."""

    def __init__(self, folder: Path, with_tree: bool = False) -> None:
        self.folder = folder
        self._shims = folder / ".shims"
        self._shims.mkdir()
        python = f'"{sys.executable}"'
        # The recipe is the Makefile's; only the environment is that of the tests, and the folder this one.
        out = f"RUNTIME=Makefile COUNTERPOISE='{python} -m generator' out=\"$PWD/generated\""
        self._shim("make", f'exec make --no-print-directory -C "{ROOT}" {out} "$@"')
        self._shim("counterpoise", f'exec {python} -m generator "$@"')
        self._shim("python", f'exec {python} "$@"')
        if with_tree:
            for package in ("generator", "identification"):
                shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__"))
            shutil.copy(ROOT / "pyproject.toml", folder)
            for name in ("robots", "templates"):
                (folder / name).symlink_to(ROOT / name)

    def played(self, text: str) -> str:
        """The document with the output that its commands print; output that agrees stays as it is written.

        Fails the test if a command fails, or if an excerpt or a change does not fit its file.
        """
        return _FENCE.sub(lambda match: self._played(_block(match), match[0]), text)

    def run(self, command: str) -> list[str]:
        """The lines that a shell command prints, paths made relative; fails the test if the command fails."""
        path = f"{self._shims}{os.pathsep}{os.environ['PATH']}"
        # The tests may themselves run under make, whose variables are not the reader's.
        inherited = {name: value for name, value in os.environ.items() if name not in _OF_MAKE}
        done = subprocess.run(
            ["/bin/sh", "-c", command],
            cwd=self.folder,
            env=inherited | {"PATH": path, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"$ {command}\n{done.stdout}{done.stderr}"
        return done.stdout.replace(f"{self.folder}/", "").splitlines()

    def _played(self, block: Block, written: str) -> str:
        path = self.folder / block.name
        if block.language == "console":
            session = "".join(self._stepped(step) for step in steps(block.text))
            return f"```console\n{session}```"
        if block.language == "diff":
            _apply(block, path)
        elif block.name.startswith(_GENERATED):
            excerpt = (_ELISION, *block.text.splitlines(), _ELISION)
            assert agree(path.read_text(encoding="utf-8").splitlines(), excerpt), f"not in {block.name}:\n{block.text}"
        elif block.name:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
        return written

    def _stepped(self, step: Step) -> str:
        printed = self.run(step.command)
        if agree(printed, step.expected):
            lines: Sequence[str] = step.expected
        else:
            lines = _aligned(printed, step.expected, _alike) or printed
        return "\n".join((f"$ {step.written}", *lines, ""))

    def _shim(self, name: str, line: str) -> None:
        script = self._shims / name
        outer = 'PATH="${PATH#*:}"'  # so that a shim finds the command that it stands before
        script.write_text(f"#!/bin/sh\n{outer}\n{line}\n", encoding="utf-8")
        script.chmod(0o755)


def agree(printed: Sequence[str], expected: Sequence[str]) -> bool:
    """Whether the lines are those expected, numbers to nine digits."""
    return _aligned(printed, expected, _same) is not None


def _aligned(
    printed: Sequence[str], expected: Sequence[str], fit: Callable[[str, str], bool]
) -> tuple[str, ...] | None:
    """The printed lines that stand where the expected ones do, with the elisions; None where they do not fit."""
    if not expected:
        return None if printed else ()
    if expected[0] == _ELISION:
        rests = (_aligned(printed[skipped:], expected[1:], fit) for skipped in range(len(printed) + 1))
        rest = next((rest for rest in rests if rest is not None), None)
        return None if rest is None else (_ELISION, *rest)
    if not printed or not fit(printed[0], expected[0]):
        return None
    rest = _aligned(printed[1:], expected[1:], fit)
    return None if rest is None else (printed[0], *rest)


def _alike(printed: str, expected: str) -> bool:
    """Whether two lines are the same but for their numbers."""
    return _NUMBER.sub("#", printed).split() == _NUMBER.sub("#", expected).split()


def _same(printed: str, expected: str) -> bool:
    """Whether two lines are the same but for what rounding does to the last digits of their numbers."""
    if _NUMBER.sub("#", printed) != _NUMBER.sub("#", expected):
        return False
    pairs = zip(_NUMBER.findall(printed), _NUMBER.findall(expected), strict=True)
    return all(isclose(float(a), float(b), rel_tol=1e-9, abs_tol=1e-9) for a, b in pairs)


def _block(match: re.Match[str]) -> Block:
    return Block(match[1], match[2] or "", match[3])


def _apply(block: Block, path: Path) -> None:
    """Puts the additions beside their context, which must stand once in the file."""
    text, lines = path.read_text(encoding="utf-8"), block.text.splitlines(keepends=True)
    before = "".join(line[1:] for line in lines if not line.startswith("+"))
    after = "".join(line[1:] for line in lines if not line.startswith("-"))
    assert text.count(before) == 1, f"the context does not stand once in {block.name}:\n{before}"
    path.write_text(text.replace(before, after), encoding="utf-8")


def main() -> None:
    """Rewrites the sessions of every document."""
    for name, with_tree in SESSIONS.items():
        document = ROOT / name
        with tempfile.TemporaryDirectory() as folder:
            played = Workshop(Path(folder), with_tree).played(document.read_text(encoding="utf-8"))
        document.write_text(played, encoding="utf-8")


if __name__ == "__main__":
    main()
