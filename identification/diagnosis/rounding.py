"""What the steps of recorded positions make of the joints' torques.

An acceleration of rounded positions is wrong by far more than they are, and where a motion repeats so do the errors of
rounding: what periods have in common is then no sign that the model lacks anything.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.perturbation import moved, sensitivity
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.filtering import flat_derivative, smoothed
from identification.observation import Motion

Array = NDArray[np.float64]

#: Part of a step within which differences of rounded positions are whole steps, and how many there must be.
_WHOLE, _COUNT = 0.02, 100
#: Steps that the smallest difference may be of, and times that a step is told more closely.
_SEVERAL, _CLOSER = 4, 12
#: Part of a signal's range that is the rounding of its arithmetic.
_ARITHMETIC = 1e-11


def steps(q: Array) -> Array:
    """The step (n) [rad, m] to which recorded positions (n x N) are rounded, zero where there is none."""
    return np.array([_step(row) for row in q])


def _step(q: Array) -> float:
    apart = np.sort(np.abs(np.diff(q)))
    apart = apart[apart > _ARITHMETIC * np.abs(q).max()]
    if len(apart) < _COUNT:
        return 0.0
    # The smallest difference may be of several steps.
    for several in range(1, _SEVERAL + 1):
        step = _refined(apart[0] / several, apart)
        if np.median(np.abs(apart / step - np.round(apart / step))) < _WHOLE:
            return step
    return 0.0


def _refined(step: float, apart: Array) -> float:
    """From few steps to many, which tell it the closer."""
    for end in np.unique(np.geomspace(1, len(apart), _CLOSER).astype(int)):
        whole = np.maximum(np.round(apart[:end] / step), 1)
        step = float(apart[:end] @ whole / (whole @ whole))
    return step


def rounding(run: Prepared, scene: Scene) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be: a draw for positions that cross many steps. Zero without steps, and where nothing repeats.
    """
    times = len(run.t) // run.period if run.period else 0
    change = drawn(scene) if times > 1 else None
    if change is None:
        return np.zeros_like(run.tau)
    return np.asarray(np.sqrt(times) * run.decimated(torque_of(change, scene)))


def drawn(scene: Scene) -> Motion | None:
    """What rounding may add to the motion: a draw for positions that cross many steps; None without steps."""
    one = scene.sampled
    step = steps(one.run.q)
    if not step.any():
        return None
    error = np.random.default_rng(0).uniform(-0.5, 0.5, one.run.q.shape) * step[:, None]
    q = smoothed(error, one.filters.order, one.filters.cutoff, one.run.rate)
    qd = flat_derivative(q, one.run.period)
    first = one.filters.first
    return Motion(q, qd, flat_derivative(qd, one.run.period)).part(first, first + one.motion.samples)


def torque_of(change: Motion, scene: Scene) -> Array:
    """What a small change of the motion makes of the model's torques (n x N) [N m, N]."""
    return sensitivity(lambda motion: scene.torque_of(scene.values, motion), scene.motion, change)


class Pretence:
    """What rounding makes a hypothesis explain that is not there: its columns, of the same rounded positions, are like
    the torque that the model lacks since its accelerations are wrong.
    """

    def __init__(self, bank: Bank, runs: Sequence[int]) -> None:
        self._bank, self._runs = bank, runs
        self._known: dict[tuple[int, ...], Array] = {}

    def products(self, variant: Variant) -> Array:
        """The part (k), by expectation, of the products of a variant's white columns with the torque."""
        if variant.columns not in self._known:
            self._known[variant.columns] = sum((self._along(r, variant) for r in self._runs), np.zeros(1))
        return self._known[variant.columns]

    @cached_property
    def _rounded(self) -> dict[int, tuple[Scene, Array]]:
        """By the run's number the scene once more rounded, and the torque that this makes; runs without steps lack."""
        result = {}
        for r in self._runs:
            scene = self._bank.scenes[r]
            if (change := drawn(scene)) is not None:
                sampled = replace(scene.sampled, motion=moved(scene.motion, change, 1.0))
                result[r] = replace(scene, sampled=sampled), torque_of(change, scene)
        return result

    def _along(self, r: int, variant: Variant) -> Array:
        if r not in self._rounded:
            return np.zeros(len(variant.columns))
        (scene, torque), run = self._rounded[r], self._bank.runs[r]
        one, used = variant.hypothesis, list(variant.used)
        change = (one.columns(scene, variant.shape) - one.columns(self._bank.scenes[r], variant.shape))[used]
        result = np.zeros(len(used))
        for k in variant.joints:
            rows = run.decimated(np.concatenate([change[:, k], torque[None, k]]))
            white = self._bank.colours[r][k].white(rows, run.kept[k])
            result -= white[:-1] @ white[-1]
        return result
