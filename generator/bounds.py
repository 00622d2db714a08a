"""Bounds of numbers on the command line, so that one mistake has one wording in every command.

Each returns the value itself; ``argument`` is what it was given for, as ``command_line`` takes it.
"""

from __future__ import annotations

from math import inf

from generator.command_line import command_line
from generator.errors import InputError


def above(value: float, argument: str, bound: float, most: float = inf) -> float:
    """A finite number; raises InputError where it is not above ``bound``, or above ``most`` if there is one."""
    if not bound < value < inf or value > most:
        raise InputError(command_line(argument), f"{value:g}", f"a number above {bound:g}{_end(most)}")
    return value


def not_negative(value: float, argument: str, most: float = inf) -> float:
    """A finite number; raises InputError where it is below zero, or above ``most`` if there is one."""
    if not 0 <= value < inf or value > most:
        raise InputError(command_line(argument), f"{value:g}", f"a number that is not negative{_end(most)}")
    return value


def whole_number(value: int, argument: str, least: int, most: int | None = None) -> int:
    """A whole number; raises InputError where it is below ``least``, or above ``most`` if there is one."""
    if value < least or (most is not None and value > most):
        end = "on" if most is None else f"to {most}"
        raise InputError(command_line(argument), f"{value}", f"a whole number from {least} {end}")
    return value


def _end(most: float) -> str:
    return f", {most:g} at most" if most < inf else ""
