"""Runs: what a robot's controller recorded, checked, on the joint side, in SI units, at one rate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from generator.errors import InputError, Place
from generator.robot.description import Robot
from identification import checks, corrections, cut_off, glitches, readers, sidecar, stale_rows
from identification.arrays import Array
from identification.drive_train import driven
from identification.formula import Formula, renamed
from identification.recording import Recording
from identification.resolution import Resolution, resolution
from identification.run_source import RunSource
from identification.sidecar import Payload
from identification.signals import (
    EFFORTS,
    FURTHER,
    POSITIONS,
    WRENCH,
    Measured,
    joint_positions,
    joint_torques,
    measured,
    numbered,
    overlooked,
    sound,
)
from identification.timing import Clock, clock, jitters


@dataclass(frozen=True)
class Run:
    """One run of n joints and N samples, samples along the last axis.

    ``q`` [rad, m] and ``tau`` [N m, N] are on the joint side (n x N); ``start`` and ``period`` in s. ``empty`` tells
    that the run is known to carry no payload. ``unusable`` marks samples that were lost or whose effort was cut off.
    ``by_motors`` tells that both were recorded on the motor side and brought over by the file's ratios. ``warmth`` of
    the drives (n x N) is there where the robot file says it. ``others`` are the file's further columns of known meaning
    by name (N each). ``began`` are the time ``t`` and the temperatures with which the recording began that the run is a
    part of, the run's own where they are not given, and ``since_cold`` is how long before that the drives were set in
    motion, cold [s]. ``notes`` tell every repair. ``coarse`` is how the efforts of cold drives were rounded in the
    record, None where they take no steps.
    """

    name: str
    place: Place
    start: float
    period: float
    q: Array
    tau: Array
    payload: Payload | None = None
    empty: bool = False
    unusable: NDArray[np.bool_] | None = None
    by_motors: bool = False
    warmth: Array | None = None
    others: Mapping[str, Array] = field(default_factory=dict)
    began: Mapping[str, float] = field(default_factory=dict)
    since_cold: float = 0.0
    sha256: str = ""
    notes: tuple[str, ...] = ()
    coarse: Resolution | None = None

    @property
    def file(self) -> str:
        """The file's name, without folders and without the part that was taken."""
        return RunSource.of(self.name).path.name

    @property
    def is_part(self) -> bool:
        """Whether it is a part of what the file holds."""
        return RunSource.of(self.name).is_part

    @property
    def samples(self) -> int:
        """N."""
        return int(self.q.shape[-1])

    @property
    def length(self) -> float:
        """From the first sample to the last [s]."""
        return (self.samples - 1) * self.period

    @property
    def duration(self) -> float:
        """Time that its samples stand for [s]."""
        return self.samples * self.period

    @property
    def rate(self) -> float:
        """Samples per second [Hz]."""
        return 1 / self.period

    @property
    def elapsed(self) -> Array:
        """Time since the recording began [s] (N)."""
        return self.start - self.began.get("t", self.start) + self.period * np.arange(self.samples, dtype=float)

    @property
    def warming(self) -> Array:
        """Time for which the drives have been getting warm [s] (N)."""
        return self.since_cold + self.elapsed

    @property
    def rises(self) -> dict[str, Array]:
        """Of the temperatures ``temp1`` ... since the recording began [K] (N each)."""
        temperatures = {name: values for name, values in self.others.items() if name.startswith("temp")}
        return {name: values - self.began.get(name, values[0]) for name, values in temperatures.items()}

    def carrying(self, payload: Payload | None) -> Run:
        """The same run with ``payload`` where nothing tells yet whether it carries one."""
        return self if self.empty or self.payload is not None else replace(self, payload=payload)


