"""Robots, one file each: ROBOT, plain numbers."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping

from tests.plant.robot import Robot


def _load() -> dict[str, Robot]:
    names = sorted(module.name for module in pkgutil.iter_modules(__path__))
    return {name: importlib.import_module(f"{__name__}.{name}").ROBOT for name in names}


#: Every robot by its file's name.
ROBOTS: Mapping[str, Robot] = _load()
