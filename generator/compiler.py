"""The C compiler of the machine."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass

from generator.errors import InputError, Place


@dataclass(frozen=True)
class Done:
    """What a command left: its exit status and what it printed."""

    status: int
    output: str

    @property
    def reason(self) -> str:
        """The first error that it told, or else the last line."""
        lines = self.output.strip().splitlines() or ["it says nothing"]
        return next((line for line in lines if re.search(r"\berror:", line)), lines[-1])


def compiler() -> list[str]:
    """The C compiler's command: the environment variable CC, or ``cc``; raises InputError for what is no command."""
    told = os.environ.get("CC", "")
    try:
        return shlex.split(told) or ["cc"]
    except ValueError as error:
        raise InputError(Place("CC"), f"{told!r} is no command ({error})", "a C compiler; set CC") from None


def run(command: Sequence[str]) -> Done:
    """Runs a command. Raises InputError where there is no such program."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    except FileNotFoundError:
        raise InputError(Place(command[0]), "there is no such program", "a C compiler; set CC") from None
    except OSError as error:
        raise InputError(Place(command[0]), f"it cannot be run ({error.strerror})", "a C compiler; set CC") from None
    # A compiler speaks in whatever encoding its locale has.
    return Done(done.returncode, done.stdout.decode(errors="replace"))
