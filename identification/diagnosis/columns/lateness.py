"""How late torques are recorded: the rows of each motor fitted by themselves at every delay.

What swings is another torque a quarter of its period later, and a model fitted without the delay has too little of it:
neither tells the delay. Fitted at the right one a motor's rows leave least, whatever it swings by. What is known of
parameters beforehand is not asked. Of motors whose rows are too few by themselves one delay may still be told: all
motors are fitted at once at every one that they may have in common.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from scipy.interpolate import CubicSpline

from identification.arrays import Array
from identification.colour import inflation
from identification.diagnosis.columns.bank import base_rows
from identification.diagnosis.columns.normal_equations import Places, inverse
from identification.diagnosis.runs.prepared import window, windowed
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import coupling, supplied
from identification.outcome import Value

#: Longest delay [s] either way that a drive's sampling explains, and the part of the shortest run that it may be.
LONGEST, _OF_RUN = 0.1, 0.05
#: Delays that are tried are so far apart [s], and one is told to such a part of that.
_STEP, _TOLD = 1e-3, 0.1
#: What a delay must leave of the sum of squares to be told by it.
_LESS = 0.97
#: Of a delay of several motors: how many must tell it, what it leaves of the squares of each that does, and its least
#: part of what delays of their own would explain.
_SEVERAL, _EACH, _SHARED = 2, 0.985, 0.5
#: Difference of cost that is chance, in parts of the square root of the rows, and its most, in parts of the rows and of
#: what the best delay explains; and its standard deviations.
_CHANCE, _OF_ROWS, _OF_GAIN, _DEVIATIONS = 4.0, 0.1, 0.5, 4.0
#: Least rows for each base parameter, and of a motor fitted with others; least singular value of scaled columns.
_ROWS, _AMONG, _RANK = 5, 2, 1e-6
#: Rows within each that is taken elsewhere.
_CLOSE = 2
#: How far from a delay it may be told more closely, in parts of it.
_NEAR = 0.3
#: Times that motors fitted at once are weighed by what each leaves.
_WEIGHED = 4
#: Part of a torque's square that is rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Lateness:
    """Of one motor's ``rows``: ``values`` (p x D) of the base parameters ``names``, and the sums of squares ``left``
    (D), where its torque is late by ``delays`` [s] (D). What the best one leaves tells of it as so many white rows
    would of ``colour`` times the variance.
    """

    delays: Array
    names: tuple[str, ...]
    values: Array
    left: Array
    rows: int
    colour: float

    @property
    def cost(self) -> Array:
        """Twice the negative logarithm of the likelihood (D), but for a constant: the noise's power is not known."""
        return np.asarray(self.rows * np.log(self.left))

    def at(self, delay: float) -> dict[str, float]:
        """Base parameters by name, where the torque is late by ``delay`` [s]."""
        pairs = zip(self.names, self.values, strict=True)
        return {name: float(np.interp(delay, self.delays, row)) for name, row in pairs}


def delay_of(among: Sequence[Lateness | None], start: float = 0.0) -> Value | None:
    """The one delay of some motors beyond ``start`` [s], where it leaves less; None where none does, where it is none
    as closely as it may be told, or it is not one of several motors.
    """
    known = [one for one in among if one is not None]
    if not known:
        return None
    delays, cost = known[0].delays, np.sum([one.cost for one in known], axis=0)
    least = _nearest(delays - start, cost, sum(one.rows for one in known))
    now = np.array([float(CubicSpline(delays, one.cost)(start)) for one in known])
    gains = now - [one.cost[least] for one in known]
    most = np.sum(now - [one.cost.min() for one in known])
    telling = sum(gain > one.rows * -np.log(_EACH) for gain, one in zip(gains, known, strict=True))
    enough = max(sum(one.rows for one in known) * -np.log(_LESS), _SHARED * most, _taken(known))
    if not 0 < least < len(delays) - 1 or telling < min(len(among), _SEVERAL) or np.sum(gains) < enough:
        return None
    found = _between(known, least)
    if found is None or found.value is None or abs(found.value - start) < _TOLD * (delays[1] - delays[0]):
        return None
    return replace(found, value=found.value - start)


def closer(among: Sequence[Lateness | None], about: float) -> Value | None:
    """The one delay of motors that were fitted at once, where they leave least next to ``about`` [s]; None where they
    leave less far from it.
    """
    known = [one for one in among if one is not None]
    if not known:
        return None
    cost = np.sum([one.cost for one in known], axis=0)
    inner = np.flatnonzero((cost[1:-1] <= cost[:-2]) & (cost[1:-1] <= cost[2:])) + 1
    least = min(inner.tolist(), key=lambda k: abs(known[0].delays[k] - about), default=0)
    far = abs(known[0].delays[least] - about) > max(_NEAR * abs(about), _STEP)
    return None if far or not least else _between(known, least)


