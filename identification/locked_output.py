"""Stiffness of a drive train whose output is blocked: the motor turns against the spring alone (report eq. 70-72).

tau_j - tau_sb = Iam qdd + Fvm qd + Fcm sign(qd) + k q + Offk, by least squares on filtered and decimated runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from generator.command_line import command_line
from generator.effects.library import effects_of
from generator.errors import InputError, Place
from generator.robot.description import PRISMATIC, Joint, Robot
from generator.words import plural
from identification.arrays import Array
from identification.colour import inflation
from identification.dataset import Run, load
from identification.essential import GROWTH, RATIO, essential
from identification.factors import Factor, triangular
from identification.filtering import decimated, derivative, kept_rows, smoothed
from identification.held import check_held
from identification.least_squares import Problem, Solution
from identification.outcome import HIDDEN, LIMIT, Value
from identification.recipes import Filters, Recipe
from identification.residuals import Residual
from identification.run_filters import filters_of, notes_of
from identification.shared_samples import unshared

#: The decimation passes twice the dynamics. The report's passes 1 Hz, which cannot tell Iam qdd from k q.
RECIPE = Recipe(dynamics=5.0)
#: Part of a motor's largest speed below which its friction is no matter of the speed's sign.
_STANDSTILL = 0.2
#: Fewest rows a parameter.
_FEWEST = 3
#: Part of how far a motor turns in the other runs below which a run shows nothing of it.
_TURNS = 0.05
_STEMS = (
    ("Iam", ("kg m2", "kg")),
    ("Fvm", ("N m s/rad", "N s/m")),
    ("Fcm", ("N m", "N")),
    ("k", ("N m/rad", "N/m")),
    ("Offk", ("N m", "N")),
)


@dataclass(frozen=True)
class LockedOutput:
    """Parameters of eq. 70 by name, all and ``essential`` ones, of the joint's runs; ``removed`` is tau_sb [N m].

    ``rows`` hold [qdd qd sign(qd) q 1 Y] of each run (rows x 6), ``condition`` is that of their first five columns.
    """

    robot: Robot
    joint: Joint
    runs: tuple[tuple[Run, Filters], ...]
    values: Mapping[str, Value]
    essential: Mapping[str, Value]
    residual: Residual
    essential_residual: Residual
    removed: tuple[float, ...]
    rows: tuple[Array, ...]
    condition: float
    notes: tuple[str, ...]


def locked_output(
    robot: Robot,
    number: int,
    sources: Sequence[str],
    balancer: Mapping[str, float] | None = None,
    recipe: Recipe = RECIPE,
) -> LockedOutput:
    """Stiffness of joint ``number`` from runs in which its output is blocked.

    ``balancer`` holds the parameters of the effects to be subtracted on this axis, by name [SI]. They act on the link,
    which does not move: their torque is that at the run's mean position.

    Raises InputError where the joint moves as if it was free and where the runs do not show its stiffness.
    """
    k, joint = _joint(robot, number)
    names = tuple(f"{stem}{number}" for stem, _ in _STEMS)
    found, stacked, removed = [], [], []
    for source in sources:
        run = load(str(source), robot, recipe.columns, resting=True)
        filters = filters_of(run, recipe)
        check_held(run, k, joint, "a blocked output")
        removed.append(_balancer(robot, number, balancer or {}, float(run.q[k].mean())))
        stacked.append(_rows(run, filters, k, removed[-1]))
        found.append((run, filters))
    unshared({"fit": [run for run, _ in found]})
    rows = np.concatenate(stacked)
    if len(rows) < _FEWEST * len(names):
        few = f"{plural(len(rows), 'row')} in which the motor of joint {number} turns steadily"
        raise InputError(found[0][0].place, few, f"{_FEWEST * len(names)} at least: a longer run")
    factor = Factor(k, names, triangular(rows), len(rows), float(rows[:, -1].sum()))
    problem = Problem((factor,), names, {}, weighted=False)
    solution = problem.solve()
    reduced, best = essential(problem, RATIO, GROWTH)
    full, kept = _values(solution, rows, names, joint, names), _values(best, rows, names, joint, reduced.names)
    _check_shown(found[0][0].place, number, full, kept)
    full = {one: _shown(value) for one, value in full.items()}
    notes = [note for run, _ in found for note in notes_of(run, recipe)]
    ways = [float(np.ptp(run.q[k])) for run, _ in found]
    notes += [
        f"{run.name}: the motor of joint {number} hardly turns: this run tells nothing of k{number}"
        for (run, _), way in zip(found, ways, strict=True)
        if way < _TURNS * max(ways)
    ]
    if joint.number not in robot.flexible:
        notes.append(f"the file of {robot.name} does not list joint {number} as flexible")
    whole, small = _residual(factor, solution), _residual(factor, best)
    ends = tuple(removed), tuple(stacked), solution.condition, tuple(notes)
    return LockedOutput(robot, joint, tuple(found), full, kept, whole, small, *ends)


def _joint(robot: Robot, number: int) -> tuple[int, Joint]:
    for k, joint in enumerate(robot.moving):
        if joint.number == number:
            return k, joint
    known = ", ".join(str(joint.number) for joint in robot.moving)
    raise InputError(command_line("--locked"), f"{robot.name} has no moving joint {number}", known)


def _check_shown(place: Place, number: int, full: Mapping[str, Value], kept: Mapping[str, Value]) -> None:
    """Raises InputError where the runs, of which the first has its ``place``, do not show the stiffness: not among all
    values, or not among the essential ones that are ``kept``, or not a positive one.
    """
    name, inertia = f"k{number}", f"Iam{number}"
    stiffness = full[name]
    if stiffness.value is None or stiffness.relative_std > 100 * LIMIT or name not in kept:
        expected = "a motor that turns slowly to and fro against the blocked output"
        problem = f"{name} cannot be told: relative std {stiffness.relative_std:.3g} %"
        if name in kept and inertia not in kept and kept[name].relative_std < 100 * LIMIT:
            problem = f"{name} cannot be told from {inertia} along this motion"
            expected += ", in waves of several frequencies: in one alone inertia and stiffness make the same torque"
        raise InputError(place, problem, expected)
    if stiffness.value < 0:
        problem = f"{name} comes out negative: the torque falls as the motor turns on"
        raise InputError(place, problem, f"torque and position of joint {number} with one sign")


def _balancer(robot: Robot, number: int, values: Mapping[str, float], q: float) -> float:
    """Torque [N m] of effects that depend on the joint's position alone, for those of ``values`` that are theirs."""
    total = 0.0
    for instance in effects_of(robot):
        if instance.effect.needs != ("q",):
            continue
        for name, column in zip(instance.names, instance.columns(), strict=True):
            if number in column and name in values:
                total += values[name] * float(column[number].subs(instance.site.q, q))
    return total


