"""What the steps of recorded positions make of the joints' torques.

An acceleration of rounded positions is wrong by far more than they are, and where a motion repeats so do the errors of
rounding: what periods have in common is then no sign that the model lacks anything.
"""

from __future__ import annotations

from itertools import product
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.position_noise import drawn, torque_of
from identification.diagnosis.prepared import Prepared
from identification.diagnosis.scene import Scene
from identification.neighbours import ARITHMETIC, off_cubics

Array = NDArray[np.float64]

#: Part of a step within which most differences of rounded positions are whole steps, which part of them are most, and
#: how many there must be.
_WHOLE, _MOST, _COUNT = 0.02, 0.9, 100
#: Part of the differences that may be smaller than any rounding leaves.
_INTERPOLATED = 0.01
#: Steps that the smallest difference may be of, and times that a step is told more closely.
_SEVERAL, _CLOSER = 4, 12
#: Part of a step that rounded positions are off the cubics through their neighbours: those of even accelerations differ
#: by whole numbers of something too, and are smooth.
_ROUGH = 0.1


def steps(q: Array) -> Array:
    """The step (n) [rad, m] to which recorded positions (n x N) are rounded, zero where there is none."""
    return np.array([_step(row) for row in q])


def _step(q: Array) -> float:
    apart = np.sort(np.abs(np.diff(q)))
    apart = apart[apart > ARITHMETIC * np.abs(q).max()]
    if len(apart) < _COUNT:
        return 0.0
    moves = np.diff(q) != 0
    among = moves[:-3] | moves[1:-2] | moves[2:-1] | moves[3:]
    off = np.abs(off_cubics(q))[among]
    # The smallest differences may be of samples that were interpolated; each may be of several steps.
    for least, several in product((apart[int(_INTERPOLATED * len(apart))], apart[0]), range(1, _SEVERAL + 1)):
        step = _refined(least / several, apart[apart >= least])
        if np.quantile(np.abs(apart / step - np.round(apart / step)), _MOST) < _WHOLE:
            return step if np.mean(off) > _ROUGH * step else 0.0
    return 0.0


def _refined(step: float, apart: Array) -> float:
    """From few steps to many, which tell it the closer."""
    for end in np.unique(np.geomspace(1, len(apart), _CLOSER).astype(int)):
        whole = np.maximum(np.round(apart[:end] / step), 1)
        step = float(apart[:end] @ whole / (whole @ whole))
    return step


def deviations(q: Array) -> Array:
    """Standard deviation (n) [rad, m] of what rounding to steps adds to positions (n x N) that cross many of them."""
    return steps(q) / sqrt(12)


def rounding(run: Prepared, scene: Scene, number: int = 0) -> Array:
    """Torques of rounding (n x rows) [N m, N] that the periods of a run have in common, as noise that they do not have
    would be: draw ``number`` for positions that cross many steps. Zero without steps, and where nothing repeats.
    """
    times = len(run.t) // run.period if run.period else 0
    rounded = deviations(scene.sampled.run.q) if times > 1 else np.zeros(1)
    if not rounded.any():
        return np.zeros_like(run.tau)
    return np.asarray(np.sqrt(times) * run.decimated(torque_of(drawn(scene, rounded, number), scene)))
