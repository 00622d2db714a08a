"""Between what is recorded and what is true, as section ``signals`` of the robot file says (docs/robot_file.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import sympy
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.signal import lfilter

from generator.effects.library import effects_of
from generator.errors import InputError, Place
from generator.robot.description import Robot
from identification.arrays import Array
from identification.drive_train import constants, coupling, driven, motor_torques, with_constants

#: What a file states for joints that no motion limits or warms [A, s, K, N m].
NEVER = 1e6
#: Part of a limit by which rounding, to torques and back, may take a current that is at it below.
_REACHED = 1e-9


def true_positions(q: Array, robot: Robot) -> Array:
    """Recorded joint positions (n x N) [rad, m] with their offsets."""
    offset = robot.signals.position_offset
    return q + _column(offset) if offset else q


def recorded_positions(q: Array, robot: Robot) -> Array:
    """Recorded positions of true joint positions (n x N) [rad, m]: the inverse of ``true_positions``."""
    offset = robot.signals.position_offset
    return q - _column(offset) if offset else q


def warmth(rises: Mapping[str, Array], t: Array, tau: Array, robot: Robot, place: Place) -> Array | None:
    """How warm each joint's drive is (n x N), ``t`` (N) [s] after a cold start; None if nothing says it.

    By the rise [K] of its temperature ``temp1`` ... (N) in the recording, one of ``rises``, over its ``warm_rise``;
    without the one or the other ``heated`` by the recorded torques ``tau`` (n x N) [N m, N] of its motor beside its
    ``warm_torque``, or 1 - exp(-t/warm_up_time). A drive of which nothing tells, and on whose warmth nothing depends,
    has rows that are no numbers.

    Raises Untold where an effect or a torque constant depends on it and nothing says it, and TooWarm where a drive is
    so warm that its motor's torque constant would be none.
    """
    signals, needed = robot.signals, _warm_joints(robot)
    motor, found = motor_torques(robot, tau), []
    for k, joint in enumerate(robot.moving):
        rise, whole = rises.get(f"temp{joint.number}"), float(signals.warm_rise[k]) if signals.warm_rise else NEVER
        if rise is not None and whole < NEVER:
            found.append(rise / whole)
        elif by_heat(robot, k):
            found.append(heated(motor[k] / float(signals.warm_torque[k]), t, float(signals.warm_up_time[k])))
        elif by_time(robot, k):
            found.append(warming_up(t, float(signals.warm_up_time[k])))
        elif joint.number in needed:
            raise Untold(joint.number, place, whole < NEVER)
        else:
            found.append(np.full(len(t), np.nan))
    for k, part in drifting(robot):
        _strong(part, found[k], robot.moving[k].number, place)
    return np.stack(found) if np.any(np.isfinite(found)) else None


def by_time(robot: Robot, k: int) -> bool:
    """Whether a time constant says how warm the drive of coordinate ``k`` is, where no temperature does."""
    time = robot.signals.warm_up_time
    return bool(time and time[k] < NEVER)


def by_heat(robot: Robot, k: int) -> bool:
    """Whether that is a time constant by which the recorded torque of its motor heats it."""
    torque = robot.signals.warm_torque
    return bool(by_time(robot, k) and torque and torque[k] < NEVER)


class Untold(InputError):
    """Nothing says how warm the drive of ``joint`` (number) is: no temperature does, where one ``could``."""

    def __init__(self, joint: int, place: Place, could: bool) -> None:
        ways = [f"a column temp{joint}", "warm_up_time in section signals of the robot file"]
        super().__init__(
            place,
            f"nothing says how warm the drive of joint {joint} is, on which torques depend",
            ", or ".join(ways if could else [ways[1], f"warm_rise there and {ways[0]}"]),
        )
        self.joint = joint


class TooWarm(InputError):
    """The drive of ``joint`` (number) is so warm that what the robot's file says of its torque constant cannot be."""

    def __init__(self, joint: int, place: Place, problem: str) -> None:
        super().__init__(place, problem, "a torque_drift by which it stays positive, or a warmth that is less")
        self.joint = joint


def _strong(drift: float, warmth: Array, number: int, place: Place) -> None:
    least = float(np.min(1 + drift * warmth))
    if least <= 0:
        problem = (
            f"the drive of joint {number} comes to a warmth of {np.abs(warmth).max():.3g} by section signals of the "
            f"robot file, where its motor's torque constant would be {least:.3g} times the cold one"
        )
        raise TooWarm(number, place, problem)


def warming_up(t: Array, warm_up_time: Array | float) -> Array:
    """The warmth of a drive ``t`` [s] after a cold start, by its time constant [s]."""
    return np.asarray(1 - np.exp(-t / warm_up_time))


def heated(load: Array, t: Array, warm_up_time: float) -> Array:
    """The warmth of a drive (N) that the square of its ``load`` (N) heats, ``t`` (N) [s] after a cold start, with its
    time constant [s]: dw/dt = (load^2 - w)/T. Before the first sample it was loaded as it is in the mean.
    """
    heat = load**2
    start = float(heat.mean() * warming_up(t[0], warm_up_time))
    kept = float(np.exp(-(t[-1] - t[0]) / max(len(t) - 1, 1) / warm_up_time))
    following, _ = lfilter([1 - kept], [1, -kept], heat[:-1], zi=[kept * start])
    return np.concatenate([[start], following])


def _warm_joints(robot: Robot) -> set[int]:
    """Numbers of the joints on whose drives' warmth torques depend."""
    of_constants = {robot.moving[k].number for k, _ in drifting(robot)}
    return of_constants | {one.site.joint.number for one in effects_of(robot) if "warmth" in one.effect.needs}


