"""Which elastic drive train makes a link swing as the log has it: many are played at once.

A lightly damped swing answers to one stiffness alone, and what crosses a gap to one gap: a coarse grid of shapes would
miss both. What is compared is the largest part of a swing's torque, the inertia of the joint's own link, with what the
model leaves of the joint's torque.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.link_side import LinkSide, Train, link_side, swings_in_gaps
from identification.diagnosis.runs.prepared import windowed
from identification.diagnosis.runs.rotor import rotor_inertia
from identification.diagnosis.runs.scene import Scene

#: Drive trains as rotor's inertia, stiffness, damping ratio, gap.
Alike: TypeAlias = list[tuple[float, ...]]

#: Time [s] that is played, of the run in which the joint is fastest, and the most samples.
_PLAYED, _SAMPLES = 12.0, 12000
#: Frequencies [Hz] of a link on its drive train, the motor held, and their largest part of the samples' rate, which the
#: integration can follow.
_LOWEST, _HIGHEST, _PART = 3.0, 100.0, 0.125
#: Damping ratios, and those that are looked at first: how long a swing rings hides its stiffness less than these do.
DAMPING, USUAL_DAMPING = (0.002, 0.7), (0.01, 0.4)
#: Values about the best of a grid among which it is refined.
_FINER = 7
#: Rows over which the windows reach through which swings are compared.
_WIDTHS = (1, 4)
#: Least rows for each column of the base parameters, and least singular value of scaled columns.
_ROWS, _RANK = 3, 1e-6


def watched(scenes: Sequence[Scene], k: int) -> bool:
    """Whether a link has an encoder of its own, which tells an elastic drive train without any torque."""
    return any(f"qs{scenes[0].robot.moving[k].number}" in scene.sampled.run.others for scene in scenes)


def liveliest(scenes: Sequence[Scene], k: int) -> LinkSide | None:
    """The joint's link side in the run in which it is fastest; None where the model's link has no inertia, or samples
    that follow no swing.
    """
    scene = max(scenes, key=lambda one: float(np.mean(one.motion.qd[k] ** 2)))
    side = link_side(scene, k, rotor_inertia(scene, k))
    quick = _PART / scene.period > _LOWEST
    return side if quick and np.min(side.inertia) > 0 and np.any(side.load) else None


def stiffnesses(side: LinkSide) -> tuple[float, float]:
    """The softest and the stiffest drive train that is looked for [N m/rad, N/m]."""
    highest = min(_HIGHEST, _PART / side.scene.period)
    inertia = float(np.mean(side.inertia))
    low, high = (inertia * (2 * np.pi * f) ** 2 for f in (_LOWEST, highest))
    return float(low), float(high)


def alike(sides: Sequence[LinkSide], grids: Sequence[Array]) -> Alike:
    """The rotor of one of the link's ``sides``, stiffness, damping and gap, each from its grid in geometric steps, that
    are most like the log, then between the steps: once by all that the rows show and once by what is slow in it.

    Where a link bounces at the ends of a gap the phase of a swing hangs on the smallest error; the mean pull does not.
    """
    coarse = _Played(sides, [_combinations(grids)] * len(sides))
    looks = [(s, rows) for rows in (Rows(sides[0], width) for width in _WIDTHS) for s in range(len(sides))]
    near = [
        _combinations([_about(x, grid) for x, grid in zip(coarse.most_alike(s, rows)[1], grids, strict=True)])
        for s, rows in looks
    ]
    fine = _Played([sides[s] for s, _ in looks], near)
    found = [(sides[s].rotor, *fine.most_alike(i, rows)) for i, (s, rows) in enumerate(looks)]
    by_width = [found[i : i + len(sides)] for i in range(0, len(found), len(sides))]
    best = [max(each, key=lambda one: one[1]) for each in by_width]
    return list(dict.fromkeys((rotor, *combination) for rotor, _, combination in best))


def _combinations(grids: Sequence[Array]) -> Array:
    """All combinations of the values of grids (len(grids) x K)."""
    return np.stack([x.reshape(-1) for x in np.meshgrid(*grids, indexing="ij")])


def _about(x: float, grid: Array) -> Array:
    """Values from one step of a grid below x to one above it."""
    if len(grid) == 1:
        return grid
    step = grid[1] / grid[0]
    return np.geomspace(max(x / step, grid[0]), min(x * step, grid[-1]), _FINER)


def _samples(scene: Scene) -> int:
    return min(scene.motion.samples, round(_PLAYED / scene.period), _SAMPLES)


class Rows:
    """What the rows of a joint show through windows ``width`` rows wide, without those in which it stands and without
    what other base parameters would explain.
    """

    def __init__(self, side: LinkSide, width: int) -> None:
        scene, k = side.scene, side.k
        self._width, self.samples = width * scene.sampled.filters.factor, _samples(scene)
        count = self.samples
        self._kept = windowed(scene.sampled.left_out[k, :count].astype(float), self._width) == 0
        base = windowed(scene.regressors.base(scene.motion.part(0, count))[k], self._width)[:, self._kept]
        # Few rows are explained by anything.
        self._base = _directions(base if base.shape[1] > _ROWS * len(base) else base[:0])
        self.left = self.seen((scene.tau - scene.model_torque)[k, :count])

    def seen(self, torque: Array) -> Array:
        """Rows (... x M) that count, of torques (... x ``samples``), without what base parameters explain."""
        rows = windowed(torque, self._width)[..., self._kept]
        return np.asarray(rows - (rows @ self._base.T) @ self._base)

    def cosines(self, torques: Array) -> Array:
        """Of torques (K x N) with the residual (K); not a number where a torque is none, or has no end."""
        seen = self.seen(torques)
        size = np.linalg.norm(seen, axis=1)
        return np.asarray(np.where(np.isfinite(size), seen @ self.left / size, np.nan))


def _directions(rows: Array) -> Array:
    """Orthonormal rows that make the same space."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    _, values, directions = np.linalg.svd(rows / np.where(size > 0, size, 1.0), full_matrices=False)
    return np.asarray(directions[values > _RANK])


class _Played:
    """The swings of links, one along each of ``sides`` of one scene, on as many ``trains`` each, of which the rows are
    stiffnesses, damping ratios and gaps (3 x K).
    """

    def __init__(self, sides: Sequence[LinkSide], trains: Sequence[Array]) -> None:
        self._trains, count = trains, _samples(sides[0].scene)
        self._torques = np.empty((len(sides), trains[0].shape[1], count))
        # A drive train too stiff for the samples runs away; it is like nothing.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            if np.any(trains[0][2]):
                first = 0
                for torques in swings_in_gaps(sides, [Train(*one) for one in trains], count):
                    self._torques[:, :, first : first + len(torques)] = torques.transpose(1, 2, 0)
                    first += len(torques)
            else:
                for torques, side, each in zip(self._torques, sides, trains, strict=True):
                    for torque, one in zip(torques, each.T.tolist(), strict=True):
                        torque[:] = side.swing(Train(*one), count)

    def most_alike(self, s: int, rows: Rows) -> tuple[float, tuple[float, ...]]:
        """The largest cosine of a swing along side s with the residual, and the combination that swings so."""
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            cosines = rows.cosines(self._torques[s])
        known = np.where(np.isfinite(cosines), cosines, -np.inf)
        most = int(np.argmax(known))
        return float(known[most]), tuple(self._trains[s][:, most].tolist())