def _rows(run: Run, filters: Filters, k: int, removed: float) -> Array:
    """[qdd qd sign(qd) q 1 Y], filtered and decimated alike (report eq. 71), without what stands nearly or is cut off.

    A motor that sticks has any friction up to Fcm, most of all where k q is largest: k would come out too large.
    """
    q = smoothed(run.q[k], filters.order, filters.cutoff, run.rate)
    qd = derivative(q, run.period)
    qdd = derivative(qd, run.period)
    columns = np.stack([qdd, qd, np.sign(qd), q, np.ones_like(q), run.tau[k] - removed])
    within = filters.inner(run.samples)
    inner = columns[:, within]
    speed = np.abs(inner[1])
    bad = speed < _STANDSTILL * speed.max()
    if run.unusable is not None:
        bad |= run.unusable[k, within]
    result: Array = decimated(inner, filters.factor)[:, kept_rows(bad, filters.factor)].T
    return result


def _values(
    solution: Solution, rows: Array, names: Sequence[str], joint: Joint, kept: Sequence[str]
) -> dict[str, Value]:
    """With standard deviations for residuals coloured as found."""
    chi = np.array([solution.values[name] for name in names])
    colour = np.sqrt(inflation(rows[:, -1] - rows[:, :-1] @ chi))
    units = {f"{stem}{joint.number}": pair[joint.sigma == PRISMATIC] for stem, pair in _STEMS}
    return {
        name: Value.unknown(units[name], HIDDEN)
        if name in solution.hidden
        else Value(solution.values[name], solution.std(name) * float(colour), units[name])
        for name in kept
    }


def _shown(one: Value) -> Value:
    """A value, refused where its standard deviation is larger."""
    if one.value is None or one.relative_std <= 100:
        return one
    return Value.unknown(one.unit, f"relative std {one.relative_std:.3g} %")


def _residual(factor: Factor, solution: Solution) -> Residual:
    return Residual(factor.rows, factor.residual(solution.values), factor.norm, factor.spread)