def drifting(robot: Robot) -> list[tuple[int, float]]:
    """Coordinates with motors whose torque constants drift, and by what part of them."""
    drift = robot.drives.torque_drift if robot.drives is not None else ()
    return [(k, float(part)) for k, part in enumerate(drift) if part]


def with_unit_constants(robot: Robot) -> Robot:
    """The robot with torque constants of 1 N m/A, for which the joint torques of currents are N^T i, and its motors'
    ``warm_torque`` in A by the file's own.
    """
    kt, unit = constants(robot).tolist(), with_constants(robot, [1.0] * len(robot.moving))
    warm = tuple(
        one if one >= NEVER else sympy.Float(one) / own for one, own in zip(robot.signals.warm_torque, kt, strict=False)
    )
    return replace(unit, signals=replace(robot.signals, warm_torque=warm))


def true_torques(tau: Array, robot: Robot, period: float, warmth: Array | None) -> Array:
    """Joint torques (n x N) [N m, N] of motors as strong as their gain, drift and warmth make them, at their own time.

    A recorded torque counts as a current times the torque constant: it drifts as the constant does. Torques beyond an
    end of the recording are those of the end.
    """
    signals, drifts = robot.signals, drifting(robot)
    if not (signals.torque_gain or signals.torque_delay or drifts):
        return tau
    motor = motor_torques(robot, cold_torques(tau, robot))
    if warmth is not None:
        for k, part in drifts:
            motor[k] *= 1 + part * warmth[k]
    if signals.torque_delay:
        motor = earlier(motor, signals.torque_delay, period)
    return np.asarray(coupling(robot).T @ motor, dtype=float)


def cold_torques(tau: Array, robot: Robot) -> Array:
    """Joint torques (n x N) [N m, N] of cold motors as strong as their gain makes them, when they are recorded."""
    gain = robot.signals.torque_gain
    if not gain:
        return tau
    return np.asarray(coupling(robot).T @ (_column(gain) * motor_torques(robot, tau)), dtype=float)


def recorded_motor_torques(motor: Array, robot: Robot, period: float, warmth: Array | None) -> Array:
    """Recorded torques of the motors of true ones (n x N) [N m, N]: the inverse of ``true_torques``."""
    signals = robot.signals
    result = motor.copy()
    if signals.torque_delay:
        result = earlier(motor, [-delay for delay in signals.torque_delay], period)
    if warmth is not None:
        for k, part in drifting(robot):
            result[k] /= 1 + part * warmth[k]
    return result / _column(signals.torque_gain) if signals.torque_gain else result


def recorded_links(q: Array, robot: Robot, period: float) -> Array:
    """Recorded link-side positions of true ones (n x N) [rad, m]: the inverse of ``true_links``."""
    delays = robot.signals.link_delay
    return earlier(q, [-delay for delay in delays], period) if delays else q


def saturated(tau: Array, robot: Robot) -> NDArray[np.bool_] | None:
    """Samples (n x N) of recorded torques that hold a current at or beyond its limit; None without a limit.

    Raises InputError where no torque constants tell the currents.
    """
    limit, drives = robot.signals.current_limit, robot.drives
    if not limit:
        return None
    if drives is None or not drives.torque_constants:
        raise InputError(robot.place, "current_limit without torque constants", "torque_constants in drives")
    current = motor_torques(robot, tau) / constants(robot)[:, None]
    return driven(robot, np.abs(current) >= _column(limit) * (1 - _REACHED))


def moved(unusable: NDArray[np.bool_], robot: Robot, period: float) -> NDArray[np.bool_]:
    """Marks of recorded torques (n x N) where the torques are at their own time; a sample more at each end."""
    delays = robot.signals.torque_delay
    if not delays:
        return unusable
    result = np.zeros_like(unusable)
    for delay in set(delays):
        first = int(np.floor(float(delay) / period))
        for steps in (first, first + 1):
            late = unusable[:, max(steps, 0) : result.shape[1] + min(steps, 0)]
            result[:, max(-steps, 0) :][:, : late.shape[1]] |= late
    return result


def true_links(columns: Mapping[str, Array], robot: Robot, period: float) -> dict[str, Array]:
    """The recording's further columns (N each), link-side positions ``qs1`` ... at their own time; ``period`` in s."""
    result = dict(columns)
    for joint, delay in zip(robot.moving, robot.signals.link_delay, strict=False):
        if (name := f"qs{joint.number}") in result:
            result[name] = earlier(result[name][None], (delay,), period)[0]
    return result


def whole(samples: int, robot: Robot, period: float) -> slice:
    """The samples for which what is recorded late or early was recorded."""
    delays = [float(delay) / period for delay in (*robot.signals.torque_delay, *robot.signals.link_delay)]
    first, last = (int(np.ceil(max([0.0, *(sign * one for one in delays)]) - 1e-9)) for sign in (-1, 1))
    return slice(first, samples - last)


def earlier(x: Array, delays: Sequence[sympy.Expr | float], period: float) -> Array:
    """Signals (n x N) that were recorded ``delays`` [s] late, at their own time, by a cubic spline; ends are held."""
    t = period * np.arange(x.shape[-1])
    rows = [
        make_interp_spline(t, row, min(3, len(t) - 1))(np.clip(t + float(delay), t[0], t[-1])) if delay else row
        for row, delay in zip(x, delays, strict=True)
    ]
    return np.stack(rows)


def _column(values: Sequence[sympy.Expr]) -> Array:
    return np.array([[float(value)] for value in values])
