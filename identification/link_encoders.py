"""Latency of link-side encoders, and what stiffness is left once it is removed, from runs of a robot that moves.

The link is where the motor is, less the drive train's twist; its encoder tells it T later:
q - qs = c + T qd + tau / k, tau what the drive train transmitted then. Latency times speed looks like the twist under
viscous friction, and mostly is far larger. So all that goes with the motor's own motion counts as latency, friction and
inertia of the motor (1, qd, sign qd, qdd), as does an eccentric encoder (sin q, cos q): k is what the remaining torque
shows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d

from generator.errors import InputError
from generator.robot.description import PRISMATIC, Joint, Robot
from identification.arrays import Array
from identification.colour import inflation
from identification.corrections import earlier
from identification.dataset import Run, load
from identification.drive_train import YIELDS
from identification.filtering import decimated, derivative, kept_rows, smoothed
from identification.outcome import LIMIT, Value
from identification.recipes import Filters, Recipe
from identification.residuals import Residual
from identification.run_filters import filters_of, notes_of
from identification.shared_samples import unshared
from identification.standstill import stands_throughout

RECIPE = Recipe()
#: Number of the speed's sign among twist, torque and what the motion makes of the twist.
_SIGN = 3
#: What the filtered sign of a speed may be off one where the joint neither stands nor turns back.
_ONE_WAY = 0.05
#: How far from the motor an encoder of the link may be beyond what a drive train yields, in parts of the joint's way.
_ASTRAY = 0.8
#: Longest latency [s] for which the torques of then are looked up, and how often.
_LONGEST, _ROUNDS = 0.2, 8
#: By how much a latency may change at the end, in parts of its standard deviation or of a sample.
_SETTLED, _SETTLED_STEP = 0.05, 1e-3
_UNSEEN = Value.unknown("s", "the joint's speed shows nothing beside its other motion")
_STANDS = Value.unknown("s", "the joint stands still")
_TOO_LATE = f"no latency up to {_LONGEST:g} s settles with the torque and the motion of then"
_NO_ROW = "no row is above the joint's standstill speed"


@dataclass(frozen=True)
class TwistRows:
    """Of one joint in all runs: ``twist`` q - qs (N) [rad, m], ``own`` columns of the motor's motion (N x p), those of
    speed first, ``constants`` of the runs (N x runs), ``torque`` (N) [N m, N].
    """

    twist: Array
    own: Array
    constants: Array
    torque: Array

    @property
    def condition(self) -> float:
        """Of the columns of motion, constants and torque at unit length; infinite where one is zero, or has no row."""
        if not len(self.torque):
            return np.inf
        return float(np.linalg.cond(_scaled(np.column_stack([self.own, self.constants, self.torque]))))

    def beside_motion(self) -> tuple[Array, Array]:
        """What the motor's motion and the runs' constants cannot explain of the twist and of the torque (N each)."""
        others = np.column_stack([self.own, self.constants])
        return _left(self.twist, others), _left(self.torque, others)


@dataclass(frozen=True)
class LinkEncoders:
    """By name: ``latency`` [s] and ``stiffness`` k of the joints with a link-side encoder.

    ``mistaken`` is what k would be if q - qs was all twist. ``residuals`` are of q - qs [rad, m] and ``rows`` those of
    the fit, by joint (from 0).
    """

    robot: Robot
    runs: tuple[tuple[Run, Filters], ...]
    latency: Mapping[str, Value]
    stiffness: Mapping[str, Value]
    mistaken: Mapping[str, Value]
    residuals: Mapping[int, Residual]
    rows: Mapping[int, TwistRows]
    notes: tuple[str, ...]

    @property
    def values(self) -> dict[str, Value]:
        """All that was found, by name."""
        return {**self.stiffness, **self.latency}


def link_encoders(
    robot: Robot, sources: Sequence[str], friction: Mapping[str, float] | None = None, recipe: Recipe = RECIPE
) -> LinkEncoders:
    """Values from the runs ``sources`` with columns qs of some joints at least.

    ``friction`` holds Fvm or Fv by name [SI]: torque that is lost before the drive train twists, so that Fv/k is
    missing in the speed's coefficient.

    Raises InputError for runs that are too short, without link-side encoders, in which one does not go where its motor
    goes, or in which no such joint moves.
    """
    runs = [load(str(source), robot, recipe.columns) for source in sources]
    for run in runs:
        for k, joint in enumerate(robot.moving):
            _check(run, k, joint)
    found = of_runs(robot, runs, friction, recipe)
    place = found.runs[0][0].place
    if not found.latency:
        names = f"qs{robot.moving[0].number} to qs{robot.moving[-1].number}, any of them"
        raise InputError(place, "there are no columns of link-side encoders", names)
    if not any(len(rows.twist) for rows in found.rows.values()):
        raise InputError(place, "no joint with a link-side encoder moves", "rows above its standstill speed")
    return found


def of_runs(
    robot: Robot, runs: Sequence[Run], friction: Mapping[str, float] | None = None, recipe: Recipe = RECIPE
) -> LinkEncoders:
    """As ``link_encoders``, from runs that have been read."""
    unshared({"fit": runs})
    filters = [filters_of(run, recipe) for run in runs]
    latency, stiffness, mistaken, residuals, kept = {}, {}, {}, {}, {}
    notes = [note for run in runs for note in notes_of(run, recipe)]
    for k, joint in enumerate(robot.moving):
        mine = [(run, one) for run, one in zip(runs, filters, strict=True) if f"qs{joint.number}" in run.others]
        if not mine:
            continue
        standstill, name = float(recipe.standstills(robot)[k]), f"k{joint.number}"
        viscous = _viscous(joint, friction or {})
        at_once = _rows(mine, k, joint, standstill, 0.0)
        kept[k], (stiffness[name], late, residuals[k]) = _of_then(at_once, mine, k, joint, standstill, viscous)
        seen = late.refused or np.isfinite(late.std)
        latency[f"latency{joint.number}"] = _STANDS if _stands(mine, k) else late if seen else _UNSEEN
        mistaken[name] = _inverse(*_last(at_once.twist, at_once.constants, at_once.torque), stiffness[name].unit)
        seen_late = latency[f"latency{joint.number}"].value is not None
        if seen_late and (unknown := _lacking(stiffness[name], viscous)):
            notes.append(f"latency{joint.number} lacks Fv{joint.number}/{name}: {unknown}")
    found = tuple(zip(runs, filters, strict=True))
    return LinkEncoders(robot, found, latency, stiffness, mistaken, residuals, kept, tuple(notes))


def astray(run: Run, k: int, joint: Joint) -> float:
    """How far the link-side encoder of a joint, coordinate k, is from its motor, in parts of how far the joint goes;
    zero where that is what a drive train yields, the encoder is late, or there is none.
    """
    qs = run.others.get(f"qs{joint.number}")
    if qs is None:
        return 0.0
    way, apart = float(run.q[k].std()), float((run.q[k] - qs).std())
    return apart / way if way > 0 and apart > max(_ASTRAY * way, YIELDS) else 0.0


def _check(run: Run, k: int, joint: Joint) -> None:
    if apart := astray(run, k, joint):
        name, unit = f"qs{joint.number}", joint.position_unit
        problem = f"{name} differs from the motor's position by {100 * apart:.0f} % of how far the joint goes"
        expected = f"the position of link {joint.number} in {unit}, with the joint's sign, at most {_LONGEST:g} s late"
        raise InputError(run.place, problem, expected)


def _of_then(
    at_once: TwistRows,
    runs: Sequence[tuple[Run, Filters]],
    k: int,
    joint: Joint,
    standstill: float,
    viscous: float | None,
) -> tuple[TwistRows, tuple[Value, Value, Residual]]:
    """Rows with torque and motion of then, and what they tell, beginning with those ``at_once``; refused where no
    latency that is not too long is told by rows of its own.
    """
    rows, told = at_once, _told(at_once, joint, viscous)
    if _stands(runs, k):
        return rows, told
    ago, least = 0.0, _SETTLED_STEP * runs[0][0].period
    for rounds in range(_ROUNDS + 1):
        late = told[1]
        if late.value is None or abs(late.value - ago) <= max(_SETTLED * late.std, least):
            return rows, told
        if abs(late.value) > _LONGEST or rounds == _ROUNDS:
            break
        ago = late.value
        rows = _rows(runs, k, joint, standstill, ago)
        told = _told(rows, joint, viscous)
    stiffness, late = (Value.unknown(unit, _TOO_LATE) for unit in (joint.stiffness_unit, "s"))
    return rows, (stiffness, late, told[2])


def _stands(runs: Sequence[tuple[Run, Filters]], k: int) -> bool:
    """Whether a joint stands in all runs: its speed is noise, and tells no latency."""
    return all(stands_throughout(run.q[k]) for run, _ in runs)


def _rows(runs: Sequence[tuple[Run, Filters]], k: int, joint: Joint, standstill: float, ago: float) -> TwistRows:
    """Without torques that are cut off and, of a joint that moves, without what is near a standstill [rad/s, m/s]:
    what sticks hides from the twist any torque up to its friction.

    An encoder that is late tells where the link was so long ``ago`` [s]: the torque that twisted the drive train, what
    the motion took of it, and the eccentricity are those of then, the speed is the mean since.
    """
    parts = []
    for number, (run, filters) in enumerate(runs):
        q, qs, torque = (
            smoothed(x, filters.order, filters.cutoff, run.rate)
            for x in (run.q[k], run.others[f"qs{joint.number}"], run.tau[k])
        )
        then, torque = earlier(np.stack([q, torque]), (-ago, -ago), run.period)
        qd = derivative(then, run.period)
        own = [(q - then) / ago if ago else qd, np.sign(qd), derivative(qd, run.period)]
        if joint.sigma != PRISMATIC:
            own += [np.sin(then), np.cos(then)]
        inner = filters.inner(run.samples)
        columns = decimated(np.stack([q - qs, torque, *own])[:, inner], filters.factor)
        bad = _bad(run, k, ceil(abs(ago) / run.period))
        turning = np.zeros(columns.shape[1], dtype=bool)
        if not stands_throughout(run.q[k]):
            bad = bad | (np.abs(qd) <= standstill)
            turning = np.abs(np.abs(columns[_SIGN]) - 1) >= _ONE_WAY
        columns = columns[:, kept_rows(bad[inner], filters.factor) & ~turning]
        constants = np.zeros((len(runs), columns.shape[1]))
        constants[number] = 1.0
        parts.append(np.concatenate([columns, constants]))
    joined = np.concatenate(parts, axis=1)
    count = len(runs)
    return TwistRows(joined[0], joined[2:-count].T, joined[-count:].T, joined[1])


def _bad(run: Run, k: int, steps: int) -> NDArray[np.bool_]:
    """Samples (N) within so many ``steps`` of a torque that was cut off or lost, or of an end of the recording."""
    unusable = np.zeros(run.samples, dtype=bool) if run.unusable is None else run.unusable[k]
    around = np.pad(unusable, steps, constant_values=True)
    return np.asarray(maximum_filter1d(around, 2 * steps + 1)[steps : len(around) - steps])


def _told(rows: TwistRows, joint: Joint, viscous: float | None) -> tuple[Value, Value, Residual]:
    """Stiffness and latency, and what both leave; without torque where it shows no stiffness."""
    if not len(rows.twist):
        stiffness, latency = (Value.unknown(unit, _NO_ROW) for unit in (joint.stiffness_unit, "s"))
        return stiffness, latency, Residual(0, 0.0, 0.0, 0.0)
    moved = np.column_stack([rows.own[:, 1:], rows.constants, rows.own[:, 0]])
    compliance = _last(rows.twist, moved, rows.torque)
    stiffness = _stiffness(*compliance, joint)
    others, columns = np.column_stack([rows.own[:, 1:], rows.constants]), rows.own[:, 0]
    if stiffness.value is not None:
        # What viscous friction takes of the torque twists no drive train.
        others = np.column_stack([others, rows.torque - (viscous or 0.0) * columns])
    late, std = _last(rows.twist, others, columns)
    every = np.column_stack([others, columns])
    e = _left(rows.twist, every)
    size = float(np.linalg.norm(rows.twist))
    spread = float(np.linalg.norm(rows.twist - rows.twist.mean())) if rows.twist.size else 0.0
    return stiffness, Value(late, std, "s"), Residual(len(e), float(np.linalg.norm(e)), size, spread)


def _lacking(stiffness: Value, viscous: float | None) -> str:
    """Why a latency lacks what viscous friction makes of it; empty where it has that, or where neither is known."""
    if stiffness.value is None:
        return "" if viscous is None else "the stiffness is not known"
    return "no viscous friction was given" if viscous is None else ""


def _last(y: Array, others: Array, x: Array) -> tuple[float, float]:
    """The coefficient of x beside those of ``others`` in least squares, and its std for residuals coloured as found.

    By what is left of y and x without the others (Frisch and Waugh 1933); infinite std where nothing is.
    """
    scaled = _scaled(others)
    left = _left(x, others)
    power = float(left @ left)
    if power <= 1e-12 * float(x @ x):
        return 0.0, np.inf
    value = float(left @ y) / power
    every = np.column_stack([scaled, left / np.sqrt(power)])
    e = _left(y, every)
    variance = float(e @ e) / max(len(y) - every.shape[1], 1) * inflation(e)
    return value, float(np.sqrt(variance / power))


def _left(y: Array, others: Array) -> Array:
    """What least squares with the columns ``others`` leave of y."""
    scaled = _scaled(others)
    return np.asarray(y - scaled @ np.linalg.lstsq(scaled, y, rcond=None)[0])


def _scaled(columns: Array) -> Array:
    """Columns of unit length; zero stays zero."""
    return np.asarray(columns / np.maximum(np.linalg.norm(columns, axis=0), np.finfo(float).tiny))


def _stiffness(compliance: float, std: float, joint: Joint) -> Value:
    """1/compliance, refused where it is not positive or not sure."""
    unit = joint.stiffness_unit
    if not np.isfinite(std):
        return Value.unknown(unit, "nothing is left of the torque beside the motor's own motion")
    relative = std / abs(compliance) if compliance else np.inf
    if relative > LIMIT:
        why = f"what the latency leaves shows it with a relative std of {100 * relative:.3g} %"
        return Value.unknown(unit, why)
    if compliance < 0:
        return Value.unknown(unit, "the link moves against the torque; is the encoder's sign wrong?")
    return _inverse(compliance, std, unit)


def _inverse(compliance: float, std: float, unit: str) -> Value:
    """The stiffness, however unsure it is."""
    if not compliance:
        return Value.unknown(unit, "no twist goes with the torque")
    return Value(1 / compliance, std / compliance**2, unit)


def _viscous(joint: Joint, friction: Mapping[str, float]) -> float | None:
    return friction.get(f"Fvm{joint.number}", friction.get(f"Fv{joint.number}"))
