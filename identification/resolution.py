"""The steps in which sensors and converters tell a signal."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from generator.robot.description import Robot
from identification.arrays import Array
from identification.neighbours import ARITHMETIC, off_cubics
from identification.recording import Recording
from identification.signals import Measured, joint_torques

#: Part of a step within which most differences of rounded signals are whole steps, which part of them are most, and
#: how many there must be.
_WHOLE, _MOST, _COUNT = 0.02, 0.9, 100
#: Part of the differences that may be smaller than any rounding leaves.
_INTERPOLATED = 0.01
#: Steps that the smallest difference may be of, and times that a step is told more closely.
_SEVERAL, _CLOSER = 4, 12
#: Part of a step that rounded signals are off the cubics through their neighbours: positions of even accelerations
#: differ by whole numbers of something too, and are smooth.
_ROUGH = 0.1


@dataclass(frozen=True)
class Resolution:
    """Of recorded efforts their ``steps`` (n) in units of their own, zero without; they act on joints by ``acting``
    (n x n).
    """

    acting: Array
    steps: Array

    @property
    def of_joints(self) -> Array:
        """The largest step (n) [N m, N] of each joint's torque."""
        return np.asarray(np.max(np.abs(self.acting) * self.steps, axis=1))


def resolution(efforts: Measured, robot: Robot, recording: Recording) -> Resolution | None:
    """Of the efforts as they were recorded; None where none of them takes steps."""
    found = steps(efforts.values)
    if not found.any():
        return None
    one_each = replace(efforts, values=np.eye(len(found)))
    return Resolution(joint_torques(one_each, robot, recording), found)


def steps(x: Array) -> Array:
    """The step (n) to which recorded signals (n x N) are rounded, zero where there is none."""
    return np.array([_step(row) for row in x])


def _step(x: Array) -> float:
    arithmetic = ARITHMETIC * np.abs(x).max()
    # Samples that follow each other may all be many steps apart, where the signal is fast; some others are few.
    apart, gaps = (np.sort(one[one > arithmetic]) for one in (np.abs(np.diff(x)), np.diff(np.unique(x))))
    if len(apart) < _COUNT:
        return 0.0
    moves = np.diff(x) != 0
    among = moves[:-3] | moves[1:-2] | moves[2:-1] | moves[3:]
    off = np.abs(off_cubics(x))[among]
    # The smallest differences may be of samples that were interpolated; each may be of several steps.
    smallest = [one[k] for one in (apart, gaps) if len(one) for k in (int(_INTERPOLATED * len(one)), 0)]
    for least, several in product(smallest, range(1, _SEVERAL + 1)):
        step = _refined(least / several, apart[apart >= least])
        whole = np.quantile(np.abs(apart / step - np.round(apart / step)), _MOST) < _WHOLE
        if whole and np.mean(off) > _ROUGH * step:
            return step
    return 0.0


def _refined(step: float, apart: Array) -> float:
    """From few steps to many, which tell it the closer."""
    for end in np.unique(np.geomspace(1, len(apart), _CLOSER).astype(int)):
        whole = np.maximum(np.round(apart[:end] / step), 1)
        step = float(apart[:end] @ whole / (whole @ whole))
    return step
