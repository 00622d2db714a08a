"""Every column that may explain the runs: the base parameters', the hypotheses', the torque; and their products.

Numbers of columns are global: the p base parameters first, then the hypotheses' as they are tried; the torque is apart,
without that of the payload which a run is known to carry.
All that selection asks for is in the Gram matrices of white rows, one a run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.columns import stated_load
from identification.diagnosis.columns.growing import Products, Rows
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis, Key
from identification.diagnosis.columns.normal_equations import bounded, lowered
from identification.diagnosis.columns.torques import Torques, torques
from identification.diagnosis.columns.whitening import Colour
from identification.diagnosis.runs import stated_elasticity
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.side_by_side import side_by_side

#: What tells columns apart: effect, joint, shape.
_Made: TypeAlias = tuple[object, ...]
#: Columns that are made once.
Lasting: TypeAlias = dict[_Made, Torques]


@dataclass(frozen=True)
class Variant:
    """A hypothesis with one shape, the numbers of its columns, and the coordinates on which it acts.

    ``used`` are the coefficients that the columns belong to: all, or those that bounds leave.
    """

    hypothesis: Hypothesis
    shape: Mapping[str, float]
    columns: tuple[int, ...]
    coordinates: tuple[int, ...]
    used: tuple[int, ...] = ()

    @property
    def key(self) -> Key:
        """That of its hypothesis."""
        return self.hypothesis.key

    @property
    def tries(self) -> int:
        """Shapes of its hypothesis that are tried."""
        return max(self.hypothesis.tries, len(self.hypothesis.variants))

    @cached_property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """Those of the columns."""
        return tuple(self.hypothesis.coefficients[i] for i in self.used)

    @cached_property
    def bounds(self) -> tuple[Array, Array]:
        """Least and largest values of the coefficients (k each), infinite where free."""
        lower = np.array([-np.inf if c.lower is None else c.lower for c in self.coefficients])
        upper = np.array([np.inf if c.upper is None else c.upper for c in self.coefficients])
        return lower, upper

    @cached_property
    def preset(self) -> Array | None:
        """Its coefficients (k) where another fit than that of the columns tells them all; None where not."""
        known = [value for one in self.coefficients if (value := self.hypothesis.preset_value(one.name)) is not None]
        return np.array(known) if known and len(known) == len(self.columns) else None

    def best(self, A: Array, b: Array, least: Array) -> tuple[Array, float]:
        """Its coefficients by products A of its columns and b with the torque, ``bounded`` or preset, and by how much
        they lower the sum of squares; columns count of whose squares the ``least`` (k) is left.
        """
        if self.preset is None:
            return bounded(A, b, *self.bounds, least)
        return self.preset, max(lowered(A, b, self.preset), 0.0)

    def believed(self, x: Array) -> bool:
        """Whether none of its coefficients x (k) is larger than is believed of a free fit."""
        return all(abs(value) <= one.believed for value, one in zip(x, self.coefficients, strict=True))

    def only(self, used: Sequence[int]) -> Variant:
        """With some of its columns, by their places among them."""
        return Variant(
            self.hypothesis,
            self.shape,
            tuple(self.columns[i] for i in used),
            self.coordinates,
            tuple(self.used[i] for i in used),
        )


@dataclass
class _Joint:
    """Raw rows of one joint of one run: column numbers, rows (k x N), torque (N), kept rows, white rows once known."""

    numbers: list[int]
    rows: list[Array]
    tau: Array
    kept: NDArray[np.bool_]
    white: Rows = field(default_factory=lambda: Rows(np.empty((0, 0))))


def columns_of(chosen: Sequence[Variant]) -> list[int]:
    """Numbers of the variants' columns in their bank, one variant after the other."""
    return [number for one in chosen for number in one.columns]


