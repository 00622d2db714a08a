"""Where a residual is: its means over position, speed, load, time, motor phase, with the band that noise would fill."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import SINCE_REVERSAL
from identification.diagnosis.columns.whitening import Colour
from identification.diagnosis.runs.prepared import Prepared, joined
from identification.diagnosis.runs.reversals import since_reversal
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import coupling
from identification.residuals import rms

#: Bins over the range of a variable.
BINS = 24
#: Rows of a bin from which its mean is shown, and of all bins in the mean.
FEW_ROWS = 4
#: Change of a variable, in parts of its largest value, that is rounding.
_CONSTANT = 1e-12
#: Part of what the best variable explains from which a simpler one is named instead.
_NEARLY = 0.85
#: Part of the joint's rms torque by which its load changes at least, to order anything.
_FLAT = 1e-3


@dataclass(frozen=True)
class View:
    """Means of joint ``joint``'s residual [N m, N] over ``variable`` (unit ``unit``): B bins.

    ``centre``, ``mean``, half ``band`` of two standard deviations of a mean of noise, ``count`` of rows (B each).
    ``direction`` is -1 or 1 where only rows of that direction of motion count, 0 for all. ``share`` is the part of the
    residual's variance that the means explain beyond chance, over both directions of one variable together.
    """

    joint: int
    variable: str
    unit: str
    direction: int
    centre: Array
    mean: Array
    band: Array
    count: NDArray[np.int64]
    share: float


@dataclass(frozen=True)
class _Rows:
    """Residual ``e`` [N m, N] and speed ``qd`` of joint ``number`` in rows that count (N each), and the ``power`` of a
    mean of noise times the rows in it.
    """

    number: int
    e: Array
    qd: Array
    power: float


def variables(run: Prepared, scene: Scene, k: int) -> dict[str, tuple[str, Array]]:
    """What the residual of coordinate k is looked at against, by name: unit and values (N rows)."""
    motion, robot = scene.motion, scene.robot
    joint = robot.moving[k]
    unit = joint.position_unit
    signals = np.stack([motion.q[k], motion.qd[k], motion.qdd[k], scene.load[k], scene.t, since_reversal(scene, k)])
    q, qd, qdd, load, t, since = run.decimated(signals)
    result = {
        "q": (unit, q),
        "q by direction": (unit, q),
        "qd": (f"{unit}/s", qd),
        "qdd": (f"{unit}/s2", qdd),
        "load": (joint.torque_unit, load),
        "time": ("s", t),
        SINCE_REVERSAL: ("s", since),
    }
    if robot.drives is not None:
        result["motor phase"] = ("rad", np.mod(coupling(robot)[k] @ run.decimated(motion.q), 2 * np.pi))
    return result


def views(
    runs: Sequence[Prepared], scenes: Sequence[Scene], residuals: Sequence[Array], k: int, noise: Sequence[Colour]
) -> tuple[View, ...]:
    """All views of coordinate k's residuals, one (N rows) and a colour of noise a run; the strongest variable first."""
    if not _enough(runs, k):
        return ()
    kept = [run.kept[k] for run in runs]
    seen = _seen(runs, scenes, residuals, k, noise)
    every = [variables(run, scene, k) for run, scene in zip(runs, scenes, strict=True)]
    usual = rms(joined(runs, [run.tau for run in runs], k))
    found: list[View] = []
    for name, (unit, _) in every[0].items():
        x = np.concatenate([mine[name][1][rows] for mine, rows in zip(every, kept, strict=True)])
        least = _FLAT * usual if name == "load" else _CONSTANT * float(np.abs(x).max())
        if np.ptp(x) <= least:
            continue
        sides = (-1, 1) if name in ("q by direction", "load") else (0,)
        found += _view(seen, name, unit, x, sides)
    return tuple(sorted(found, key=lambda one: (-one.share, one.variable, one.direction)))


