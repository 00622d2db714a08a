"""What the sections of an identification's report are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from generator.quantities import signals
from identification.arrays import Array
from identification.consistent_fit import ConsistentFit
from identification.inverse_model import Identification
from identification.observed import Observed
from identification.reconstruction import Reconstruction
from identification.report.series import some

#: The models' names on the page.
ALL, ESSENTIAL, CONSISTENT = "all parameters", "essential parameters", "consistent parameters"
#: Positions of a run at which the inertia matrix is looked at.
_POSITIONS = 1000


@dataclass(frozen=True)
class ShownRun:
    """A run by the ``name`` that it has on the page, with its torques row by row, by joint (from 0)."""

    name: str
    held_out: bool
    observed: Observed
    torques: Mapping[int, Reconstruction]


@dataclass(frozen=True)
class Subject:
    """An identification, ``results`` as in results.json, ``models``: values by the models' names, and all runs."""

    found: Identification
    consistent: ConsistentFit | None
    results: Mapping[str, Any]
    models: Mapping[str, Mapping[str, float]]
    runs: tuple[ShownRun, ...]

    @property
    def numbers(self) -> tuple[int, ...]:
        """The joints' numbers."""
        return self.found.robot.numbers

    @property
    def torque_units(self) -> dict[int, str]:
        """By the joint's number."""
        return dict(zip(self.numbers, signals.torque_units(self.found.regressors.model), strict=True))

    @property
    def position_units(self) -> dict[int, str]:
        """By the joint's number."""
        return dict(zip(self.numbers, signals.position_units(self.found.regressors.model), strict=True))

    @property
    def residuals(self) -> dict[str, Mapping[str, Any]]:
        """The key ``residual`` of results.json by model."""
        own = {ALL: self.results, ESSENTIAL: self.results["essential"], CONSISTENT: self.results["consistent"]}
        return {name: own[name]["residual"] for name in self.models}

    @cached_property
    def eigenvalues(self) -> dict[str, dict[str, tuple[Array, Array]]]:
        """Of M(q) along the runs (report fig. 33): by model and run, times (N) and ascending eigenvalues (N x n)."""
        regressors = self.found.regressors
        return {
            model: {run.name: _eigenvalues(run, regressors.inertia, values) for run in self.runs}
            for model, values in self.models.items()
        }


def _eigenvalues(run: ShownRun, inertia: Any, values: Mapping[str, float]) -> tuple[Array, Array]:
    one = run.observed.sampled
    at = some(one.motion.samples, _POSITIONS)
    return one.times[at], np.linalg.eigvalsh(inertia(values, one.motion.q[:, at]))
