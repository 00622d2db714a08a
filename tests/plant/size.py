"""How large an effect is: its torque along a run, weighed against the run's noise.

The measure is that of a diagnosis: the rms of the whitened effect, after projection on all that a fit may adjust,
over the rms of the whitened noise. The noise's spectrum is the true one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from tests.plant.effect import Effect
from tests.plant.law import value_of
from tests.plant.machine import Machine
from tests.plant.measurement import reading
from tests.plant.robot import Array, Robot
from tests.plant.run import Run
from tests.plant.simulate import make_run
from tests.plant.trajectory import Trajectory


def torque_with(run: Run) -> Array:
    """Joint torques (T x n) that the log would hold without noise, by the data's ratios and constants."""
    current = run.truth.current.copy()
    for effect in run.effects:
        if effect.what.reading == "command":
            current[:, effect.joint - 1] = run.truth.command[:, effect.joint - 1]
    return np.asarray(current * run.robot.column("constant") @ run.robot.ratios)


def torque_without(run: Run, effect: Effect) -> Array:
    """Joint torques (T x n) that the robot without ``effect`` would need along the motion that the log holds, steps
    apart.

    Friction near standstill is taken as it was. Raises ValueError where the run has no such effect.
    """
    if effect not in run.effects:
        raise ValueError(f"the run has no {effect.law} on joint {effect.joint}")
    rest = list(run.effects)
    rest.remove(effect)
    robot, truth, machine = run.robot, run.truth, Machine(run.robot, tuple(rest))
    seen = [truth.th * run.machine.encoder_scale + run.machine.encoder_offset]
    seen += [x * run.machine.encoder_scale for x in (truth.thd, truth.thdd)]
    # What stays must not be counted as gone: readings of the robot without the effect are its own.
    moved = [(seen[0] - machine.encoder_offset) / machine.encoder_scale, *(x / machine.encoder_scale for x in seen[1:])]
    if np.any(machine.flexible):
        moved = [truth.q, truth.qd, truth.qdd] if np.array_equal(machine.flexible, run.machine.flexible) else moved
    elif np.any(run.machine.flexible):
        # What a log can show of a motor that trembles faster than its samples.
        moved[2] = _slope(moved[1], run.rate)
    torque = machine.rigid_torques(*moved)
    step = 1 / run.rate
    there = machine.law_torques(moved[0], moved[1], step, run.start_time)
    links = machine.law_torques(truth.q, truth.qd, step, run.start_time)
    motors = machine.law_torques(truth.th, truth.thd, step, run.start_time)
    for k, other in enumerate(machine.torques):
        was = truth.torque[:, run.machine.torques.index(other)]
        here = links if other.what.of_links else motors
        torque += np.outer(was + there[:, k] - here[:, k], other.along(robot))
    torque *= machine.encoder_scale**-1.0
    gain = machine.gain - machine.heat_drop * truth.heat
    torque = np.linalg.solve(robot.ratios.T, torque.T).T / gain @ robot.ratios
    late = reading(run, "delay") - sum(other.amount(robot) for other in rest if other.what.reading == "delay")
    if late:
        torque = np.column_stack([np.interp(run.t - late, run.t, column) for column in torque.T])
    return torque


def _slope(x: Array, rate: float) -> Array:
    """Derivative of signals (T x n), of fourth order but at the ends."""
    slope = np.gradient(x, 1 / rate, axis=0)
    slope[2:-2] = rate * (8 * (x[3:-1] - x[1:-3]) - (x[4:] - x[:-4])) / 12
    return np.asarray(slope)


def effect_torque(run: Run, effect: Effect) -> Array:
    """What ``effect`` adds to the logged torque (T x n) along the logged motion: as it acted, or as with less
    without.

    The difference is known to a hundredth of the usual noise. An effect on the link encoders alone adds nothing.
    """
    if effect.what.reading == "link_latency":
        return np.zeros_like(run.truth.q)
    if effect.what.torque and effect in run.machine.torques:
        return np.outer(run.truth.torque[:, run.machine.torques.index(effect)], effect.along(run.robot))
    return torque_with(run) - torque_without(run, effect)


