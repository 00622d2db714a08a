"""Settings of a simulation that are checked before anything is compiled, and what follows from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from generator.bounds import above, not_negative, whole_number
from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.fields import nearest
from generator.words import plural
from identification.arrays import Array
from identification.named_set import named_set
from identification.simulation.payload import whole
from identification.simulation.settings import FURTHER, Settings
from identification.trajectories import trajectories
from identification.trajectory import Trajectory, Unplanned, Value, ends_of

#: Samples of the controller that a run may have.
_MOST = 10**8
#: Largest size, in SI, of what is added to a log, and shortest time of a warm-up [s]: beyond, numbers overflow.
_LARGEST, _SHORTEST = 1e12, 1e-9
#: Part by which a number may be off a whole one, as rounding makes it.
_WHOLE = 1e-9


def each(values: Sequence[float], n: int, option: str) -> Array:
    """One value a motor (n); raises InputError for another count than one or n."""
    if len(values) not in (1, n):
        raise InputError(
            command_line(option), f"{len(values)} numbers", "one" if n == 1 else f"one, or one for each of {n} motors"
        )
    return np.array(np.broadcast_to(np.asarray(values, dtype=float), (n,)))


def check(settings: Settings, robot: Robot) -> None:
    """Raises InputError for settings that are wrong, or wrong for the robot; the place is the option of the command."""
    settings = timed(settings)
    _check_numbers(settings)
    _check_rates(settings)
    _check_robot(settings, robot)
    n = len(robot.moving)
    for option, values in (
        ("--largest", settings.largest),
        ("--resolution", settings.resolution),
        ("--noise", settings.noise),
    ):
        each(values, n, option)
    if len(settings.wrench_noise) not in (1, 2):
        problem = f"{len(settings.wrench_noise)} numbers"
        raise InputError(command_line("--wrench-noise"), problem, "one of forces, or one of forces and one of moments")
    for name in settings.further:
        if name not in FURTHER:
            raise InputError(command_line("--also"), f"columns {name!r}", f"one of {', '.join(FURTHER)}")
    if settings.payload is not None:
        whole(settings.payload)
    if settings.link_delay and "qs" not in settings.further:
        raise InputError(command_line("--link-delay"), "no encoders of the links are logged", "--also qs")
    chosen(settings)
    pose(settings, robot)


def timed(settings: Settings) -> Settings:
    """Settings with a duration: a trajectory's own length where none is given.

    Raises InputError where a trajectory that has one cannot tell it.
    """
    length = trajectory_of(settings.trajectory).length
    if settings.duration is not None or length is None:
        return replace(settings, duration=settings.lasts)
    try:
        return replace(settings, duration=length(chosen(settings)))
    except Unplanned as error:
        raise InputError(command_line("--trajectory"), error.problem, error.expected) from None


def _check_numbers(settings: Settings) -> None:
    for option, value, bound, most in (
        ("--duration", settings.lasts, 0, np.inf),
        ("--rate", settings.rate, 0, np.inf),
        ("--bandwidth", settings.bandwidth, 0, _LARGEST),
        ("--temperature", settings.temperature, 0, _LARGEST),
        *((("--warm-up", settings.warm_up, _SHORTEST, np.inf),) if settings.warm_up is not None else ()),
        *(("--largest", one, 0, np.inf) for one in settings.largest if one != np.inf),
        ("--friction-drift", settings.friction_drift, -1, _LARGEST),
        ("--torque-constant-drift", settings.constant_drift, -1, _LARGEST),
    ):
        above(value, option, bound, most)
    for option, values in (
        ("--resolution", settings.resolution),
        ("--noise", settings.noise),
        ("--wrench-noise", settings.wrench_noise),
        ("--temperature-rise", [settings.rise]),
    ):
        for value in values:
            not_negative(value, option, _LARGEST)
    for option, delay in (("--delay", settings.delay), ("--link-delay", settings.link_delay)):
        if not_negative(delay, option) > settings.lasts:
            raise InputError(command_line(option), f"{delay:g} s", f"no more than the run, {settings.lasts:g} s")
    for option, seed in (("--seed", settings.seed), ("--noise-seed", settings.noise_seed or 0)):
        whole_number(seed, option, 0)


def _check_rates(settings: Settings) -> None:
    asked = settings.lasts * settings.rate
    if asked > _MOST:
        raise InputError(command_line("--duration"), f"{asked:g} samples", f"at most {_MOST}")
    if settings.samples < 2:
        raise InputError(
            command_line("--duration"), f"{settings.lasts:g} s, {plural(settings.samples, 'sample')}", "a longer run"
        )
    if settings.log_rate is not None:
        ratio = settings.rate / settings.log_rate if settings.log_rate > 0 else 0.0
        if ratio < 1 or abs(ratio - round(ratio)) > _WHOLE * ratio:
            whole = f"--rate, {settings.rate:g} Hz, divided by a whole number"
            raise InputError(command_line("--log-rate"), f"{settings.log_rate:g}", whole)
    for option, delay in (("--delay", settings.delay), ("--link-delay", settings.link_delay)):
        samples = delay * settings.rate
        if abs(samples - round(samples)) > _WHOLE * max(samples, 1.0):
            problem = f"{delay:g} s, {samples:.6g} samples"
            raise InputError(command_line(option), problem, f"a whole number of samples of {1 / settings.rate:g} s")


def _check_robot(settings: Settings, robot: Robot) -> None:
    if settings.flexible and not robot.flexible:
        problem = f"{robot.name} has no elastic drive trains"
        raise InputError(command_line("--flexible"), problem, "a robot file with the key flexible")
    named_set(robot, settings.set_name, command_line("--parameters"), settings.default_set)
    if trajectory_of(settings.trajectory).flexible and not settings.flexible:
        problem = f"{settings.trajectory} needs elastic drive trains"
        raise InputError(command_line("--trajectory"), problem, "--flexible")


def chosen(settings: Settings) -> dict[str, Value]:
    """Values of all settings of the trajectory [SI], those that are given before the defaults.

    Raises InputError for a setting that the trajectory has not and for a value out of its range.
    """
    place, given = command_line("--set"), settings.trajectory_settings
    kind = trajectory_of(settings.trajectory)
    values = {name: one.default for name, one in kind.settings.items()}
    for name, value in given.items():
        if name not in kind.settings:
            known = ", ".join(f"{one}={setting.default}" for one, setting in kind.settings.items())
            raise InputError(place, f"trajectory {kind.name} has no setting {name!r}", known)
        if not kind.settings[name].allows(value):
            raise InputError(place, f"{name} is {value}", kind.settings[name].range)
        values[name] = value
    return values


def trajectory_of(name: str) -> Trajectory:
    """The trajectory of a name; raises InputError where there is none."""
    known = trajectories()
    if name not in known:
        raise InputError(command_line("--trajectory"), f"there is no trajectory {name!r}", nearest(name, known))
    return known[name]


def pose(settings: Settings, robot: Robot) -> Array:
    """The pose (n) [rad, m] of the settings, inside of the limits, or the middle of them."""
    moving = robot.moving
    ends = [ends_of(robot, k) for k in range(len(moving))]
    if settings.pose is None:
        return np.array([(lower + upper) / 2 for lower, upper in ends])
    if len(settings.pose) != len(moving):
        problem = f"{len(settings.pose)} numbers"
        raise InputError(command_line("--pose"), problem, f"one for each of {len(moving)} joints")
    for joint, value, (lower, upper) in zip(moving, settings.pose, ends, strict=True):
        if not lower < value < upper:
            problem = f"joint {joint.number} at {value:g}"
            raise InputError(command_line("--pose"), problem, f"a position between {lower:.4g} and {upper:.4g}")
    return np.array(settings.pose, dtype=float)
