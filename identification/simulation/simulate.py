"""One run: from a robot and settings to the columns that its controller would record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from identification import corrections
from identification.arrays import Array
from identification.drive_train import coupling
from identification.signals import EFFORTS, WRENCH
from identification.simulation.checks import check, chosen, each, pose, timed, trajectory_of
from identification.simulation.closed_loop import Log, Loop, Progress, torque_constants
from identification.simulation.machine import Machine
from identification.simulation.payload import carried, whole
from identification.simulation.settings import FURTHER, Settings
from identification.trajectory import Reference, Task, Unplanned, Value

#: Part of a torque that is rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Simulated:
    """A run's ``columns`` by name (N each), as in a run file, and what it was made from.

    ``parameters`` are the robot's own values [SI] at the start; ``trajectory`` are its settings.
    """

    columns: Mapping[str, Array]
    settings: Settings
    trajectory: Mapping[str, Value]
    pose: Array
    parameters: Mapping[str, float]


def simulate(machine: Machine, settings: Settings, progress: Progress = lambda part: None) -> Simulated:
    """The run that ``settings`` ask for, the same for the same settings.

    Raises InputError for settings that the robot does not allow.
    """
    settings = timed(settings)
    check(settings, machine.robot)
    kind, values, start = trajectory_of(settings.trajectory), chosen(settings), pose(settings, machine.robot)
    model = machine.module.Robot(settings.set_name)
    parameters = dict(zip(machine.module.PARAMETERS, model.parameters.tolist(), strict=True))
    if settings.payload is not None:
        model.update(carried(machine.module, model, whole(settings.payload)))
    draw = np.random.default_rng([settings.seed, 0])
    task = Task(
        machine.robot, model, parameters, settings.flexible, start, settings.period, settings.samples, draw, values
    )
    try:
        reference = kind.plan(task)
    except Unplanned as error:
        raise InputError(command_line("--trajectory"), error.problem, error.expected) from None
    log = Loop(machine, model, settings, reference).run(progress)
    columns = _columns(machine, model, settings, reference, log)
    clean = Simulated(columns, replace(settings, noise=(0.0,), wrench_noise=(0.0,)), values, start, parameters)
    seed = settings.seed if settings.noise_seed is None else settings.noise_seed
    return noisy(clean, settings.noise, settings.wrench_noise, seed)


def noisy(run: Simulated, noise: Sequence[float], wrench_noise: Sequence[float] = (0.0,), seed: int = 0) -> Simulated:
    """A run without noise as it is logged with noise, which the controller never sees: see ``Settings``.

    The run is simulated once for any number of seeds.
    """
    if any(run.settings.noise) or any(run.settings.wrench_noise):
        raise ValueError("this run has its noise already")
    efforts = [name for name in run.columns if name.rstrip("0123456789") in EFFORTS]
    wrench = [name for name in run.columns if name in WRENCH]
    forces, moments = (*wrench_noise, 0.0)[:2]
    columns = dict(run.columns)
    for stream, names, sizes in (
        (1, efforts, each(noise, len(efforts), "--noise")),
        (2, wrench, np.array([forces] * 3 + [moments] * 3)[: len(wrench)]),
    ):
        drawn = np.random.default_rng([seed, stream]).normal(size=(len(columns["t"]), len(names)))
        columns |= {name: columns[name] + size * x for name, size, x in zip(names, sizes, drawn.T, strict=True)}
    settings = replace(run.settings, noise=noise, wrench_noise=wrench_noise, noise_seed=seed)
    return replace(run, columns=columns, settings=settings)


def _columns(machine: Machine, model: Any, settings: Settings, reference: Reference, log: Log) -> dict[str, Array]:
    """What is logged, without noise, and with what the robot's file says of its signals."""
    robot, kept = machine.robot, slice(None, None, settings.every)
    rows, n = log.q.shape
    numbers = robot.numbers
    N = coupling(robot)
    constants = torque_constants(machine, model)
    t: Array = settings.period * np.arange(rows, dtype=float)
    warmth = settings.warmth(t)
    drift = 1 + settings.constant_drift * warmth
    rises = {f"temp{number}": settings.rise * warmth for number in numbers} if "temp" in settings.further else {}
    motor = _recorded(np.linalg.inv(N).T @ log.tau.T, drift, rises, t, settings.period, robot)
    effort = motor.T / constants / drift[:, None]
    late = np.maximum(np.arange(rows) - settings.late(settings.link_delay), 0)
    parts = {
        "qm" if robot.drives else "q": corrections.recorded_positions(log.q.T, robot).T @ N.T,
        _effort(machine): effort,
        "qr": corrections.recorded_positions(reference.q.T, robot).T,
        "qs": corrections.recorded_links(log.links[late].T, robot, settings.period).T,
        "temp": np.tile((settings.temperature + settings.rise * warmth)[:, None], n),
    }
    columns: dict[str, Array] = {"t": t[kept]}
    for stem, values in parts.items():
        if stem in settings.further or stem not in FURTHER:
            columns |= {f"{stem}{number}": values[kept, k] for k, number in enumerate(numbers)}
    if log.wrench is not None:
        columns |= {name: log.wrench[kept, k] for k, name in enumerate(WRENCH)}
    return columns


def _recorded(true: Array, drift: Array, rises: Mapping[str, Array], t: Array, period: float, robot: Robot) -> Array:
    """Torques of the motors (n x N) as they would be recorded but for a ``drift`` (N) of which the file knows nothing.

    Raises InputError where they heat a motor until its torque constant is none.
    """
    N = coupling(robot)
    motor = corrections.recorded_motor_torques(true, robot, period, None)
    # What is recorded may tell the warmth by which it is recorded. That of a sample depends on those before it alone:
    # each round makes one more right at least. A constant that falls is less so in each but the last: none is too warm
    # before that is.
    for _ in range(len(t)):
        before = motor
        warmth = corrections.warmth(rises, t, N.T @ (before / drift), robot, robot.place)
        motor = corrections.recorded_motor_torques(true, robot, period, warmth)
        if np.allclose(motor, before, rtol=_ROUNDING, atol=0.0):
            break
    return motor


def _effort(machine: Machine) -> str:
    """The stem of the columns of efforts."""
    if machine.robot.drives is None:
        return "tau"
    return "i" if machine.model.torque_constants else "taum"
