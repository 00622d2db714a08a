"""Options whose names only the robot's model knows: ``--q 0.1 -0.2``, ``--qd=-1e-3,pi/4``."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from generator.command_line import command_line
from generator.errors import InputError
from generator.expressions import parse_number
from generator.symbolic.function import Signal
from generator.words import plural

_WORD = re.compile(r"[^\s,]+")

#: Inputs that stand for nothing being there when they are not given.
_ZERO_IF_ABSENT = ("wrench", "payload", "states", "warmth")


def split(words: Sequence[str], command: str) -> dict[str, str]:
    """The text of each option by its name (``_`` for ``-``); words after an option are its text up to the next.

    Only two dashes begin an option, so that numbers may be negative in any notation. Raises InputError for an option
    given twice and a word before the first.
    """
    given: dict[str, list[str]] = {}
    texts: list[str] | None = None
    for word in words:
        if word.startswith("--"):
            name, equals, text = word[2:].partition("=")
            name = name.replace("-", "_")
            if name in given:
                raise InputError(command_line(f"{command} --{name}"), "the option is given twice", "it once")
            texts = given[name] = [text] if equals else []
        elif texts is None:
            raise InputError(command_line(command), f"unexpected word {word!r}", "--SIGNAL NUMBER ...")
        else:
            texts.append(word)
    return {name: " ".join(texts) for name, texts in given.items()}


def value(signal: Signal, given: dict[str, str], command: str) -> NDArray[np.float64]:
    """The numbers given for an input signal, shape (size,), in the signal's units.

    A wrench, a payload, states and warmth that are not given are zero. Raises InputError for a signal that is missing,
    for a wrong count and for a word that is no number.
    """
    if signal.name not in given:
        if signal.name in _ZERO_IF_ABSENT:
            return np.zeros(signal.size)
        raise InputError(command_line(command), f"--{signal.name} is missing", describe(signal))
    option, text = f"{command} --{signal.name}", given[signal.name]
    numbers = [
        float(parse_number(word.group(), command_line(option, word.start() + 1))) for word in _WORD.finditer(text)
    ]
    if len(numbers) != signal.size:
        raise InputError(command_line(option), plural(len(numbers), "number"), describe(signal))
    return np.array(numbers)


def describe(signal: Signal) -> str:
    """What a signal holds: ``6 numbers in rad (joint positions)``."""
    units = signal.units[0] if len(set(signal.units)) == 1 else ", ".join(signal.units)
    count = plural(signal.size, "number")
    return f"{count} ({signal.meaning})" if units == "1" else f"{count} in {units} ({signal.meaning})"
