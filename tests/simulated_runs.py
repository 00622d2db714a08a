"""What simulated runs of robots with motors hold."""

from __future__ import annotations

import numpy as np

from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated
from tests.elastic_links import KT, N
from tests.recorded import Array

#: A few seconds of a simulation, with references and links.
SHORT = Settings(duration=4.0, further=("qr", "qs"))


def columns(run: Simulated, stem: str) -> Array:
    """Columns of all joints (N x n)."""
    return np.stack([run.columns[f"{stem}{k}"] for k in range(1, 1 + sum(n.startswith("qm") for n in run.columns))], 1)


def motors(run: Simulated, coupling: Array = N, constants: Array = KT) -> tuple[Array, Array]:
    """Positions and torques of the motors on the joint side (N x n each), by report eq. 14 and 75."""
    return columns(run, "qm") @ np.linalg.inv(coupling).T, (columns(run, "i") * constants) @ coupling
