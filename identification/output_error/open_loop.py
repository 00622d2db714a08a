"""The open loop: positions that the direct model makes of measured torques (report eq. 59, 60).

Friction is that of sign(qd), with its events located, as in the generated simulation: a surface sticks and slides on.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from identification.output_error.experiment import Experiment

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Trajectory:
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

    def run(self, experiment: Experiment, start: Array) -> Trajectory:
        """The segments of an experiment from their first states ``start`` (S x 2n) on, NaN once they diverge."""
        segments, _, n = experiment.tau.shape
        shape = experiment.q.shape
        q, qd = np.empty(shape), np.empty(shape)
        for k in range(segments):
            plant = self.module.Plant(self.model, "rigid", start[k, :n], start[k, n:])
            all_q, all_qd = plant.run(experiment.period, experiment.tau[k])
            q[k], qd[k] = all_q[:: experiment.stride], all_qd[:: experiment.stride]
        return Trajectory(q, qd, experiment.tau[:, :: experiment.stride])
