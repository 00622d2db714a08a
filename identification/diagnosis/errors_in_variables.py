"""What rounded positions make a hypothesis explain that is not there (Fuller, Measurement Error Models, Wiley 1987).

Columns are of the same rounded positions as the model's torque: of the accelerations of their errors r is missing in
what the model leaves, and d is too much in a column. The product of both holds -d r, whatever is true.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.perturbation import moved
from identification.diagnosis.rounding import drawn_error, torque_of
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]


class Pretence:
    """Of the products of white columns with the torque what rounding makes, in one draw of it, along ``runs``."""

    def __init__(self, bank: Bank, runs: Sequence[int]) -> None:
        self._bank, self._runs = bank, runs
        self._known: dict[tuple[int, ...], Array] = {}

    @property
    def nothing(self) -> bool:
        """Whether no run has positions in steps."""
        return not self._rounded

    @cached_property
    def base(self) -> Array:
        """Of the base columns (p)."""
        result = np.zeros(len(self._bank.base))
        place = {name: number for number, name in enumerate(self._bank.base)}
        for r, (scene, white) in self._rounded.items():
            old = self._bank.scenes[r]
            pairs = [old.regressors.base(one.motion) for one in (scene, old)]
            for k, (names, new, was) in enumerate(zip(old.regressors.structure, *pairs, strict=True)):
                result[[place[name] for name in names]] -= self._white(r, k, new - was) @ white[k]
        return result

    def of(self, variant: Variant) -> Array:
        """Of a variant's columns (k)."""
        if variant.columns not in self._known:
            parts = [self._along(r, variant) for r in self._rounded]
            self._known[variant.columns] = np.sum([np.zeros(len(variant.columns)), *parts], axis=0)
        return self._known[variant.columns]

    @cached_property
    def _rounded(self) -> dict[int, tuple[Scene, list[Array]]]:
        """By the run's number the scene once more rounded, and the white torques that this makes; runs without steps
        lack.
        """
        result = {}
        for r in self._runs:
            scene = self._bank.scenes[r]
            if (error := drawn_error(scene, r)) is not None:
                torque = torque_of(error, scene)
                white = [self._white(r, k, row[None])[0] for k, row in enumerate(torque)]
                sampled = replace(scene.sampled, motion=moved(scene.motion, error, 1.0))
                result[r] = replace(scene, sampled=sampled), white
        return result

    def _along(self, r: int, variant: Variant) -> Array:
        scene, white = self._rounded[r]
        one, used = variant.hypothesis, list(variant.used)
        change = (one.columns(scene, variant.shape) - one.columns(self._bank.scenes[r], variant.shape))[used]
        parts = [self._white(r, k, change[:, k]) @ white[k] for k in variant.joints]
        return np.asarray(-np.sum([np.zeros(len(used)), *parts], axis=0))

    def _white(self, r: int, k: int, columns: Array) -> Array:
        run = self._bank.runs[r]
        return self._bank.colours[r][k].white(run.decimated(columns), run.kept[k])
