"""Programs that not every machine has: skipped by name where absent, a failure in CI."""

from __future__ import annotations

import os
import shutil

import pytest


def tool(*names: str) -> str:
    """The path of the first of ``names`` that is installed."""
    found = next((path for name in names if (path := shutil.which(name))), None)
    if found is not None:
        return found
    missing = f"{' or '.join(names)} is not installed"
    if os.environ.get("CI") == "true":
        pytest.fail(missing)
    pytest.skip(missing)
