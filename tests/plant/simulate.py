"""The closed loop played, and what a controller would have logged of it."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np

from tests.plant.compiled import library
from tests.plant.effect import Effect
from tests.plant.machine import Machine, fill, pointer
from tests.plant.measurement import Sensors, measure
from tests.plant.robot import Array, Robot
from tests.plant.run import Run, Truth
from tests.plant.trajectory import Trajectory

#: The part of a radian that the fastest drive train may swing through in one step of integration.
_SWING = 0.35

#: Channels of a row, n each, before the effects' torques.
_CHANNELS = ("q", "qd", "qdd", "th", "thd", "thdd", "current", "command", "heat", "friction", "load")


@dataclass(frozen=True)
class Controller:
    """Rates [Hz] of control and logging, the current loop's lag and the speed filter's time constant [s].

    ``position_share`` and ``integral_share`` are the bandwidths of the position loop and of the integrator over that
    of the speed loop. ``longest_step`` [s] is that of integration, not of the controller.
    """

    rate: float = 2000.0
    log_rate: float = 500.0
    lag: float = 5e-4
    speed_filter: float = 1e-3
    position_share: float = 0.2
    integral_share: float = 0.25
    longest_step: float = 1.25e-4


class RanAway(Exception):
    """The closed loop did not hold the robot."""


def own_effects(robot: Robot) -> tuple[Effect, ...]:
    """Viscous and Coulomb friction and offset of every joint, then the robot's own effects: what it has unless told
    otherwise.
    """
    joints = range(1, robot.joints + 1)
    simple = [Effect(law, j) for law in ("viscous", "coulomb") for j in joints]
    offsets = [Effect("offset", j, robot.chain[j - 1].offset) for j in joints]
    return (*simple, *offsets, *robot.own)


def make_run(
    robot: Robot,
    trajectory: Trajectory,
    effects: Sequence[Effect] = (),
    seed: int = 0,
    sensors: Sensors | None = None,
    controller: Controller | None = None,
    own: Sequence[Effect] | None = None,
    start_time: float = 0.0,
) -> Run:
    """Play a trajectory on a robot with its ``own`` effects (None: all of ``own_effects``) and more ``effects``.

    ``seed`` is that of the noise; ``start_time`` [s] is when the log begins on the clock of warm-up, ripple's
    wandering, collisions. Raises ValueError for rates that do not divide, RanAway where the motion does.
    """
    sensors, controller = sensors or Sensors(), controller or Controller()
    everything = (*(own_effects(robot) if own is None else own), *effects)
    machine = Machine(robot, everything)
    truth, reference, steps = _play(machine, trajectory, controller, start_time)
    return measure(
        Run(
            robot=robot,
            effects=everything,
            trajectory=trajectory,
            machine=machine,
            rate=controller.log_rate,
            start_time=start_time,
            reference=reference,
            truth=truth,
            steps=steps,
        ),
        sensors,
        seed,
    )


def _play(
    machine: Machine, trajectory: Trajectory, controller: Controller, start_time: float
) -> tuple[Truth, Array, int]:
    robot, n = machine.robot, machine.robot.joints
    per_row = _whole(controller.rate / controller.log_rate, "control and log rate")
    skipped = _whole(trajectory.before * controller.log_rate, "time before the log")
    if trajectory.period:
        _whole(trajectory.period * controller.log_rate, "period")
    qr, qdr = trajectory.sample(robot, controller.rate)
    period = 1 / controller.rate
    middle = np.mean(qr, axis=0)
    per_tick = ceil(max(period / controller.longest_step, period * machine.fastest(middle) / _SWING))
    plant = machine.in_c()
    plant.start_time = start_time - trajectory.before
    plant.lag, plant.speed_filter = controller.lag, controller.speed_filter
    fill(plant.inertia, np.diag(machine.inertia_matrix(middle)))
    fill(plant.speed_gain, [robot.speed_loop] * n)
    fill(plant.position_gain, [controller.position_share * robot.speed_loop] * n)
    fill(plant.integral_gain, [controller.integral_share * robot.speed_loop] * n)
    rows = np.zeros(((len(qr) - 1) // per_row + 1, len(_CHANNELS) * n + len(machine.torques)))
    step = ctypes.c_double(period / per_tick)
    written = library().plant_run(
        ctypes.byref(plant), step, per_tick, len(qr), per_row, pointer(qr), pointer(qdr), pointer(rows)
    )
    if written < 0:
        raise RanAway(f"{robot.name} ran away")
    rows = rows[skipped:-1]
    channels = {name: rows[:, k * n : (k + 1) * n] for k, name in enumerate(_CHANNELS)}
    truth = Truth(**channels, torque=rows[:, len(_CHANNELS) * n :])
    return truth, qr[::per_row][skipped:-1], per_tick


def _whole(value: float, what: str) -> int:
    if abs(value - round(value)) > 1e-9 * max(1.0, value):
        raise ValueError(f"{what}: {value} is not whole")
    return round(value)
