"""Generated code written into files, compiled by commands, or run as Python modules."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

#: Of libraries that the tests load: without start files, which after -ffast-math and -funsafe-math-optimizations round
#: small numbers of the whole process to zero.
SHARED = ("-shared", "-fPIC", "-nostartfiles")


def write(folder: Path, files: Mapping[str, str | bytes]) -> Path:
    """Writes what a backend emitted; returns ``folder``."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    return folder


def run(command: Sequence[str | Path], **options: Any) -> str:
    """The output of a command; fails the test with that output if the command fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    output: str = done.stdout
    assert done.returncode == 0, f"{' '.join(words)}\n{output}"
    return output


def module(source: str | bytes, name: str) -> ModuleType:
    """A generated Python module, run."""
    result = ModuleType(name)
    exec(compile(source, f"{name}.py", "exec"), result.__dict__)
    return result