def load(
    source: str,
    robot: Robot,
    columns: Mapping[str, Formula] | None = None,
    efforts: Sequence[str] = EFFORTS,
    resting: bool = False,
) -> Run:
    """The run that ``source`` names: a path, or ``PATH@FROM:TO`` (``run_source``).

    ``columns`` are formulas for a file with names of its own; each is used where the file lacks what it makes and has
    what it and those of the same signal of other joints need. A sidecar's come on top. ``efforts`` are the stems that
    will do, the first one present is taken. ``resting`` says that the robot may stand on purpose. What section
    ``signals`` of the robot file says is applied.

    Raises InputError, with file and row, for everything that would make the result wrong.
    """
    named = RunSource.of(source)
    recording = readers.read(named.path)
    beside = sidecar.read(named.path)
    if beside.robot and beside.robot != robot.name:
        place = Place(str(sidecar.path_of(named.path)))
        raise InputError(place, f"this is a run of {beside.robot}", f"one of {robot.name}")
    wanted = {name: one for name, one in (columns or {}).items() if name not in recording.columns}
    lacking = {_signal(name) for name, one in wanted.items() if not _possible(one, recording)}
    wanted = {name: one for name, one in wanted.items() if _signal(name) not in lacking}
    recording = numbered(sound(renamed(renamed(recording, wanted), beside.columns)), robot)
    recorded = _recorded(source, named.rows_of(recording), robot, efforts, resting)
    known = replace(
        recorded,
        payload=beside.payload,
        empty=beside.empty,
        since_cold=beside.since_cold,
        began=_beginning(recording, robot),
    )
    return _corrected(known, robot)


def _signal(column: str) -> str:
    """What a column is of its joint: ``tau`` of ``tau2``."""
    return column.rstrip("0123456789")


def _possible(formula: Formula, recording: Recording) -> bool:
    there = {*recording.columns, *recording.faults}
    return all(symbol.name in there for symbol in formula.expression.free_symbols)


def _beginning(recording: Recording, robot: Robot) -> dict[str, float]:
    """Time and temperatures in the first row, by column; raises InputError where one is no number, though the run may
    begin later.
    """
    names = ("t", *(f"temp{number}" for number in robot.numbers))
    told = {name: recording.columns[name][:1] for name in names if len(recording.columns.get(name, ()))}
    checks.finite([*told.items()], recording.where)
    return {name: float(values[0]) for name, values in told.items()}


def _recorded(source: str, recording: Recording, robot: Robot, efforts: Sequence[str], resting: bool) -> Run:
    """The run of a recording, checked, repaired, brought to the joints and to even times."""
    where = recording.where
    at = measured(recording, POSITIONS, robot, "positions")
    effort = measured(recording, efforts, robot, "efforts")
    others = {name: values for name, values in recording.columns.items() if _known(name, robot)}
    _check_numbers(recording, at, effort, others)
    stale_rows.live(at, effort, where)
    ticks = clock(recording)
    _check_positions(at, ticks, robot, recording, resting)
    ticks, at, of_positions = _without_jitter(at, ticks, robot, recording)
    checks.whole(at, where)
    coarse = resolution(effort, robot, recording)
    effort, of_efforts = glitches.without(effort, ticks, where)
    q = _true_positions(at, robot, recording)
    cut = cut_off.stretches(effort, q, where, resting)
    tau = joint_torques(effort, robot, recording)
    unusable = cut_off.marks(cut, tau.shape)
    if unusable is not None and effort.stem != "tau":
        unusable = driven(robot, unusable)
    told = [*cut_off.told(cut, effort, where), *stale_rows.slower(effort, where), *of_positions, *of_efforts]
    told += overlooked(recording, robot)
    run = Run(
        source,
        where(None, "t"),
        ticks.start,
        ticks.period,
        q,
        tau,
        unusable=unusable,
        by_motors=at.stem == "qm" and effort.stem != "tau",
        others=others,
        sha256=recording.sha256,
        notes=(*recording.notes, *told),
        coarse=coarse,
    )
    return _evened(run, ticks)


def _known(name: str, robot: Robot) -> bool:
    """Whether a column's name has a meaning beside the positions and efforts."""
    return name in WRENCH or any(name == f"{stem}{joint.number}" for stem in FURTHER for joint in robot.moving)


def _check_numbers(recording: Recording, at: Measured, effort: Measured, others: Mapping[str, Array]) -> None:
    """Raises InputError where a column that is used holds what is no number of a sensor."""
    named = [(name, values) for one in (at, effort) for name, values in zip(one.names, one.values, strict=True)]
    times = [("t", recording.columns["t"])] if "t" in recording.columns else []
    checks.finite([*times, *named, *others.items()], recording.where)