def shares_of_others(
    runs: Sequence[Prepared], scenes: Sequence[Scene], residuals: Sequence[Array], k: int, noise: Sequence[Colour]
) -> dict[str, float]:
    """The part of the variance of coordinate k's residuals, given as to ``views``, that the place and the speed of each
    other joint that moves order, by what they are in words.
    """
    if not _enough(runs, k):
        return {}
    seen, result = _seen(runs, scenes, residuals, k, noise), {}
    motions = [run.decimated(np.stack([s.motion.q, s.motion.qd])) for run, s in zip(runs, scenes, strict=True)]
    both = np.concatenate([each[..., run.kept[k]] for each, run in zip(motions, runs, strict=True)], axis=-1)
    for i, joint in enumerate(scenes[0].robot.moving):
        if i != k and any(scene.moves(i) for scene in scenes):
            for what, x in zip(("place", "speed"), both[:, i], strict=True):
                result[f"the {what} of joint {joint.number}"] = _view(seen, what, "", x, (0,))[0].share
    return result


def _enough(runs: Sequence[Prepared], k: int) -> bool:
    return sum(int(run.kept[k].sum()) for run in runs) >= FEW_ROWS * BINS


def _seen(
    runs: Sequence[Prepared], scenes: Sequence[Scene], residuals: Sequence[Array], k: int, noise: Sequence[Colour]
) -> _Rows:
    kept = [run.kept[k] for run in runs]
    return _Rows(
        scenes[0].robot.moving[k].number,
        np.concatenate([each[rows] for each, rows in zip(residuals, kept, strict=True)]),
        joined(runs, [run.decimated(scene.motion.qd) for run, scene in zip(runs, scenes, strict=True)], k),
        _of_means(noise, [int(rows.sum()) for rows in kept]),
    )


def _view(seen: _Rows, name: str, unit: str, x: Array, sides: Sequence[int]) -> list[View]:
    """Means over ``x`` (N), which is ``name``, for each direction of ``sides``, or for both together (0)."""
    e = seen.e
    edges = np.linspace(x.min(), x.max(), BINS + 1)
    at = np.clip(np.digitize(x, edges) - 1, 0, BINS - 1)
    parts, explained, bins = [], 0.0, 0
    variance = float(e.var())
    for side in sides:
        rows = np.ones(len(e), dtype=bool) if side == 0 else side * seen.qd > 0
        count = np.bincount(at[rows], minlength=BINS)
        total = np.bincount(at[rows], weights=e[rows] - e.mean(), minlength=BINS)
        used = count >= FEW_ROWS
        mean = np.where(used, total / np.maximum(count, 1), 0.0)
        band = np.where(used, 2 * np.sqrt(seen.power / np.maximum(count, 1)), np.inf)
        explained += float(count[used] @ mean[used] ** 2)
        bins += int(used.sum())
        parts.append((side, used, mean + e.mean(), band, count))
    # What bins of coloured noise would explain by chance.
    chance = seen.power * max(bins - 1, 0)
    share = max(explained - chance, 0.0) / max(variance * len(e), 1e-300)
    centre = (edges[1:] + edges[:-1]) / 2
    return [
        View(seen.number, name, unit, side, centre[used], mean[used], band[used], count[used], share)
        for side, used, mean, band, count in parts
    ]


def _of_means(noise: Sequence[Colour], rows: Sequence[int]) -> float:
    """Variance of a mean of noise times the rows in it: its power density at rest, that of white noise at least."""
    each = [max(one.deviations[-1] / abs(float(one.filters[-1].sum())), one.deviations[0]) ** 2 for one in noise]
    return float(np.average(each, weights=rows))


def strongest(found: Sequence[View]) -> tuple[str, Mapping[str, float]]:
    """The variable that explains most, a simpler one where it does nearly as well, and all shares by variable."""
    shares: dict[str, float] = {}
    for one in found:
        shares[one.variable] = one.share
    if not shares:
        return "", shares
    order = ("q", "qd", "load", "time", "motor phase", "q by direction", SINCE_REVERSAL, "qdd")
    best = max(shares.values())
    near = [name for name in order if shares.get(name, 0.0) >= _NEARLY * best and best > 0]
    return (near[0] if near else ""), shares
