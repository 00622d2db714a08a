"""Folders of files that are not part of the repository; tests that need them are skipped where they are not at hand."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.commands import ROOT


@dataclass(frozen=True)
class Folder:
    """A folder that an environment ``variable`` names, else one ``beside`` the checkout.

    ``there`` says what it holds.
    """

    there: str
    variable: str
    beside: str

    @property
    def path(self) -> Path:
        """Where it is looked for."""
        return Path(os.environ.get(self.variable) or ROOT.parent / self.beside)

    @property
    def needed(self) -> pytest.MarkDecorator:
        """Skips tests where there is no such folder."""
        return pytest.mark.skipif(not self.path.is_dir(), reason=f"no {self.there}: {self.variable} names their folder")


RECORDINGS = Folder("recordings of real robots", "COUNTERPOISE_RECORDINGS", "shared/data")
TRANSCRIBED = Folder("tables transcribed from the report", "COUNTERPOISE_TABLES", "shared/report/tables")
