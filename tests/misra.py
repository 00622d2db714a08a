"""Generated C under cppcheck's MISRA addon, and the rules that docs/misra.md documents."""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path

from tests.commands import ROOT
from tests.compiled import run

_OPTIONS = ("--addon=misra", "--enable=all", "--std=c99", "--suppress=missingIncludeSystem", "--quiet")


def checked(source: Path, *macros: str) -> str:
    """What cppcheck says of a file."""
    # Python packages put their programs beside the interpreter.
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    return run([shutil.which("cppcheck", path=path) or "cppcheck", *_OPTIONS, *macros, source])


def documented_rules() -> set[str]:
    """Rules that the C is said to break."""
    return set(re.findall(r"^\| (\d+\.\d+) \|", (ROOT / "docs/misra.md").read_text(), re.MULTILINE))