def whiten(run: Run, torque: Array, limit: float | None = None) -> Array:
    """Torques (T x n, or T x n x b) as rows of sines and cosines up to ``limit`` [Hz], in which the noise has unit
    variance.

    The first row is the mean.
    """
    assert run.noise is not None
    rows = len(torque)
    frequency = np.arange(rows // 2 + 1) * run.rate / rows
    kept = frequency < (limit or run.rate / 2)
    lines = np.fft.rfft(torque, axis=0)[kept]
    # Each of the two parts of a line of noise has the variance shape x rate x rows / 4.
    deviation = np.sqrt(run.noise.shape(frequency[kept]) * run.rate * rows / 4)
    scale = 1 / (deviation[:, None] * run.torque_noise)
    lines = lines * (scale if torque.ndim == 2 else scale[:, :, None])
    return np.concatenate([lines.real[:1] / np.sqrt(2), lines.real[1:], lines.imag[1:]])


def whitened_size(
    run: Run, torque: Array, basis: Array | None = None, limit: float | None = None, joints: Sequence[int] | None = None
) -> float:
    """Size of a torque (T x n) over the noise, after projection on the complement of ``basis`` (T x n x b) if given.

    It is taken over the rows of ``joints`` (from 1), all of them if None. A projection uses all joints.
    """
    whitened = whiten(run, torque, limit)
    if basis is not None:
        columns = whiten(run, basis, limit).reshape(whitened.size, -1)
        norms = np.linalg.norm(columns, axis=0)
        columns = columns[:, norms > 0] / norms[norms > 0]
        left, strength, _ = np.linalg.svd(columns, full_matrices=False)
        left = left[:, strength > 1e-10 * strength[0]]
        flat = whitened.reshape(-1)
        whitened = (flat - left @ (left.T @ flat)).reshape(whitened.shape)
    kept = range(run.robot.joints) if joints is None else [joint - 1 for joint in joints]
    return float(np.sqrt(np.mean(whitened[:, list(kept)] ** 2)))


def free_fit(run: Run, effect: Effect | None = None) -> Array:
    """Torques (T x n x b) per unit of all that a free fit adjusts: bodies, rotors, and the sizes of what acts beside
    ``effect``.

    The motion is the true one of the motors. Effects that change the robot beside ``effect`` are left out, but for a
    wrist's rotor.
    """
    robot, truth = run.robot, run.truth
    columns = []
    machine = Machine(robot, ())
    machine.gravity, machine.rotor[:] = run.machine.gravity, 0.0
    bodies = machine.body
    for j in range(robot.joints):
        for k in range(bodies.shape[1]):
            machine.body = np.zeros_like(bodies)
            machine.body[j, k] = 1.0
            columns.append(machine.rigid_torques(truth.th, truth.thd, truth.thdd))
    rotors = [np.eye(robot.joints)[j] for j in range(robot.joints)]
    for other in run.effects:
        if other == effect:
            continue
        if other.law == "wrist_inertia":
            rotors.append(other.along(robot))
        elif other.what.torque and other.amount(robot):
            torque = run.truth.torque[:, run.machine.torques.index(other)]
            columns.append(np.outer(torque, other.along(robot)) / other.amount(robot))
    columns += [np.outer(truth.thdd @ along, along) for along in rotors]
    return np.stack(columns, axis=2)


def scale_effect(
    robot: Robot,
    trajectory: Trajectory,
    effect: Effect,
    target: float,
    measure: Callable[[Run, Array], float] = whitened_size,
    others: Sequence[Effect] = (),
    tolerance: float = 0.02,
    **options: Any,
) -> tuple[Effect, Run]:
    """The effect with the size at which ``measure(run, torque)`` is ``target``, and the run that showed it.

    ``options`` go to ``make_run``. Raises ValueError where no size below the law's largest will do within twenty
    runs.
    """
    size, low, high = effect.amount(robot), 0.0, value_of(effect.what.largest, robot, effect.joint - 1)
    sign = np.sign(size)
    size = min(abs(size), 0.5 * high)
    reached = False
    for _ in range(20):
        tried = effect.sized(float(sign * size))
        run = make_run(robot, trajectory, (*others, tried), **options)
        found = measure(run, effect_torque(run, tried))
        if abs(found / target - 1) <= tolerance:
            return tried, run
        if found < target:
            low = size
        else:
            high, reached = size, True
        guess = size * target / found if found > 0 else 2 * size
        if not low < guess < high:
            guess = 0.5 * (low + high) if np.isfinite(high) else 2 * size
        if not reached and high - size < 1e-3 * high:
            break
        size = guess
    raise ValueError(f"{effect.law} on joint {effect.joint} does not come to {target:g} times the noise")