class Bank:
    """Columns of several runs; ``scenes`` and ``runs`` in the same order.

    ``nowhere`` are hypotheses by effect and joint that make no torque along the runs, and ``preset`` coefficients that
    another fit than that of the columns tells, by the column's number.
    """

    def __init__(self, runs: Sequence[Prepared], scenes: Sequence[Scene], lasting: Lasting | None = None) -> None:
        """``lasting`` are columns of the motion alone, which banks of the same runs share."""
        self.runs, self.scenes = tuple(runs), tuple(scenes)
        regressors = scenes[0].regressors
        self.base: tuple[str, ...] = (*regressors.names, *stated_elasticity.names(self.robot))
        self.variants: list[Variant] = []
        self._made: dict[_Made, Variant | None] = {}
        self._offered: set[_Made] = set()
        self._lasting: Lasting = {} if lasting is None else lasting
        self.nowhere: dict[tuple[str, int], Hypothesis] = {}
        self.preset: dict[int, float] = {}
        self.count = len(self.base)
        self._joints: list[list[_Joint]] = []
        self._colours: list[list[Colour]] = []
        self._grams: list[Products] = []
        for run, scene in zip(runs, scenes, strict=True):
            tau = run.tau - run.decimated(scene.carried(run.sampled.motion))
            self._joints.append(
                [
                    _Joint([*rows], [*rows.values()], tau[k], run.kept[k])
                    for k, rows in enumerate(base_rows(run.decimated, scene))
                ]
            )

    @property
    def robot(self) -> Robot:
        """The robot that the runs are of."""
        return self.scenes[0].robot

    @property
    def dof(self) -> int:
        """n."""
        return len(self._joints[0])

    @property
    def grams(self) -> tuple[Array, ...]:
        """Of each run, the products of all columns and the torque, the last one (count + 1 square); none before
        ``whiten``.
        """
        return tuple(one.array for one in self._grams)

    @property
    def colours(self) -> tuple[tuple[Colour, ...], ...]:
        """Of the noise of each run's joints; empty before ``whiten``."""
        return tuple(tuple(one) for one in self._colours)

    def values(self, solution: Array) -> dict[str, float]:
        """Base parameters by name of a ``solution`` that begins with them, and what the file's elastic drive trains
        have.
        """
        return stated_elasticity.moved(self.scenes[0].values, dict(zip(self.base, solution.tolist(), strict=False)))

    def rows(self, run: int) -> Array:
        """How many rows each joint of a run has (n)."""
        return np.array([int(one.kept.sum()) for one in self._joints[run]])

    @property
    def shown(self) -> tuple[int, ...]:
        """Coordinates of which some run has rows."""
        rows = np.sum([self.rows(r) for r in range(len(self.runs))], axis=0)
        return tuple(np.flatnonzero(rows).tolist())

    def offer(self, hypotheses: Sequence[Hypothesis]) -> None:
        """Columns of ``hypotheses`` with every shape that is tried first, made side by side."""

        def every(one: Hypothesis) -> list[Torques | None]:
            return [self._torques(one, shape) for shape in one.variants]

        for one, found in zip(hypotheses, side_by_side(every, hypotheses), strict=True):
            for shape, each in zip(one.variants, found, strict=True):
                if (key := _key(one, shape)) not in self._made:
                    self._made[key] = self._placed(one, shape, each, True)
                self.add(one, shape)

    def add(self, hypothesis: Hypothesis, shape: Mapping[str, float], offered: bool = True) -> Variant | None:
        """Columns of a hypothesis with a shape, which is one of the ``variants`` if ``offered``; None where that is
        impossible along a run or acts nowhere. What there is already is not made again.
        """
        key = _key(hypothesis, shape)
        if key not in self._made:
            self._made[key] = self._placed(hypothesis, shape, self._torques(hypothesis, shape), offered)
        variant = self._made[key]
        if offered and variant is not None and key not in self._offered:
            self._offered.add(key)
            self.variants.append(variant)
        return variant

    def products(
        self, hypothesis: Hypothesis, shape: Mapping[str, float], beside: Sequence[int], runs: Sequence[int]
    ) -> Array | None:
        """Of the k columns of a hypothesis with a shape, which are not kept, over some runs: with columns ``beside``
        them by number, with each other, and with the torque (k x len(beside) + k + 1); None where ``add`` has none.
        """
        found = self._torques(hypothesis, shape)
        if found is None or not found.coordinates:
            return None
        count = len(beside)
        result = np.zeros((len(hypothesis.coefficients), count + len(hypothesis.coefficients) + 1))
        for r in runs:
            for j, rows in zip(found.coordinates, found.rows[r], strict=True):
                numbers, others = self.white(r, j)
                place = {number: i for i, number in enumerate(numbers)}
                at = [i for i, number in enumerate(beside) if number in place]
                white = self.whitened(r, j, rows)
                result[:, at] += white @ others[[place[beside[i]] for i in at]].T
                result[:, count:-1] += white @ white.T
                result[:, -1] += white @ others[-1]
        return result

    def _torques(self, hypothesis: Hypothesis, shape: Mapping[str, float]) -> Torques | None:
        known = self._lasting.get(_key(hypothesis, shape))
        return known or torques(hypothesis, shape, self.runs, self.scenes)

    def _placed(
        self, hypothesis: Hypothesis, shape: Mapping[str, float], found: Torques | None, offered: bool
    ) -> Variant | None:
        """Columns with the rows that were ``found``."""
        if found is None:
            return None
        if hypothesis.of_motion:
            self._lasting[_key(hypothesis, shape)] = found
        if not found.coordinates:
            if offered:
                self.nowhere[hypothesis.effect, hypothesis.joint] = hypothesis
            return None
        numbers = tuple(range(self.count, self.count + len(hypothesis.coefficients)))
        self.count += len(numbers)
        for number, one in zip(numbers, hypothesis.coefficients, strict=True):
            if (value := hypothesis.preset_value(one.name)) is not None:
                self.preset[number] = value
        for r, per_joint in enumerate(found.rows):
            if self._colours:
                self._grams[r].join(len(numbers))
            for j, rows in zip(found.coordinates, per_joint, strict=True):
                self._extend(r, j, numbers, rows)
        return Variant(hypothesis, dict(shape), numbers, found.coordinates, tuple(range(len(numbers))))

    def _extend(self, run: int, joint: int, numbers: tuple[int, ...], rows: Array) -> None:
        one = self._joints[run][joint]
        one.numbers += numbers
        one.rows += list(rows)
        if self._colours:
            white = self._colours[run][joint].white(rows, one.kept)
            one.white.join(white)
            at, new, gram = np.array([*one.numbers, self.count]), np.array(numbers), self._grams[run].array
            products = white @ one.white.array.T
            old = len(at) - 1 - len(new)
            gram[np.ix_(new, at)] += products
            others = np.array([*range(old), len(at) - 1])
            gram[np.ix_(at[others], new)] += products[:, others].T

    def counts(self, joint: int) -> tuple[int, int]:
        """Kept rows of a joint in all runs, and columns of the base that act on it."""
        parts = [joints[joint] for joints in self._joints]
        model = {number for one in parts for number in one.numbers if number < len(self.base)}
        return sum(int(one.kept.sum()) for one in parts), len(model)

    def raw(self, run: int, joint: int) -> tuple[list[int], Array, Array, NDArray[np.bool_]]:
        """Column numbers, columns (k x N), torque (N) and kept rows (N) of a joint, as recorded."""
        one = self._joints[run][joint]
        return one.numbers, np.asarray(one.rows), one.tau, one.kept

    def columns(self, run: int, joint: int, numbers: Sequence[int]) -> Array:
        """Some columns (k x N) of a joint, as recorded."""
        one = self._joints[run][joint]
        rows = [one.rows[one.numbers.index(number)] for number in numbers]
        return np.stack(rows) if rows else np.empty((0, len(one.tau)))

    def white(self, run: int, joint: int) -> tuple[list[int], Array]:
        """Column numbers and white kept rows (k + 1 x N) of a joint, the torque the last."""
        one = self._joints[run][joint]
        return one.numbers, one.white.array

    def power(self, weights: Mapping[int, float], joint: int, runs: Sequence[int]) -> float:
        """Sum of squares of what columns by number, times their ``weights``, make on a joint in some runs, white."""
        result = 0.0
        for r in runs:
            numbers, white = self.white(r, joint)
            at = np.flatnonzero(np.isin(numbers, [*weights]))
            torque = np.array([weights[numbers[i]] for i in at.tolist()]) @ white[at]
            result += float(torque @ torque)
        return result

    def whiten(self, colours: Sequence[Sequence[Colour]]) -> None:
        """Make all rows white, by the colour of each run's joints."""
        self._colours = [list(one) for one in colours]
        for joints, mine in zip(self._joints, colours, strict=True):
            for joint, colour in zip(joints, mine, strict=True):
                joint.white = Rows(colour.white(np.asarray([*joint.rows, joint.tau]), joint.kept))
        self._grams = [Products(self._gram(r)) for r in range(len(self.runs))]

    @property
    def alone(self) -> tuple[int, ...]:
        """Numbers of the runs of which no periods are compared."""
        return tuple(r for r, run in enumerate(self.runs) if not run.period)

    def whitened(self, run: int, joint: int, rows: Array) -> Array:
        """Rows (m x N) of a joint along a run as white kept ones."""
        return self.colours[run][joint].white(rows, self.runs[run].kept[joint])

    def residual(self, run: int, joint: int, values: Mapping[int, float], white: bool = True) -> Array:
        """What ``values`` of columns by number leave of a joint's torque: white kept rows, or all rows as recorded."""
        one = self._joints[run][joint]
        rows = one.white.array if white else np.asarray([*one.rows, one.tau])
        weights = np.array([values.get(number, 0.0) for number in one.numbers])
        return np.asarray(rows[-1] - weights @ rows[:-1])

    def residuals(self, run: int, values: Mapping[int, float]) -> Array:
        """The same of all joints (n x N), as recorded."""
        return np.stack([self.residual(run, joint, values, white=False) for joint in range(self.dof)])

    def left(self, joint: int, values: Mapping[int, float], white: bool = True) -> Array:
        """What they leave of a joint in all runs, one after the other: kept rows, white or as recorded."""
        rows = [self.residual(r, joint, values, white) for r in range(len(self.runs))]
        if not white:
            rows = [each[run.kept[joint]] for run, each in zip(self.runs, rows, strict=True)]
        return np.concatenate(rows)

    def left_over(self, joint: int, values: Mapping[int, float], runs: Sequence[int]) -> tuple[float, int]:
        """Sum of squares of what they leave of a joint's white kept rows in some runs, and how many rows those are."""
        each = [self.residual(r, joint, values) for r in runs]
        return sum(float(e @ e) for e in each), sum(map(len, each))

    def _gram(self, run: int) -> Array:
        """Products of all columns and the torque, the last one (count + 1 square)."""
        gram = np.zeros((self.count + 1, self.count + 1))
        for joint in self._joints[run]:
            at = np.array([*joint.numbers, self.count])
            gram[np.ix_(at, at)] += joint.white.array @ joint.white.array.T
        return gram


def _key(hypothesis: Hypothesis, shape: Mapping[str, float]) -> _Made:
    return hypothesis.effect, hypothesis.joint, *sorted(shape.items())


def base_rows(decimated: Callable[[Array], Array], scene: Scene) -> list[dict[int, Array]]:
    """Of each joint, the rows (N) of the base columns that act on it, ``decimated``, by number: the base parameters,
    then the file's elastic drive trains.
    """
    regressors = scene.regressors
    base, loaded = regressors.base(scene.motion), stated_load.columns(scene)
    place = {name: number for number, name in enumerate(regressors.names)}
    result = []
    for names, columns in zip(regressors.structure, base, strict=True):
        rows = dict(zip(map(place.__getitem__, names), decimated(columns), strict=True))
        rows |= {place[name]: decimated(loaded[name]) for name in loaded.keys() & set(names)}
        result.append(rows)
    if stated_elasticity.names(scene.robot):
        for number, column in enumerate(stated_elasticity.columns(scene), len(place)):
            for rows, row in zip(result, column, strict=True):
                if row.any():
                    rows[number] = decimated(row)
    return result
