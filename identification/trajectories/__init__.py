"""Trajectories of simulated runs: one module each, found by being in this folder."""

from __future__ import annotations

import sys

from generator.discovery import modules
from identification.trajectory import Trajectory


def trajectories() -> dict[str, Trajectory]:
    """Every trajectory by its name."""
    found = [module.TRAJECTORY for module in modules(sys.modules[__name__])]
    return {one.name: one for one in found}
