"""Recorded runs in their formats: one module each, found by the ending of the file's name."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from generator.discovery import modules
from generator.errors import InputError, Place
from identification.recording import Recording

_NUMBERS = "a column of numbers that are no text, without a row of units"


def read(path: Path) -> Recording:
    """The columns of a run file.

    Raises InputError, with the place, for a file that is not there, of an unknown kind, or not what its ending says.
    """
    file = str(path)
    readers = {ending: module for module in modules(sys.modules[__name__]) for ending in module.EXTENSIONS}
    reader = readers.get(path.suffix.lower())
    expected = f"a run in {' or '.join(readers)}"
    if reader is None:
        raise InputError(Place(file), f"a run file ending in {path.suffix!r}", expected)
    if not os.path.isfile(path):
        problem = "there is no such file" if not os.path.exists(path) else "this is not a regular file"
        raise InputError(Place(file), problem, expected)
    try:
        recording: Recording = reader.read(path)
    except OSError as error:
        raise InputError(Place(file), f"cannot read the file ({error.strerror or error})", expected) from None
    if not recording.columns:
        for fault in recording.faults.values():
            raise fault
        for name, (row, word) in recording.words.items():
            raise InputError(recording.where(row, name), f"{name} is the text {word!r}", _NUMBERS)
    if not recording.rows:
        raise InputError(Place(file), "there are no samples in the file", "a header and a row of numbers a sample")
    return recording
