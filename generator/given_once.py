"""Names on a command line that may stand there once."""

from __future__ import annotations

from collections.abc import Iterable

from generator.errors import InputError, Place


def given_once(words: Iterable[str], place: Place) -> None:
    """Raises InputError where two of the words ``NAME=VALUE`` or ``NAME`` have one name."""
    seen = set()
    for word in words:
        name = word.partition("=")[0]
        if name in seen:
            raise InputError(place, f"{name} is given twice", "it once")
        seen.add(name)
