"""How well parameters are known beforehand, and values that are wrong by as much."""

from __future__ import annotations

from collections.abc import Mapping
from zlib import crc32

import numpy as np

#: Relative standard deviation [%] by what a parameter is of; the rest is inertial.
RELATIVE = {"offset": 5.0, "viscous": 5.0, "coulomb": 5.0, "wrist_friction": 5.0}
INERTIAL = 2.0


def deviation(what: str, value: float) -> float:
    """Standard deviation of a parameter of a law, or of a body."""
    return abs(value) * RELATIVE.get(what, INERTIAL) / 100


def relative(name: str) -> float:
    """Relative standard deviation [%] of a parameter by its name in a robot file."""
    return 5.0 if name.startswith(("Fv", "Fc", "Off")) else INERTIAL


def drawn(values: Mapping[str, float], seed: int) -> dict[str, float]:
    """Values by name, each wrong by a draw of its standard deviation; a draw depends on the seed and the name alone."""
    result = {}
    for name, value in values.items():
        error = np.random.default_rng([seed, crc32(name.encode())]).normal()
        result[name] = value * (1 + relative(name) / 100 * error)
    return result
