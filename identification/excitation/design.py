"""Search for the motion that shows a robot's parameters best: random starts, then covariance matrix adaptation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from generator.errors import InputError
from identification.arrays import Array
from identification.covariance_adaptation import strategy
from identification.excitation.criterion import Criterion, sizes_and_rank
from identification.excitation.memory import Memory
from identification.excitation.shapes import BETWEEN, CHECKED, SEARCHED, Shapes
from identification.fourier_series import FourierSeries
from identification.observation import Motion

Progress = Callable[[float], None]

#: Random motions looked at before the best ones are improved.
DRAWN = 256
#: How many of them are improved, and motions of a generation.
_STARTS, _GENERATION = 2, 24
#: Generations for which the axes of the evolution stay as they are, at most, since finding them costs as much as one;
#: and drawn numbers for each: with fewer of them, axes learn faster than several generations may be summed.
_WAIT, _EACH = 10, 6
#: First step of the search, in units of the drawn numbers.
_STEP = 0.3
#: Halvings by which a motion is made small enough for the torques.
_HALVINGS = 30


@dataclass(frozen=True)
class Design:
    """The best ``series`` with its cost, and that of the best random motion; ``load`` is the largest share of a
    torque limit, on ``instants`` that are dense.
    """

    series: FourierSeries
    cost: float
    first_cost: float
    load: float


def designed(
    criterion: Criterion, shapes: Shapes, evaluations: int, seed: int, progress: Progress = lambda part: None
) -> Design:
    """The best of so many ``evaluations``, DRAWN at least; the same for the same seed.

    Raises InputError where no joint may be faster than its standstill threshold, and where the robot's weight
    and dry friction alone are beyond a limit of torques or currents at the best motion's centre.
    """
    draw = np.random.default_rng(seed)
    x = shapes.drawn(DRAWN, draw)
    pieces = [criterion.information(shapes.motions(piece), len(piece)) for piece in _pieces(x, criterion.memory)]
    information, loads = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    scale, rank = sizes_and_rank(information)
    if not rank:
        robot = criterion.regressors.model.robot
        raise InputError(robot.place, "no joint can be faster than its standstill threshold", "larger speeds")
    first = criterion.costs(information, loads, scale, rank)

    def costs(x: Array) -> Array:
        return criterion.costs(*criterion.information(shapes.motions(x), len(x)), scale, rank)

    found = [(float(first.min()), x[int(np.argmin(first))])]
    budget = max(evaluations - DRAWN, 0) // _STARTS
    for k, start in enumerate(np.argsort(first)[:_STARTS]):
        if budget >= _GENERATION:
            found.append(improved(x[start], costs, budget, draw, _part_of(progress, k)))
    _, best = min(found, key=lambda one: one[0])
    series, load = _allowed(shapes.series(best), criterion, shapes)
    information, loads = criterion.information(series.motion(shapes.instants(SEARCHED)), 1)
    (cost,) = criterion.costs(information, loads, scale, rank).tolist()
    return Design(series, cost, float(first.min()), load)


def improved(
    start: Array,
    costs: Callable[[Array], Array],
    budget: int,
    draw: np.random.Generator,
    progress: Progress = lambda part: None,
) -> tuple[float, Array]:
    """The best cost and vector (n) of an evolution from ``start`` (n).

    ``costs`` are of vectors (m x n), of which it looks at a ``budget``.
    """
    wait = min(_WAIT, max(len(start) // _EACH, 1))
    evolution = strategy(start, _STEP, draw, popsize=_GENERATION, updatecovwait=wait)
    done = 0
    while done < budget and not evolution.stop():
        generation = evolution.ask()
        evolution.tell(generation, costs(np.array(generation)).tolist())
        done += len(generation)
        progress(done / budget)
    return float(evolution.best.f), np.array(evolution.best.x)


def _part_of(progress: Progress, start: int) -> Progress:
    return lambda part: progress((start + part) / _STARTS)


def _allowed(series: FourierSeries, criterion: Criterion, shapes: Shapes) -> tuple[FourierSeries, float]:
    """The series, smaller where its torques are too large at any of the dense instants, and its largest load."""
    instants = shapes.instants(CHECKED)

    def load(factor: float) -> float:
        motion = criterion.memory.runs(series.resized(factor).motion(instants), 1)
        torques = criterion.regressors.torques(criterion.memory.values, motion)
        return float(np.abs(criterion.limits.loads @ torques).max(initial=0.0))

    if load(1.0) <= 1 - BETWEEN:
        return series, load(1.0)
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if load(middle) <= 1 - BETWEEN else (low, middle)
    if not low:
        raise _beyond_limits(criterion.memory.runs(series.resized(0.5**_HALVINGS).motion(instants), 1), criterion)
    return series.resized(low), load(low)


def _beyond_limits(motion: Motion, criterion: Criterion) -> InputError:
    """The error of the limit that a motion too small for anything but weight and dry friction exceeds most."""
    robot, loads = criterion.regressors.model.robot, criterion.limits.loads
    row = int(np.argmax(np.abs(loads @ criterion.regressors.torques(criterion.memory.values, motion)).max(axis=1)))
    limited = [joint.number for joint in robot.moving if joint.torque_limit is not None]
    names = [*(f"torque limit of joint {j}" for j in limited), *(f"current limit of motor {j}" for j in robot.numbers)]
    problem = f"weight and dry friction alone are beyond the {names[row]}"
    return InputError(robot.place, problem, "a limit that leaves room to move the arm")


def usual_torques(shapes: Shapes, memory: Memory, seed: int) -> Array:
    """Rms torques (n) [N m, N] of random motions within the limits."""
    x = shapes.drawn(DRAWN, np.random.default_rng(seed))
    motions = (memory.runs(shapes.motions(piece), len(piece)) for piece in _pieces(x, memory))
    squares = [(memory.regressors.torques(memory.values, one) ** 2).mean(axis=1) for one in motions]
    result: Array = np.sqrt(np.mean(squares, axis=0))
    return result


def _pieces(x: Array, memory: Memory) -> Iterator[Array]:
    """The vectors (B x numbers) of random motions in equal pieces: of few whole runs, which are long."""
    count = min(memory.lasting, len(x))
    return iter(np.array_split(x, count))
