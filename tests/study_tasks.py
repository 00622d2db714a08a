"""Tasks of studies, in a module of their own that processes import at once."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from generator.errors import InputError, Place


def squared(task: tuple[int, str]) -> int:
    """Leaves a mark of its number."""
    number, place = task
    mark = Path(place, f"done_{number}")
    mark.write_text(mark.read_text() + "again" if mark.exists() else "once")
    return number**2


def first_dies(task: tuple[int, str]) -> int:
    """The process that does task 1 for the first time dies."""
    number, place = task
    mark = Path(place, "died")
    if number == 1 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number**2


def refuses(task: int) -> int:
    """As a user's mistake is."""
    raise InputError(Place("cc"), "there is no compiler", "gcc")


def dies(task: int) -> int:
    """Every process that does it."""
    os.kill(os.getpid(), signal.SIGKILL)
    return task
