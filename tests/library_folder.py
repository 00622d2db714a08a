"""What the library of the generated Python module is compiled from."""

from __future__ import annotations

from pathlib import Path

from generator.backends import batch, c, python, simulation
from tests.compiled import write
from tests.subject import Subject


def folder_of(arm: Subject, folder: Path) -> Path:
    """The robot's C, batch, Python and simulation, written into a folder."""
    write(folder / "c", c.library(arm.model, ()))
    for backend in (batch, python, simulation):
        write(folder / backend.NAME, backend.emit(arm.model))
    return folder
