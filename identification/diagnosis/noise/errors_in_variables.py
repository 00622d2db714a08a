"""What the noise of positions makes a hypothesis explain that is not there (Fuller, Measurement Error Models, 1987).

Columns are of the same recorded positions as the model's torque: of the accelerations of their errors r is missing in
what the model leaves, and d is too much in a column. The product of both holds -d r, whatever is true.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant, base_rows
from identification.diagnosis.columns.normal_equations import directions
from identification.diagnosis.columns.torques import made
from identification.diagnosis.noise import rounding
from identification.diagnosis.noise.clear_directions import clear
from identification.diagnosis.runs import stated_elasticity
from identification.diagnosis.runs.perturbation import moved
from identification.diagnosis.runs.position_noise import drawn, torque_of
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene


class Redrawn:
    """A run with ``noise`` (n) [rad, m] of its positions once more, by draw ``number``: what that changes in its rows.

    ``torque`` (n x rows) [N m, N] is what the model's torque changes by, with that of the file's drive
    trains without a gap.
    """

    def __init__(self, run: Prepared, scene: Scene, noise: Array, number: int) -> None:
        error = drawn(scene, noise, number)
        self._run = run
        self._scene = replace(scene, sampled=replace(scene.sampled, motion=moved(scene.motion, error, 1.0)))
        self._known: dict[tuple[int, ...], list[Array] | None] = {}
        self.torque = run.decimated(torque_of(error, scene))
        if weights := stated_elasticity.weights(scene):
            names = (*scene.regressors.names, *stated_elasticity.names(scene.robot))
            old = base_rows(run.decimated, scene)
            for k, by in product(range(len(old)), weights):
                new, was = (some[k].get(names.index(by), np.zeros_like(run.t)) for some in (self._base, old))
                self.torque[k] += weights[by] * (new - was)

    def base(self, bank: Bank, r: int, k: int) -> tuple[list[int], Array]:
        """Numbers (m) of the base columns that act on joint k in the bank's run r, and what their rows change by
        (m x rows), without those of which a small error makes no small change.
        """
        out = stated_elasticity.bouncing(self._scene.robot)
        every = [number for number in bank.raw(r, k)[0] if number < len(bank.base)]
        numbers = [number for number in every if bank.base[number] not in out]
        old = bank.columns(r, k, numbers)
        new = [self._base[k].get(number, row) for number, row in zip(numbers, old, strict=True)]
        return numbers, np.reshape(new, old.shape) - old

    def of(self, variant: Variant, bank: Bank, r: int, k: int) -> Array:
        """What the rows of a variant's m columns on joint k in the bank's run r change by (m x rows); nothing where its
        shape becomes impossible.
        """
        old = bank.columns(r, k, variant.columns)
        rows = self._rows(variant)
        return np.zeros_like(old) if rows is None else rows[variant.coordinates.index(k)] - old

    def _rows(self, variant: Variant) -> list[Array] | None:
        if variant.columns not in self._known:
            columns = made(variant.hypothesis, self._scene, variant.shape)
            used = list(variant.used)
            rows = None if columns is None else [self._run.decimated(columns[used, j]) for j in variant.coordinates]
            self._known[variant.columns] = rows
        return self._known[variant.columns]

    @cached_property
    def _base(self) -> list[dict[int, Array]]:
        return base_rows(self._run.decimated, self._scene)


def redrawn(runs: Sequence[Prepared], scenes: Sequence[Scene]) -> dict[int, Redrawn]:
    """By number, the runs whose positions are not exact, each with as much noise once more."""
    result = {}
    for r, (run, scene) in enumerate(zip(runs, scenes, strict=True)):
        noise = rounding.errors(scene.sampled.run, scene.robot)
        if noise.any():
            result[r] = Redrawn(run, scene, noise, r)
    return result


class Pretence:
    """Of the products of white columns with the torque what the noise of the positions makes, along the runs that are
    ``redrawn``; ``products`` are those of the base columns with each other (p x p).
    """

    def __init__(self, bank: Bank, redrawn: Mapping[int, Redrawn], products: Array) -> None:
        self._bank, self._redrawn, self._base = bank, redrawn, products
        self._known: dict[tuple[int, ...], Array] = {}

    @property
    def nothing(self) -> bool:
        """Whether the positions of all runs are exact."""
        return not self._redrawn

    @cached_property
    def base(self) -> Array:
        """Of the base columns (p), as far as it does not drown them."""
        result, noise = np.zeros(len(self._bank.base)), []
        for r, k in product(self._redrawn, range(self._bank.dof)):
            numbers, change = self._redrawn[r].base(self._bank, r, k)
            white = self._white(r, k, change)
            result[numbers] += self._products(r, k, white)
            noise.append((np.array(numbers, dtype=int), np.sqrt(self._believed[k]) * white))
        along = clear(directions(self._base), noise)
        return np.asarray(self._base @ along @ (along.T @ result))

    def of(self, variant: Variant) -> Array:
        """Of a variant's columns (k)."""
        if variant.columns not in self._known:
            parts = [
                self._products(r, k, self._white(r, k, one.of(variant, self._bank, r, k)))
                for r, one in self._redrawn.items()
                for k in variant.coordinates
            ]
            self._known[variant.columns] = np.sum([np.zeros(len(variant.columns)), *parts], axis=0)
        return self._known[variant.columns]

    def beside(self, variants: Sequence[Variant]) -> Array:
        """Of the base columns and of those of ``variants`` (p + k)."""
        return np.concatenate([self.base, *map(self.of, variants)])

    def _products(self, r: int, k: int, white: Array) -> Array:
        return np.asarray(-self._believed[k] * (white @ self._torques[r][k]))

    @cached_property
    def _torques(self) -> dict[int, list[Array]]:
        """By run, the white change of each joint's torque."""
        return {
            r: [self._white(r, k, row[None])[0] for k, row in enumerate(one.torque)] for r, one in self._redrawn.items()
        }

    @cached_property
    def _believed(self) -> list[float]:
        """The part of the positions' noise that is there, by joint: its torque has no more of it than it has noise."""
        by_joint = zip(*self._torques.values(), strict=True)
        return [1 / max(1.0, float(np.sum(rows**2)) / max(len(rows), 1)) for rows in map(np.concatenate, by_joint)]

    def _white(self, r: int, k: int, rows: Array) -> Array:
        return self._bank.colours[r][k].white(rows, self._bank.runs[r].kept[k])
