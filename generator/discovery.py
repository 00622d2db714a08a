"""Listing the modules of a package, so that a new file in a folder is found without a register."""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType


def modules(package: ModuleType) -> list[ModuleType]:
    """The modules directly inside ``package``, imported, sorted by name; no packages, no ``_private`` ones."""
    names = sorted(
        found.name
        for found in pkgutil.iter_modules(package.__path__)
        if not found.ispkg and not found.name.startswith("_")
    )
    return [importlib.import_module(f"{package.__name__}.{name}") for name in names]
