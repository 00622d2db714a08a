"""Instructions that a program executes in one of its functions, counted by valgrind's callgrind."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from benchmarks.compiling import run


def collected(function: str, program: Sequence[str | Path]) -> int:
    """Of all calls while ``program`` runs, what they call included; raises Missing without valgrind, RuntimeError with
    what it said if it counted nothing.
    """
    callgrind = ["valgrind", "--tool=callgrind", f"--toggle-collect={function}", "--callgrind-out-file=/dev/null"]
    told = run([*callgrind, *program], errors_too=True)
    counted = re.search(r"Collected : (\d+)", told)
    if not counted:
        raise RuntimeError(f"callgrind collected nothing\n{told}")
    return int(counted[1])
