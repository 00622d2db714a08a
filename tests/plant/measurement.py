"""What sensors make of the truth: quantised encoders, late positions, noisy currents, temperatures."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tests.plant.robot import Array
from tests.plant.run import Noise, Run


@dataclass(frozen=True)
class Sensors:
    """``noise`` is the standard deviation of a current's noise over the rms of that current, for all motors or for
    each.

    ``colour`` is the share of its variance below a corner [Hz]. So many joints, from the first, have
    ``link_encoders``, logged as qs with ``link_bits`` a turn. ``temperature`` logs the housings in kelvin above the
    hall, with a sensor's noise. ``quantised`` False is a motor encoder without steps in the log.
    """

    noise: float | tuple[float, ...] = 0.02
    colour: tuple[float, float] = (0.7, 8.0)
    quantised: bool = True
    link_encoders: int = 0
    link_bits: int = 22
    temperature: bool = False


def measure(run: Run, sensors: Sensors, seed: int) -> Run:
    """The run with its logged signals."""
    robot, truth = run.robot, run.truth
    rng = np.random.default_rng([seed, 7])
    qm = motor_angles(run, reading(run, "delay"))
    if sensors.quantised:
        step = 2 * np.pi / 2**robot.encoder_bits
        qm = step * np.rint(qm / step)
    current = truth.current.copy()
    for effect in run.effects:
        if effect.what.reading == "command":
            current[:, effect.joint - 1] = truth.command[:, effect.joint - 1]
    std = np.broadcast_to(np.asarray(sensors.noise), robot.joints) * np.sqrt(np.mean(current**2, axis=0))
    noise = Noise(np.asarray(std), *sensors.colour, run.rate)
    qs = None
    if sensors.link_encoders:
        step = 2 * np.pi / 2**sensors.link_bits
        links = late(run, truth.q, truth.qd, truth.qdd, reading(run, "link_latency"))[:, : sensors.link_encoders]
        qs = step * np.rint(links / step)
    temperature = _temperature(run, rng) if sensors.temperature else None
    return replace(
        run, qm=qm, i=current + std * _noise(noise, current.shape, rng), qs=qs, temperature=temperature, noise=noise
    )


def reading(run: Run, which: str) -> float:
    """Sum of the sizes of effects that act on readings."""
    return sum((effect.amount(run.robot) for effect in run.effects if effect.what.reading == which), 0.0)


def motor_angles(run: Run, delay: float) -> Array:
    """What the motors' encoders would log (T x n) without steps."""
    machine, truth = run.machine, run.truth
    th = late(run, truth.th, truth.thd, truth.thdd, delay)
    return np.asarray((th * machine.encoder_scale + machine.encoder_offset) @ run.robot.ratios.T)


def late(run: Run, x: Array, xd: Array, xdd: Array, delay: float) -> Array:
    """Signals (T x n) of ``delay`` [s] ago, by the polynomials of degree five that meet x, xd and xdd at two rows.

    Before the first row the first one is extrapolated.
    """
    if not delay:
        return x
    h = 1 / run.rate
    at = np.arange(len(x)) - delay / h
    k = np.clip(np.floor(at).astype(int), 0, len(x) - 2)
    s = (at - k)[:, None]
    left, right = (x[k], h * xd[k], h * h * xdd[k]), (x[k + 1], h * xd[k + 1], h * h * xdd[k + 1])
    way = right[0] - left[0] - left[1] - left[2] / 2
    rise = right[1] - left[1] - left[2]
    bend = right[2] - left[2]
    c3, c4, c5 = 10 * way - 4 * rise + bend / 2, -15 * way + 7 * rise - bend, 6 * way - 3 * rise + bend / 2
    return np.asarray(left[0] + s * (left[1] + s * (left[2] / 2 + s * (c3 + s * (c4 + s * c5)))))


def _noise(noise: Noise, shape: tuple[int, ...], rng: np.random.Generator) -> Array:
    """Of unit variance, with the spectrum that Noise states."""
    a = float(np.exp(-2 * np.pi * noise.corner / noise.rate))
    white, driven = rng.normal(size=(2, *shape))
    driven[1:] *= np.sqrt(1 - a**2)
    low = np.empty(shape)
    last = np.zeros(shape[1])
    for k, kick in enumerate(driven):
        low[k] = last = a * last + kick
    return np.asarray(np.sqrt(noise.share) * low + np.sqrt(1 - noise.share) * white)


def _temperature(run: Run, rng: np.random.Generator) -> Array:
    """Housings (T x n) [K] above the hall: 25 K when warm, by the same two exponentials as the warm-up of friction,
    to 0.1 K.
    """
    n = run.robot.joints
    fast, slow = np.full(n, 25.0), np.full(n, 400.0)
    for effect in run.effects:
        if effect.law == "warm_up":
            fast[effect.joint - 1] = effect.value("fast", run.robot)
            slow[effect.joint - 1] = effect.value("slow", run.robot)
    t = (run.start_time + run.t)[:, None]
    warm = 25.0 * (1 - 0.6 * np.exp(-t / fast) - 0.4 * np.exp(-t / slow))
    return np.asarray(np.round(warm + 0.05 * rng.normal(size=warm.shape), 1))
