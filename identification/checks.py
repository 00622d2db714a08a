"""Signals that cannot be what they are called: each one line with its row, or a repair that is told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from generator.errors import InputError
from generator.robot.description import Joint, Robot
from identification.neighbours import ARITHMETIC, in_a_row
from identification.recording import Array, Where
from identification.signals import Measured

#: Beyond the limits, in parts of the range, that a position may be.
_BEYOND = 0.05
#: Positions [rad] and speeds [rad/s, m/s] that no joint without limits reaches.
_TURNS, _FAST, _JUMP = 4 * np.pi, 40.0, 100.0
#: Size of a number in whatever unit that is none of a sensor.
_HUGE = 1e30
#: Steps of an encoder at once within a sample from which a motion is abrupt.
_ABRUPT = 2.5
#: Time [s] over which a speed is looked at.
_WINDOW = 0.05
#: Samples in a row at the extreme value that are saturation, and the part of a run that may be.
_STUCK, _MOST = 10, 0.2
#: Rows on each side of a jump, and by how much more than they a position moves in it, and than it usually does.
_ABOUT, _ALONE, _FASTER = 4, 5.0, 2.0
#: How much longer than one step from its extreme a signal that is cut off stays there.
_LONGER = 3
#: Distance to the wrong reference over that to the right one, from which columns count as swapped.
_SWAPPED = 3.0


@dataclass(frozen=True)
class Stretch:
    """Samples ``start`` to ``end`` (not included) of joint ``coordinate``."""

    coordinate: int
    start: int
    end: int


def finite(columns: Sequence[tuple[str, Array]], where: Where) -> None:
    """Raises InputError at the first row that holds what is no finite number, or one that no sensor tells."""
    worst: tuple[int, str] | None = None
    for name, values in columns:
        bad = np.flatnonzero(~(np.abs(values) < _HUGE))
        if bad.size and (worst is None or bad[0] < worst[0]):
            worst = int(bad[0]), name
    if worst is not None:
        row, name = worst
        value = dict(columns)[name][row]
        expected = "a finite number" if not np.isfinite(value) else f"a number within +-{_HUGE:g}"
        raise InputError(where(row, name), f"{name} is {value:g}", expected)


def whole(found: Measured, where: Where) -> None:
    """Raises InputError where positions jump in one row, with slow rows before and after: rows between are missing."""
    for name, x in zip(found.names, found.values, strict=True):
        steps = np.abs(np.diff(x))
        if len(steps) < 2 * _ABOUT + 1:
            continue
        near = np.max([np.roll(steps, k) for k in range(-_ABOUT, _ABOUT + 1) if k], axis=0)
        resolution = np.min(steps, where=steps > ARITHMETIC * np.ptp(x), initial=np.inf)
        usual = max(float(np.quantile(steps, 0.99)), float(resolution))
        jumps = np.flatnonzero(steps > np.maximum(_ALONE * near, _FASTER * usual))
        jumps = jumps[(jumps >= _ABOUT) & (jumps < len(steps) - _ABOUT)]
        if jumps.size:
            row = int(jumps[0]) + 1
            problem = f"{name} jumps by {x[row] - x[row - 1]:.4g} in this row alone"
            raise InputError(where(row, name), problem, "rows without gaps; FILE@FROM:TO takes a part")


def positions(q: Array, found: Measured, robot: Robot, period: float, where: Where, resting: bool = False) -> None:
    """Joint positions (n x N): inside the limits, without jumps, not in degrees, not held at an end while moving.

    A robot that is ``resting`` may stop anywhere.

    Raises InputError with the row.
    """
    for k, joint in enumerate(robot.moving):
        name = found.names[k]
        _inside(q[k], joint, name, where)
        steps = np.abs(np.diff(q[k]))
        row = int(np.argmax(steps))
        if steps[row] > _JUMP * period and steps[row] > 20 * np.quantile(steps, 0.99):
            problem = f"{name} jumps from {q[k, row]:.6g} to {q[k, row + 1]:.6g}"
            raise InputError(where(row + 1, name), problem, "positions without jumps")
        _speed(q[k], name, period, where)
        if not resting:
            _held(q[k], steps, name, where)


def _inside(x: Array, joint: Joint, name: str, where: Where) -> None:
    unit = joint.position_unit
    if joint.lower is not None and joint.upper is not None:
        lower, upper = float(joint.lower), float(joint.upper)
        allowed = _BEYOND * (upper - lower)
        bad = np.flatnonzero((x < lower - allowed) | (x > upper + allowed))
        if bad.size:
            row = int(bad[0])
            turned = np.radians(x)
            inside = np.abs(x).max() > 2 * np.pi and turned.min() >= lower - allowed and turned.max() <= upper + allowed
            problem = f"{name} gives joint {joint.number} {x[row]:.6g} {unit}, outside of {lower:.4g} to {upper:.4g}"
            hint = "; are these degrees?" if inside and unit == "rad" else "; is this a run of another robot?"
            raise InputError(where(row, name), problem, f"{unit} within the robot's limits{hint}")
    elif unit == "rad" and np.abs(x).max() > _TURNS:
        row = int(np.argmax(np.abs(x) > _TURNS))
        problem = f"{name} gives joint {joint.number} {x[row]:.6g} rad, more than two turns"
        raise InputError(where(row, name), problem, "rad, or limits in the robot file; are these degrees?")


def _speed(x: Array, name: str, period: float, where: Where) -> None:
    width = min(max(1, round(_WINDOW / period)), len(x) - 1)
    speed = np.abs(x[width:] - x[:-width]) / (width * period)
    if speed.max() > _FAST:
        row = int(np.argmax(speed > _FAST))
        problem = f"{name} moves at {speed[row]:.4g} a second"
        raise InputError(where(row, name), problem, f"at most {_FAST:g} rad/s; are these degrees?")


def _held(x: Array, steps: Array, name: str, where: Where) -> None:
    """A position that stops dead at its highest or lowest value and leaves it as abruptly is cut off; an encoder's
    single step is not abrupt.
    """
    moving = np.quantile(steps, 0.9)
    resolution = np.min(steps, where=steps > 1e-3 * moving, initial=np.inf)
    for stretch in _flat(x):
        if stretch.start == 0 or stretch.end == len(x):
            continue
        before, after = steps[stretch.start - 1], steps[stretch.end - 1]
        inner = steps[stretch.start - 2] if stretch.start > 1 else 0.0
        if min(before + inner, after) > max(0.3 * moving, _ABRUPT * resolution) > 0:
            problem = f"{name} stays at {x[stretch.start]:.6g} from here for {stretch.end - stretch.start} rows"
            raise InputError(where(stretch.start, name), problem, "a position that is not cut off")


def _flat(x: Array) -> list[Stretch]:
    """Stretches of at least ``_STUCK`` equal samples at the largest or smallest value."""
    found = [one for extreme in (x.max(), x.min()) for one in in_a_row(x == extreme)]
    return [Stretch(0, one.start, one.stop) for one in found if one.stop - one.start >= _STUCK]


def _cut_off(x: Array, moves: NDArray[np.bool_]) -> list[Stretch]:
    """Where an effort is cut off: it stays at an extreme while joints move, and hardly one step from it.

    At a smooth extreme a signal in coarse steps stays at most 1 + sqrt(2) times as long at the last one as at the one
    before.
    """
    values = np.unique(x)
    ends = {values[0]: values[1], values[-1]: values[-2]}
    piled = {extreme for extreme, before in ends.items() if _piled(x, moves, extreme, before)}
    return [one for one in _flat(x) if x[one.start] in piled and moves[one.start : one.end].mean() > 0.5]


def _piled(x: Array, moves: NDArray[np.bool_], extreme: float, before: float) -> bool:
    """Whether an effort that gets to its extreme is far longer there than at the value before it."""
    there, near = (x == extreme) & moves, ((x == extreme) | (x == before)) & moves
    excursions = [there[one] for one in in_a_row(near)]
    last = sum(int(one.sum()) for one in excursions)
    both = sum(len(one) for one in excursions if one.any())
    return last > _LONGER * (both - last)


def torques(found: Measured, q: Array, where: Where, resting: bool = False) -> list[Stretch]:
    """Where an effort stays at its largest or smallest value while the joints move: it is cut off there.

    Raises InputError for an effort that is the same in all rows, and, unless the robot is ``resting``, for one that is
    cut off in more than a fifth.
    """
    result = []
    moves = np.concatenate([[False], np.any(np.diff(q, axis=-1) != 0, axis=0)])
    for k, name in enumerate(found.names):
        x = found.values[k]
        if np.ptp(x) == 0:
            raise InputError(where(0, name), f"{name} is {x[0]:.6g} in all rows", "a measured signal")
        stretches = _cut_off(x, moves)
        if not resting and sum(one.end - one.start for one in stretches) > _MOST * len(x):
            first = stretches[0]
            problem = f"{name} stays at {x[first.start]:.6g} from here, as in more than a fifth of all rows"
            raise InputError(where(first.start, name), problem, "a signal that is not cut off")
        result += [Stretch(k, one.start, one.end) for one in stretches]
    return result


def order(q: Array, found: Measured, other: Measured, where: Where) -> None:
    """Positions against another measurement or the reference of the same joints (n x N).

    Raises InputError where they are swapped.
    """
    distance = np.array([[np.std(a - b) for b in other.values] for a in q])
    _, best = linear_sum_assignment(distance)
    for k, match in enumerate(best):
        if match != k and distance[k, k] > _SWAPPED * max(distance[k, match], 1e-12):
            problem = f"{found.names[k]} follows {other.names[match]}, not {other.names[k]}"
            raise InputError(where(None, found.names[k]), problem, "columns in the joints' order; are two swapped?")


def left_out(stretches: Sequence[Stretch], shape: tuple[int, int]) -> NDArray[np.bool_] | None:
    """Samples (n x N) that the stretches cover; None without any."""
    if not stretches:
        return None
    result = np.zeros(shape, dtype=bool)
    for one in stretches:
        result[one.coordinate, one.start : one.end] = True
    return result