def _check_positions(at: Measured, ticks: Clock, robot: Robot, recording: Recording, resting: bool) -> None:
    """Raises InputError where positions cannot be those of the joints, or are in another order than what goes with
    them.
    """
    q = _true_positions(at, robot, recording)
    checks.positions(q, at, robot, ticks, recording.where, resting)
    for stem in ("qs", "qr"):
        if at.stem == "q" and all(f"{stem}{joint.number}" in recording.columns for joint in robot.moving):
            checks.order(q, at, measured(recording, (stem,), robot, "positions"), recording.where)


def _true_positions(at: Measured, robot: Robot, recording: Recording) -> Array:
    """Of the joints (n x N) [rad, m]."""
    return corrections.true_positions(joint_positions(at, robot, recording), robot)


def _without_jitter(
    at: Measured, ticks: Clock, robot: Robot, recording: Recording
) -> tuple[Clock, Measured, list[str]]:
    """The times, even where positions are smoother so; positions without glitches; and what is to be told."""
    where = recording.where
    clean, notes = glitches.without(at, ticks, where)
    if not jitters(ticks, joint_positions(clean, robot, recording)):
        return ticks, clean, notes
    clean, notes = glitches.without(at, ticks.steady, where)
    jitter = f"{where(None, 't')}: times jitter; positions are smoother at even ones, which were taken"
    return ticks.steady, clean, [jitter, *notes]


def _evened(run: Run, ticks: Clock) -> Run:
    """The run with a sample at each even time, those of which there is no row unusable."""
    how = _uneven(ticks)
    if not how:
        return run
    return replace(
        run,
        q=_splined(ticks, run.q),
        tau=_splined(ticks, run.tau),
        unusable=_left_out(ticks, run.unusable, len(run.tau)),
        others={name: _splined(ticks, values) for name, values in run.others.items()},
        notes=(*run.notes, f"{run.place}: {how}; samples were interpolated to {ticks.rate:.6g} Hz"),
    )


def _uneven(ticks: Clock) -> str:
    """What times are beside even and complete, in words; empty where they are both."""
    lost = ticks.lost
    uneven = ["times are uneven"] if ticks.uneven else []
    gone = [f"{int(lost.sum())} of {len(lost)} samples are missing"] if lost.any() else []
    return " and ".join([*uneven, *gone])


def _splined(ticks: Clock, x: Array) -> Array:
    """Samples at even times, by a cubic spline through the rows."""
    result: Array = make_interp_spline(ticks.t, x, k=min(3, len(ticks.t) - 1), axis=-1)(ticks.even)
    return result


def _left_out(ticks: Clock, unusable: NDArray[np.bool_] | None, n: int) -> NDArray[np.bool_] | None:
    """Samples (n x N) that are lost, or whose row is ``unusable``; None without any."""
    result = np.tile(ticks.lost, (n, 1))
    if unusable is not None:
        result[:, ticks.sample] = unusable
    return result if result.any() else None


def _corrected(run: Run, robot: Robot) -> Run:
    """The run with its torques and further columns as they truly were, and with the warmth of the drives."""
    warmth = corrections.warmth(run.rises, run.warming, run.tau, robot, run.place)
    marks = [one for one in (run.unusable, corrections.saturated(run.tau, robot)) if one is not None]
    unusable = None
    if marks:
        # A lost sample lacks its position as well, which no delay moves.
        bad = np.logical_or.reduce(marks)
        unusable = corrections.moved(bad, robot, run.period) | bad
    tau = corrections.true_torques(run.tau, robot, run.period, warmth)
    others = corrections.true_links(run.others, robot, run.period)
    coarse = run.coarse
    if coarse is not None:
        coarse = replace(coarse, acting=corrections.cold_torques(coarse.acting, robot))
    kept = corrections.whole(run.samples, robot, run.period)
    return replace(
        run,
        start=run.start + run.period * kept.start,
        q=run.q[:, kept],
        tau=tau[:, kept],
        unusable=None if unusable is None else unusable[:, kept],
        warmth=None if warmth is None else warmth[:, kept],
        others={name: values[kept] for name, values in others.items()},
        coarse=coarse,
    )
