"""Places on the command line, for errors of the same form as those in files."""

from __future__ import annotations

from generator.errors import Place


def command_line(argument: str, column: int = 1) -> Place:
    """Character ``column`` (from 1) of what was given for ``argument``, written as ``counterpoise evaluate --qd``."""
    return Place(argument, 1, column)
