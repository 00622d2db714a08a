"""What the noise of positions makes a hypothesis explain that is not there (Fuller, Measurement Error Models, 1987).

Columns are of the same recorded positions as the model's torque: of the accelerations of their errors r is missing in
what the model leaves, and d is too much in a column. The product of both holds -d r, whatever is true.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis import position_noise, rounding
from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.perturbation import moved
from identification.diagnosis.position_noise import drawn, torque_of
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]


class Redrawn:
    """A run with ``noise`` (n) [rad, m] of its positions once more, by draw ``number``: what that changes in its rows.

    ``torque`` (n x rows) [N m, N] is what the model's torque changes by.
    """

    def __init__(self, run: Prepared, scene: Scene, noise: Array, number: int) -> None:
        error = drawn(scene, noise, number)
        self._run, self._old = run, scene
        self._new = replace(scene, sampled=replace(scene.sampled, motion=moved(scene.motion, error, 1.0)))
        self._known: dict[tuple[int, ...], Array] = {}
        self.torque = run.decimated(torque_of(error, scene))

    @cached_property
    def base(self) -> list[dict[str, Array]]:
        """By joint, the change of the model's columns (rows) by name."""
        regressors = self._old.regressors
        new, old = (regressors.base(scene.motion) for scene in (self._new, self._old))
        return [
            dict(zip(names, self._run.decimated(a - b), strict=True))
            for names, a, b in zip(regressors.structure, new, old, strict=True)
        ]

    def of(self, variant: Variant) -> Array:
        """The change of a variant's columns (k x n x rows)."""
        if variant.columns not in self._known:
            columns, shape = variant.hypothesis.columns, variant.shape
            change = (columns(self._new, shape) - columns(self._old, shape))[list(variant.used)]
            self._known[variant.columns] = self._run.decimated(change)
        return self._known[variant.columns]


def redrawn(runs: Sequence[Prepared], scenes: Sequence[Scene]) -> dict[int, Redrawn]:
    """By number, the runs whose positions are not exact, each with as much noise once more."""
    result = {}
    for r, (run, scene) in enumerate(zip(runs, scenes, strict=True)):
        q = scene.sampled.run.q
        # Rounding is noise like any other, but where a joint is so slow that its steps hide it from differences.
        noise = np.maximum(position_noise.deviations(q), rounding.deviations(q))
        if noise.any():
            result[r] = Redrawn(run, scene, noise, r)
    return result


class Pretence:
    """Of the products of white columns with the torque what the noise of the positions makes, along the runs that are
    ``redrawn``.
    """

    def __init__(self, bank: Bank, redrawn: Mapping[int, Redrawn]) -> None:
        self._bank, self._redrawn = bank, redrawn
        self._known: dict[tuple[int, ...], Array] = {}

    @property
    def nothing(self) -> bool:
        """Whether the positions of all runs are exact."""
        return not self._redrawn

    @cached_property
    def base(self) -> Array:
        """Of the base columns (p)."""
        result = np.zeros(len(self._bank.base))
        place = {name: number for number, name in enumerate(self._bank.base)}
        for r, one in self._redrawn.items():
            for k, change in enumerate(one.base):
                rows = np.stack([*change.values()])
                result[[place[name] for name in change]] -= self._white(r, k, rows) @ self._torques[r][k]
        return result

    def of(self, variant: Variant) -> Array:
        """Of a variant's columns (k)."""
        if variant.columns not in self._known:
            result = np.zeros(len(variant.columns))
            for r, one in self._redrawn.items():
                for k in variant.joints:
                    result -= self._white(r, k, one.of(variant)[:, k]) @ self._torques[r][k]
            self._known[variant.columns] = result
        return self._known[variant.columns]

    def beside(self, variants: Sequence[Variant]) -> Array:
        """Of the base columns and of those of ``variants`` (p + k)."""
        return np.concatenate([self.base, *map(self.of, variants)])

    @cached_property
    def _torques(self) -> dict[int, list[Array]]:
        """By run, the white change of each joint's torque."""
        return {
            r: [self._white(r, k, row[None])[0] for k, row in enumerate(one.torque)] for r, one in self._redrawn.items()
        }

    def _white(self, r: int, k: int, rows: Array) -> Array:
        return self._bank.colours[r][k].white(rows, self._bank.runs[r].kept[k])
