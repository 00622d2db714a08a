"""Every law of ``laws/``, found by being there."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping

import tests.plant.laws
from tests.plant.law import Law


def _load() -> dict[str, Law]:
    names = sorted(module.name for module in pkgutil.iter_modules(tests.plant.laws.__path__))
    return {name: importlib.import_module(f"tests.plant.laws.{name}").LAW for name in names}


#: Every law by its name, in the alphabet's order.
LAWS: Mapping[str, Law] = _load()

#: The names of laws that are torques: a law's number in C is its place here.
TORQUES: tuple[str, ...] = tuple(name for name, law in LAWS.items() if law.torque)
