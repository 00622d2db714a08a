"""The open loop: positions that the direct model makes of measured torques (report eq. 59, 60).

Friction is that of sign(qd), with its events located, as in the generated simulation: a surface sticks and slides on.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from identification.arrays import Array
from identification.output_error.experiment import Experiment

#: Compared samples after which it is looked whether the simulation is lost, and how far that is [rad, m].
_PIECE, _LOST = 25, 10.0


@dataclass(frozen=True)
class SimulatedMotion:
    """Simulated positions and speeds (S x K x n) [rad, m, s] at the samples that are compared, with the torques."""

    q: Array
    qd: Array
    tau: Array


class OpenLoop:
    """The generated simulation of a robot with values of its parameters [SI], by name; absent base parameters are 0."""

    def __init__(self, module: Any, values: Mapping[str, float]) -> None:
        self.module = module
        base = dict.fromkeys(module.BASE_PARAMETERS, 0.0)
        self.model = module.Robot({**base, **{k: v for k, v in values.items() if k in module.PARAMETERS}})

    def run(self, experiment: Experiment, start: Array) -> SimulatedMotion:
        """The segments of an experiment from their first states ``start`` (S x 2n) on.

        A segment is NaN from where it is lost: more than 10 rad or m from what was measured, or no longer finite. What
        turns that fast takes long to simulate and tells nothing.
        """
        n, stride = experiment.tau.shape[-1], experiment.stride
        q, qd = (np.full(experiment.q.shape, np.nan) for _ in range(2))
        for k, measured in enumerate(experiment.q):
            plant = self.module.Plant(self.model, "rigid", start[k, :n], start[k, n:])
            for first in range(0, len(measured), _PIECE):
                piece = slice(first, first + _PIECE)
                tau = experiment.tau[k, first * stride : (first + _PIECE) * stride]
                some_q, some_qd = plant.run(experiment.period, tau)
                q[k, piece], qd[k, piece] = some_q[::stride], some_qd[::stride]
                if not np.abs(q[k, piece] - measured[piece]).max() < _LOST:
                    q[k, piece] = np.nan
                    break
        return SimulatedMotion(q, qd, experiment.tau[:, :: experiment.stride])
