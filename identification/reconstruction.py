"""Torques row by row, as measured and as models have them: what residuals look like, not only how large they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.observed import Observed
from identification.sampling import Sampled


@dataclass(frozen=True)
class Reconstruction:
    """Rows of one joint (from 0) in one run, in time order: times [s], position, speed, torques [rad, m, N m, N].

    ``estimated`` are the torques W chi by the model's name (rows each), ``step`` is the time between rows where none
    was left out [s].
    """

    joint: int
    t: Array
    q: Array
    qd: Array
    measured: Array
    estimated: Mapping[str, Array]
    step: float

    def residual(self, model: str) -> Array:
        """Y - W chi (rows)."""
        e: Array = self.measured - self.estimated[model]
        return e


def reconstructed(run: Observed, models: Mapping[str, Mapping[str, float]]) -> tuple[Reconstruction, ...]:
    """The torques of all joints of a run, by models that give values of all its parameters."""
    parts: dict[int, list[_Part]] = {}
    for rows in run.rows():
        estimated = {name: rows.W @ np.array([chi[one] for one in rows.names]) for name, chi in models.items()}
        parts.setdefault(rows.joint, []).append(_Part(rows.t, rows.Y, estimated))
    return tuple(_joined(run.sampled, joint, parts[joint]) for joint in sorted(parts))


@dataclass(frozen=True)
class _Part:
    """Consecutive rows without their observation matrix."""

    t: Array
    Y: Array
    estimated: Mapping[str, Array]


def _joined(run: Sampled, joint: int, parts: list[_Part]) -> Reconstruction:
    t, Y = np.concatenate([part.t for part in parts]), np.concatenate([part.Y for part in parts])
    estimated = {name: np.concatenate([part.estimated[name] for part in parts]) for name in parts[0].estimated}
    at = np.rint((t - run.times[0]) / run.run.period).astype(int)
    step = run.filters.factor * run.run.period
    return Reconstruction(joint, t, run.motion.q[joint, at], run.motion.qd[joint, at], Y, estimated, step)