def _between(known: Sequence[Lateness], least: int) -> Value | None:
    """The delay of some motors about the one of those tried at which they leave ``least``; None where none is."""
    # Squares bend as those of a sine do; their logarithm has a sharper tip.
    squares = np.array([one.rows * one.left / one.left[least] for one in known])
    bends = np.diff(squares[:, least - 1 : least + 2], 2)[:, 0]
    if not bends.sum() > 0:
        return None
    delays = known[0].delays
    step = delays[1] - delays[0]
    variance = 2 * np.maximum(bends, 0.0) @ [one.colour for one in known] / bends.sum() ** 2
    slope = CubicSpline(delays, squares.sum(axis=0)).derivative()
    level = slope.roots(extrapolate=False)
    delay = min(
        level[np.abs(level - delays[least]) < step], key=lambda x: abs(x - delays[least]), default=delays[least]
    )
    return Value(float(delay), float(step * np.hypot(np.sqrt(variance), _TOLD)), "s")


def _taken(among: Sequence[Lateness]) -> float:
    """By how much costs of two delays may differ by chance: parameters of each motor take as many rows' worth of noise,
    the more unlike the longer it lasts, of another part of it at every delay.
    """
    return _DEVIATIONS * float(np.sqrt(sum(4 * len(one.names) * one.colour for one in among)))


def _nearest(beyond: Array, cost: Array, rows: int) -> int:
    """Of the delays that leave least nearby, and whose ``cost`` is the least but for chance, the place of the shortest.

    Those that are a period of a swing apart see other noise: what they cost differs by it. Of few rows all would be
    chance; half of what the best one explains is none.
    """
    gain = float(np.interp(0.0, beyond, cost) - cost.min())
    chance = min(_CHANCE * np.sqrt(rows), _OF_ROWS * rows, _OF_GAIN * gain)
    inner = np.flatnonzero((cost[1:-1] <= cost[:-2]) & (cost[1:-1] <= cost[2:])) + 1
    among = [k for k in inner.tolist() if cost[k] - cost.min() < chance]
    return min(among, key=lambda k: abs(beyond[k]), default=int(np.argmin(cost)))


@dataclass(frozen=True)
class Latenesses:
    """Of each motor along the runs: ``own`` of its rows by themselves, None where they are too few."""

    delays: Array
    motors: Sequence[_Motor]
    own: Sequence[Lateness | None]

    @property
    def shared(self) -> Sequence[Lateness | None]:
        """As late as all others: ``own`` where several have rows enough, else ``together``."""
        known = sum(late is not None for late in self.own)
        return self.own if known >= min(len(self.own), _SEVERAL) else self.together

    @cached_property
    def together(self) -> Sequence[Lateness | None]:
        """By all rows at once; None where these are too few."""
        return _together(self.delays, self.motors)


def latenesses(scenes: Sequence[Scene]) -> Latenesses:
    """How late motors are along the runs of ``scenes``."""
    last = int(min(LONGEST, _OF_RUN * min(scene.motion.samples * scene.period for scene in scenes)) / _STEP)
    delays: Array = _STEP * np.arange(-last, last + 1, dtype=float)
    runs = [_Run(scene, delays) for scene in scenes]
    motors = [_rows(runs, k) for k in range(len(scenes[0].robot.moving))]
    return Latenesses(delays, motors, [_fitted(delays, motor) for motor in motors])


def torques(scene: Scene, late: Sequence[Lateness | None], delays: Sequence[float], motors: Sequence[int]) -> Array:
    """Torques along the motion (n x N) [N m, N], before each motor's of ``delays`` [s] (n): of some ``motors`` by the
    fit of their ``late`` rows at it, of the others and of those without such rows by the model.
    """
    tau = scene.torque.copy()
    for k in motors:
        if (one := late[k]) is not None:
            own = scene.torque_of({**scene.values, **one.at(delays[k])}, scene.motion)
            tau += supplied(scene.robot, k, own - scene.model_torque)
    return tau


@dataclass(frozen=True)
class _Motor:
    """Base columns ``W`` (p x N) of motor k's kept rows and its torque ``Y`` by each delay (D x N) [N m, N].

    The columns are those of the base parameters ``numbers``, called ``names``. A row tells a ``part`` of what one would
    that shares no sample with others.
    """

    k: int
    numbers: list[int]
    names: tuple[str, ...]
    W: Array
    Y: Array
    part: float

    @property
    def rows(self) -> int:
        """Rows that share no sample, of which there are as many."""
        return int(self.part * self.W.shape[1])

    @property
    def acts(self) -> bool:
        return bool(self.W.size) and bool(self.Y.any())


def _rows(runs: Sequence[_Run], k: int) -> _Motor:
    """Of motor k in all runs."""
    numbers = runs[0].numbers(k)
    W, Y = (np.concatenate(parts, axis=1) for parts in zip(*(run.rows(k) for run in runs), strict=True))
    names = tuple(runs[0].scene.regressors.names[number] for number in numbers)
    return _Motor(k, numbers, names, W, Y, runs[0].part)


