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
from identification.diagnosis.bank import Bank, Variant, base_rows, made
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
        self._run = run
        self._scene = replace(scene, sampled=replace(scene.sampled, motion=moved(scene.motion, error, 1.0)))
        self._known: dict[tuple[int, ...], list[Array] | None] = {}
        self.torque = run.decimated(torque_of(error, scene))

    def change(self, bank: Bank, r: int, k: int, variant: Variant | None = None) -> tuple[list[int], Array]:
        """Numbers of the base columns that act on joint k, or of a variant's columns, and what the rows (k x N) of the
        bank change by: nothing where a shape becomes impossible.
        """
        if variant is None:
            new = self._base[k]
            return [*new], np.stack([*new.values()]) - bank.columns(r, k, [*new])
        numbers = [*variant.columns]
        old = bank.columns(r, k, numbers)
        rows = self._rows(variant)
        return numbers, np.zeros_like(old) if rows is None else rows[variant.joints.index(k)] - old

    def _rows(self, variant: Variant) -> list[Array] | None:
        """Rows of a variant's columns on each joint on which it acts; None where its shape is impossible."""
        if variant.columns not in self._known:
            columns = made(variant.hypothesis, self._scene, variant.shape)
            used = list(variant.used)
            rows = None if columns is None else [self._run.decimated(columns[used, j]) for j in variant.joints]
            self._known[variant.columns] = rows
        return self._known[variant.columns]

    @cached_property
    def _base(self) -> list[dict[int, Array]]:
        return base_rows(self._run, self._scene)


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
        for r in self._redrawn:
            for k in range(self._bank.dof):
                numbers, products = self._products(r, k, None)
                result[numbers] += products
        return result

    def of(self, variant: Variant) -> Array:
        """Of a variant's columns (k)."""
        if variant.columns not in self._known:
            parts = [self._products(r, k, variant)[1] for r in self._redrawn for k in variant.joints]
            self._known[variant.columns] = np.sum([np.zeros(len(variant.columns)), *parts], axis=0)
        return self._known[variant.columns]

    def beside(self, variants: Sequence[Variant]) -> Array:
        """Of the base columns and of those of ``variants`` (p + k)."""
        return np.concatenate([self.base, *map(self.of, variants)])

    def _products(self, r: int, k: int, variant: Variant | None) -> tuple[list[int], Array]:
        numbers, change = self._redrawn[r].change(self._bank, r, k, variant)
        return numbers, -self._believed * (self._white(r, k, change) @ self._torques[r][k])

    @cached_property
    def _torques(self) -> dict[int, list[Array]]:
        """By run, the white change of each joint's torque."""
        return {
            r: [self._white(r, k, row[None])[0] for k, row in enumerate(one.torque)] for r, one in self._redrawn.items()
        }

    @cached_property
    def _believed(self) -> float:
        """The part of the noise of positions that is there: no joint's torque has more of it than it has noise."""
        by_joint = zip(*self._torques.values(), strict=True)
        powers = [float(np.mean(np.concatenate(rows) ** 2)) for rows in by_joint if any(map(len, rows))]
        return 1 / max(1.0, *powers) if powers else 1.0

    def _white(self, r: int, k: int, rows: Array) -> Array:
        return self._bank.colours[r][k].white(rows, self._bank.runs[r].kept[k])
