"""Methods of minimisation: one module each, found by being in this folder.

A module has ``SUMMARY`` and ``minimise(search, start)``: the Minimum from parameter values ``start`` (b) on.
"""

from __future__ import annotations

import sys
from types import ModuleType

from generator.discovery import modules


def methods() -> dict[str, ModuleType]:
    """By name, as the command line has them."""
    found = modules(sys.modules[__name__])
    return {module.__name__.rpartition(".")[2].replace("_", "-"): module for module in found}
