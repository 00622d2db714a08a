"""Signals that cannot be what they are called: each one line with its row."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from generator.errors import InputError
from generator.robot.description import PRISMATIC, Joint, Robot
from identification.arrays import Array
from identification.neighbours import ARITHMETIC, at_extremes
from identification.recording import A_PART, Where
from identification.signals import Measured
from identification.timing import Clock

#: Beyond the limits, in parts of the range, that a position may be.
_BEYOND = 0.05
#: Positions [rad] and speeds [rad/s, m/s] that no joint without limits reaches.
_TURNS, _FAST, _JUMP = 4 * np.pi, 40.0, 100.0
#: Part of a run's samples beyond which those outside are no wrong ones.
_MOST = 0.5
#: Sizes [rad, m] up to which a number may be a joint's position, though it is beyond this one's limits.
_ANGLE, _LENGTH = 2 * np.pi, 10.0
#: Size of a number in whatever unit that is none of a sensor.
_HUGE = 1e30
#: Steps of an encoder at once within a sample from which a motion is abrupt.
_ABRUPT = 2.5
#: Values next to an extreme that tell a step there, and the part of it within which they are whole steps apart.
_NEXT, _WHOLE = 4, 0.02
#: Time [s] over which a speed is looked at.
_WINDOW = 0.05
#: Rows on each side of a jump, and by how much more than they a position moves in it, and than it usually does.
_ABOUT, _ALONE, _FASTER = 4, 5.0, 2.0
#: Distance to the wrong reference over that to the right one, from which columns count as swapped.
_SWAPPED = 3.0


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
            raise InputError(where(row, name), problem, f"rows without gaps; {A_PART}")


def positions(q: Array, found: Measured, robot: Robot, ticks: Clock, where: Where, resting: bool = False) -> None:
    """Joint positions (n x M) at the rows of ``ticks``: inside the limits, without jumps, not in degrees, not held at
    an end while moving.

    A robot that is ``resting`` may stop anywhere.

    Raises InputError with the row.
    """
    for k, joint in enumerate(robot.moving):
        name = found.names[k]
        _inside(q[k], joint, name, ticks, where)
        steps = np.abs(np.diff(q[k]))
        jumps = np.flatnonzero(steps > max(_JUMP * ticks.period, 20 * float(np.quantile(steps, 0.99))))
        if jumps.size:
            # There and back again: what comes first leads to the wrong row.
            row = int(jumps[0])
            problem = f"{name} jumps from {q[k, row]:.6g} to {q[k, row + 1]:.6g}"
            raise InputError(where(row + 1, name), problem, "positions without jumps")
        _speed(q[k], joint, name, ticks.period, where)
        if not resting:
            _held(q[k], steps, name, where)


def _inside(x: Array, joint: Joint, name: str, ticks: Clock, where: Where) -> None:
    unit = joint.position_unit
    if joint.limits is not None:
        (lower, upper), largest = joint.limits, _ANGLE if unit == "rad" else _LENGTH
        allowed = _BEYOND * (upper - lower)
        beyond, expected = f"outside of {lower:.4g} to {upper:.4g}", f"{unit} within the robot's limits"
        hint = "is this a run of another robot"
    elif unit == "rad":
        lower, upper, allowed, largest = -_TURNS, _TURNS, 0.0, np.inf
        beyond, expected, hint = "more than two turns", "rad, or limits in the robot file", "does the joint turn on"
    else:
        return
    bad = (x < lower - allowed) | (x > upper + allowed)
    if bad.any():
        other, others = (np.radians(x), "degrees") if unit == "rad" else (x / 1000, "millimetres")
        inside = other.min() >= lower - allowed and other.max() <= upper + allowed
        if inside and _moved(x, bad):
            hint = f"are these {others}" if np.abs(x).max() > largest else f"are these {others}, or {hint}"
        row = int(np.argmax(bad))
        counted = f"in {bad.sum()} of {len(x)} samples, of which this is the first"
        problem = f"{name} gives joint {joint.number} {x[row]:.6g} {unit}, {beyond}, {counted}"
        hint = "a wrong row may be deleted, it is a lost sample then" if ticks.may_lose(bad) else f"{hint}?"
        raise InputError(where(row, name), problem, f"{expected}; {hint}")


def _moved(x: Array, there: NDArray[np.bool_]) -> bool:
    """Whether a position (N) moves to where it is ``there`` as it moves elsewhere, or is there most of the time: wrong
    samples jump there.
    """
    steps, across = np.abs(np.diff(x)), np.diff(there)
    usual = np.max(steps, where=~across, initial=0.0)
    return bool(there.mean() > _MOST or np.max(steps, where=across, initial=0.0) <= _FASTER * usual)


def _speed(x: Array, joint: Joint, name: str, period: float, where: Where) -> None:
    width = min(max(1, round(_WINDOW / period)), len(x) - 1)
    speed = np.abs(x[width:] - x[:-width]) / (width * period)
    if speed.max() > _FAST:
        row = int(np.argmax(speed > _FAST))
        problem = f"{name} moves at {speed[row]:.4g} a second"
        unit, wrong = joint.position_unit, "millimetres" if joint.sigma == PRISMATIC else "degrees"
        raise InputError(where(row, name), problem, f"at most {_FAST:g} {unit}/s; are these {wrong}?")


def _held(x: Array, steps: Array, name: str, where: Where) -> None:
    """A position that stops dead at its highest or lowest value and leaves it as abruptly is cut off; an encoder's
    single step is not abrupt.
    """
    moving = np.quantile(steps, 0.9)
    finest = np.min(steps, where=steps > 1e-3 * moving, initial=np.inf)
    for one in at_extremes(x):
        if one.start == 0 or one.stop == len(x):
            continue
        before, after = steps[one.start - 1], steps[one.stop - 1]
        inner = steps[one.start - 2] if one.start > 1 else 0.0
        resolution = max(finest, _step_at(x, one, moving))
        if min(before + inner, after) > max(0.3 * moving, _ABRUPT * resolution) > 0:
            problem = f"{name} stays at {x[one.start]:.6g} from here for {one.stop - one.start} rows"
            raise InputError(where(one.start, name), problem, "a position that is not cut off")


def _step_at(x: Array, one: slice, moving: float) -> float:
    """The step in which a signal that turns at an extreme is told there, zero where it is not seen: of numbers with few
    digits it is larger at large values.

    Where a smooth signal stays ten rows at its last step, it stays two at least at the one before and the one after.
    """
    beside = x[max(one.start - 2, 0) : one.start], x[one.stop : one.stop + 2]
    if any(len(rows) < 2 or rows[0] != rows[1] for rows in beside):
        return 0.0
    values = np.unique(x)
    distances = np.sort(np.abs(values - x[one.start]))[: _NEXT + 1]
    gaps = np.diff(distances)
    seen = gaps[gaps > 1e-3 * moving]
    step = float(seen.min(initial=np.inf))
    return step if seen.size and np.all(np.abs(gaps / step - np.round(gaps / step)) < _WHOLE) else 0.0


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
