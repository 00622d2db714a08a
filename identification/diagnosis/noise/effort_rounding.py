"""What the steps of recorded efforts, coarse ones of a drive that tells per cents, leave of the torques.

Noise from period to period smooths the steps of what periods have in common: the mean of a rounded signal is a
staircase whose edges are as round as the noise is wide (Widrow, Kollar, Quantization Noise, 2008, ch. 5). The rest is
noise between the periods like any other.
"""

from __future__ import annotations

from functools import cache
from math import pi, sqrt

import numpy as np
from scipy.special import ndtr

from generator.words import listed
from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.runs.phases import by_period
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene

#: Harmonics of a staircase that are summed.
_HARMONICS = 30
#: Steps in parts of the torque's spread from which they are told.
_LARGE = 0.03
#: Parts of a period, one of which may be like no other: a beginning.
_PARTS = 10
#: Deviations of noise [steps] that are tried, places between two steps of which the mean is taken, and farthest step.
_DEVIATIONS, _PLACES, _FAR = np.linspace(0.0, 1.0, 51), 200, 6


def effort_rounding(run: Prepared, scene: Scene) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be. Zero without steps, and where nothing repeats.
    """
    coarse = scene.sampled.run.coarse if run.times else None
    if coarse is None:
        return np.zeros_like(run.tau)
    recorded, model = (np.linalg.solve(coarse.acting, tau) for tau in (scene.sampled.run.tau, scene.torque))
    again = recorded[:, run.stretch]
    error = np.stack([_error(*one, run.repeats) for one in zip(again, model, coarse.steps, strict=True)])
    return np.asarray(sqrt(run.times) * run.decimated(coarse.acting @ error))


def told(bank: Bank) -> dict[int, float]:
    """By coordinate, the steps [N m, N] of torques that are large beside the spread of the torque."""
    largest: dict[int, float] = {}
    for run, scene in zip(bank.runs, bank.scenes, strict=True):
        if scene.sampled.run.coarse is not None:
            for k, step in enumerate(scene.sampled.run.coarse.of_joints.tolist()):
                if step > _LARGE * np.std(run.tau[k]):
                    largest[k] = max(largest.get(k, 0.0), step)
    return largest


def notes(bank: Bank) -> list[str]:
    """What is to be told of joints whose torques take large steps."""
    joints = bank.robot.moving
    where = [
        f"{step:.3g} {joints[k].torque_unit} on joint {joints[k].number}" for k, step in sorted(told(bank).items())
    ]
    return [f"torques take steps, {listed(where)}: what rounding leaves counts as noise"] if where else []


def _error(recorded: Array, model: Array, step: float, period: int) -> Array:
    """What rounding adds to the mean over periods of so many samples of an effort, ``recorded`` where it repeats (M),
    along the model's (N).
    """
    noise = _noise(_between(recorded / step, period)) if step else _DEVIATIONS[-1]
    # Steps that are fine beside the noise leave nothing, and have many logs.
    return np.zeros_like(model) if noise == _DEVIATIONS[-1] else step * _mean(model / step, noise)


def _between(x: Array, period: int) -> float:
    """Variance of a signal between its periods, of which the last may be a part, without the part of them in which it
    is largest; infinite where they are too short to be compared so.
    """
    there = by_period(np.ones(len(x), dtype=bool), period)
    twice = there.sum(axis=0) > 1
    every = np.nanvar(np.where(there, by_period(x, period), np.nan)[:, twice], axis=0, ddof=1)
    parts = [np.mean(part) for part in np.array_split(every, _PARTS) if len(part)]
    return float(np.mean(np.sort(parts)[:-1])) if len(parts) > 1 else np.inf


def _mean(x: Array, noise: float) -> Array:
    """Mean error of rounding x [steps] with Gaussian noise of so many steps."""
    k = np.arange(1, _HARMONICS + 1)
    weights = (-1.0) ** k / (pi * k) * np.exp(-2 * (pi * k * noise) ** 2)
    return np.asarray(np.sin(2 * pi * np.outer(x, k)) @ weights)


def _noise(variance: float) -> float:
    """Deviation of noise [steps] with which a rounded signal has a variance [steps^2]."""
    return float(np.interp(variance, _variances(), _DEVIATIONS))


@cache
def _variances() -> tuple[float, ...]:
    """Variances [steps^2] of a rounded signal with noise, in the mean over where it is between two steps."""
    places = (np.arange(_PLACES) + 0.5) / _PLACES
    values = np.arange(-_FAR, _FAR + 1)
    result = [0.0]
    for noise in _DEVIATIONS[1:]:
        below = ndtr((np.append(values - 0.5, _FAR + 0.5) - places[:, None]) / noise)
        share = np.diff(below, axis=1)
        result.append(float(np.mean(share @ values**2 - (share @ values) ** 2)))
    return tuple(result)
