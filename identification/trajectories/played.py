"""A motion from a run file, such as ``counterpoise excite`` writes: its reference is played again."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

from generator.errors import InputError
from identification import checks, readers
from identification.arrays import Array
from identification.corrections import true_positions
from identification.recording import Recording
from identification.signals import measured, sound
from identification.timing import clock
from identification.trajectory import Reference, Setting, Task, Trajectory, Unplanned, Value, ends_of

#: Columns that are played, the first that the file has.
_STEMS = ("qr", "q")
#: Speed at the start, in parts of the largest one, that is rest.
_REST = 0.01
#: Speed [rad/s, m/s] that is rounding.
_STANDS = 1e-9
#: Degree of the spline through the positions.
_CUBIC = 3


def _plan(task: Task) -> Reference:
    """A cubic spline through the file's positions, which are recorded ones; after its end the robot rests.

    Raises InputError, with file and row, for a file without positions or times, and for positions beyond the limits.
    """
    recording = _read(task.settings)
    found = measured(recording, _STEMS, task.robot, "positions")
    checks.finite([*zip(found.names, found.values, strict=True)], recording.where)
    ticks = clock(recording)
    if found.values.shape[1] <= _CUBIC:
        raise Unplanned(f"{recording.file} has {found.values.shape[1]} rows", f"{_CUBIC + 1} at least")
    true = true_positions(found.values, task.robot)
    _inside(task, recording, found.names, true)
    t = recording.columns["t"] - ticks.start
    motion = make_interp_spline(t, true, axis=1)
    within = task.times <= t[-1]
    at = np.minimum(task.times, t[-1])
    q, qd = motion(at), np.where(within, motion.derivative()(at), 0.0)
    if (np.abs(qd[:, 0]) > max(_REST * np.abs(qd).max(), _STANDS)).any():
        raise Unplanned(f"{recording.file} does not begin at rest", "speeds of zero at the start")
    return Reference(q.T, qd.T)


def _length(settings: Mapping[str, Value]) -> float:
    """Time [s] from the file's first row to its last."""
    t = clock(_read(settings)).t
    return float(t[-1] - t[0])


def _read(settings: Mapping[str, Value]) -> Recording:
    file = str(settings["file"])
    if not file:
        raise Unplanned("no file is played", "--set file=RUN")
    return sound(readers.read(Path(file)))


def _inside(task: Task, recording: Recording, names: tuple[str, ...], q: Array) -> None:
    for k, name in enumerate(names):
        lower, upper = ends_of(task.robot, k)
        beyond = np.flatnonzero((q[k] < lower) | (q[k] > upper))
        if beyond.size:
            row = int(beyond[0])
            there = f"{name} with its position_offset" if task.robot.signals.position_offset else name
            problem = f"{there} is {q[k, row]:.6g}"
            raise InputError(recording.where(row, name), problem, f"a position from {lower:.4g} to {upper:.4g}")


TRAJECTORY = Trajectory(
    name="played",
    title="the reference qr1, qr2, .. of a run file, else its positions",
    settings={"file": Setting("", "a run file", file=True)},
    plan=_plan,
    length=_length,
)