def _fitted(delays: Array, motor: _Motor) -> Lateness | None:
    """By its own rows."""
    W, Y = motor.W, motor.Y
    if not motor.acts or motor.rows < _ROWS * len(W):
        return None
    size = np.linalg.norm(W, axis=1)
    size[size == 0] = 1.0
    left, values, right = np.linalg.svd(W / size[:, None], full_matrices=False)
    seen = values > _RANK * values.max()
    parts = right[seen] @ Y.T
    solution = (left[:, seen] / values[seen]) @ parts / size[:, None]
    power = np.sum(Y**2, axis=1)
    squares = np.maximum(power - np.sum(parts**2, axis=0), _ROUNDING * power.max())
    best = int(np.argmin(squares))
    colour = motor.part * inflation(Y[best] - parts[:, best] @ right[seen])
    return Lateness(delays, motor.names, solution, squares, motor.rows, colour)


def _together(delays: Array, motors: Sequence[_Motor]) -> list[Lateness | None]:
    """By all rows at once, each motor weighed by what it leaves; None of those whose few rows fit whatever acts."""
    acting = [motor for motor in motors if motor.acts and motor.rows >= _AMONG * len(motor.W)]
    numbers = sorted({number for motor in acting for number in motor.numbers})
    if sum(motor.rows for motor in acting) < max(_ROWS * len(numbers), 1):
        return [None] * len(motors)
    places = [np.searchsorted(numbers, motor.numbers) for motor in acting]
    power = np.array([np.sum(motor.Y**2, axis=1) for motor in acting])
    left = power
    for _ in range(_WEIGHED):
        solution = _weighed(acting, places, left, len(numbers))
        errors = [motor.Y - solution[:, at] @ motor.W for motor, at in zip(acting, places, strict=True)]
        squares = np.array([np.sum(e**2, axis=1) for e in errors])
        left = np.maximum(squares, _ROUNDING * power.max(axis=1, keepdims=True))
    best = int(np.argmin([e.shape[1] for e in errors] @ np.log(left)))
    told = {
        motor.k: Lateness(delays, motor.names, solution[:, at].T, squares, motor.rows, motor.part * inflation(e[best]))
        for motor, at, squares, e in zip(acting, places, left, errors, strict=True)
    }
    return [told.get(motor.k) for motor in motors]


def _weighed(motors: Sequence[_Motor], places: Sequence[Places], left: Array, count: int) -> Array:
    """Parameters (D x p), of ``count`` p in all, that fit the rows of all motors at every delay; those of a motor stand
    in its ``places``, and its rows weigh by the sum of squares that is ``left`` of them (n x D).
    """
    G, g = np.zeros((left.shape[1], count, count)), np.zeros((left.shape[1], count))
    for motor, at, squares in zip(motors, places, left, strict=True):
        weights = motor.W.shape[1] / squares
        G[:, at[:, None], at] += weights[:, None, None] * (motor.W @ motor.W.T)
        g[:, at] += weights[:, None] * (motor.Y @ motor.W.T)
    return np.array([inverse(A) @ b for A, b in zip(G, g, strict=True)])


class _Run:
    """Rows of a run beside its torque taken earlier by every one of ``delays``."""

    def __init__(self, scene: Scene, delays: Array) -> None:
        self.scene, factor = scene, scene.sampled.filters.factor
        # Noise and its own rate of change are unlike at each moment and alike on the average, which needs rows as close
        # as their product changes: a window that passes up to one frequency makes products of up to twice as much.
        apart = max(1, factor // _CLOSE)
        self.part = apart / factor
        rows = partial(windowed, factor=factor, apart=apart)
        self._base = base_rows(rows, scene)
        shifts = delays / scene.period
        out = rows(scene.sampled.left_out.astype(float)) > 0
        at = factor + apart * np.arange(out.shape[1])
        inside = (at + shifts[0] >= factor) & (at + shifts[-1] < scene.motion.samples - factor)
        self._kept = ~out & inside
        self._at = at, shifts
        #: Of the joints' torques in each motor's (n x n).
        self._share = np.linalg.inv(coupling(scene.robot).T)
        # What acts beside the model is along the motion, which is not late.
        self._beside = rows(scene.carried(scene.motion) + scene.torque - scene.model_torque)

    def rows(self, k: int) -> tuple[Array, Array]:
        """Kept rows of the base columns of motor k (p x N) and of its torque by each delay (D x N) [N m, N]."""
        at, shifts = self._at
        kept = self._kept[self._driven(k)].all(axis=0)
        none = np.zeros(len(at))
        W = np.array(
            [
                sum(self._share[k, j] * self._base[j].get(number, none) for j in self._driven(k))
                for number in self.numbers(k)
            ]
        )
        tau = np.convolve(self._share[k] @ self.scene.sampled.tau, window(self.scene.sampled.filters.factor), "same")
        earlier = CubicSpline(np.arange(len(tau)), tau)(at[kept] + shifts[:, None])
        return W.reshape(-1, len(at))[:, kept], earlier - (self._share[k] @ self._beside)[kept]

    def _driven(self, k: int) -> list[int]:
        return np.flatnonzero(self._share[k]).tolist()

    def numbers(self, k: int) -> list[int]:
        """Of the base parameters that its torque depends on, without the file's drive trains."""
        count = len(self.scene.regressors.names)
        return sorted({number for j in self._driven(k) for number in self._base[j] if number < count})
