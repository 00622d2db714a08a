"""Runs of one robot that do not agree: each one's torques beside what a fit of the others makes of its motion.

A run with another payload, a lost zero or other gains spoils the parameters of all, and these may leave little of any
torque. So the others are fitted without it. What they foresee of a joint counts only where their rows show all that the
run moves there. Friction is another when it is warmer, and no reason to doubt a run: it is fitted to it anew.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np

from generator.symbolic.model import Model
from generator.words import listed
from identification.arrays import Array
from identification.factors import Factor, added
from identification.least_squares import Problem, Solution
from identification.observed import Observed
from identification.rank import in_lengths, nonzero
from identification.signs import above_zero, another_sign, directed

#: Part of what a run moves in directions that the others' rows do not show from which they do not foresee its torques.
_UNSEEN = 1e-3
#: Part of a torque that is left of it with the other sign where that is its sign, and that may be uncertain for that.
_NEGATED, _SURE = 0.5, 0.25
#: A run is odd whose torques the others miss by so many times what fits leave, and by these parts of their spread and
#: of all of them: a gain that drifts by a hundredth is much of the spread where a joint hardly moves. What
#: a model lacks is another for every motion: friction with a dip at low speeds, fitted to motions of other sizes, comes
#: to 1.3 times, the drives of an industrial robot to less; a fifth more friction to none. Another payload or zero comes
#: to ten times and more.
_ODD, _PART, _OF_ALL = 3.0, 0.05, 0.02
#: Rows beyond those that own friction takes from which something can be said of a joint.
_ROWS = 20
#: Residuals are coloured: what is foreseen is about so many times less certain than by residuals that are not.
_COLOURED = 3.0
#: What an odd run may have.
_OTHER = "another payload, another zero of a position (a lost home position) or of a torque, or other gains or signs"


@dataclass(frozen=True)
class Foreseen:
    """Of a ``joint`` (from 0) of a run [N m, N]: the norm of its ``torque`` and its ``spread``; of what is left of it
    with its own friction, ``left``, and of the ``negated`` torque as it is; what a fit leaves of as many rows,
    ``noise``, of the run alone or of the others, whichever is more; and the standard deviation of what is foreseen,
    ``uncertain``.
    """

    joint: int
    torque: float
    spread: float
    left: float
    negated: float
    noise: float
    uncertain: float

    @property
    def opposite(self) -> bool:
        """Whether its torque is the other way than that which is foreseen."""
        return self.negated < _NEGATED * self.torque and _COLOURED * self.uncertain < _SURE * self.torque

    @property
    def excess(self) -> float:
        """What is left in parts of what may be; zero where it is little of the torque."""
        if self.left < max(_PART * self.spread, _OF_ALL * self.torque):
            return 0.0
        return self.left / max(float(np.hypot(self.noise, _COLOURED * self.uncertain)), np.finfo(float).tiny)

    @property
    def odd(self) -> bool:
        """Whether it does not agree with what is foreseen."""
        return self.excess > _ODD


def by_others(run: Observed, others: Problem, model: Model) -> list[Foreseen]:
    """What a fit of ``others`` makes of a run, joint by joint, where it can."""
    fit = replace(others, weighted=True)
    solution, own = fit.solve(), replace(fit, factors=run.factors).solve()
    friction = {name for one in model.effects if {"qd", "state"} & {*one.effect.needs} for name in one.names}
    shown = _shown(fit, solution)
    return [
        _foreseen(one, solution, own, friction)
        for one in run.factors
        if one.rows > _ROWS + len(friction & {*one.names})
        if one.joint in solution.sigma and shown.hold(one.on(fit.names)[:, :-1])
    ]


def of_one_sign(run: Observed, others: Problem, model: Model) -> None:
    """Raises InputError where torques of a joint of a ``run`` are the other way than a fit of ``others`` foresees."""
    for one in by_others(run, others, model):
        if one.opposite:
            number = model.robot.numbers[one.joint]
            raise another_sign(run.sampled.run.place, "those that are fitted", f" of joint {number}")


def agreement(runs: Sequence[Observed], problem: Problem, model: Model) -> list[str]:
    """Notes on runs that do not agree with the others, whose parameters are those of ``problem``; raises InputError
    where torques of a joint have another sign in one of them.
    """
    notes, left = list[str](), list(runs)
    beside = _each(left, problem, model)
    _check_signs(left, beside, problem, model)
    while len(left) > 1:
        odd = [max((one.excess for one in each if one.odd), default=0.0) for each in beside]
        worst = int(np.argmax(odd))
        if not odd[worst]:
            break
        numbers = model.robot.numbers
        if len(left) == 2:
            names = listed(one.sampled.run.name for one in left)
            told = _told(odd_of_two(beside), numbers)
            return [*notes, f"{names} do not agree on {told}: does one of them have {_OTHER}?"]
        told, name = _told([one for one in beside[worst] if one.odd], numbers), left[worst].sampled.run.name
        notes.append(f"{name} does not agree with the other runs on {told}: does it have {_OTHER}?")
        # The others are judged without it.
        del left[worst]
        beside = _each(left, problem, model)
    return notes


def odd_of_two(beside: Sequence[Sequence[Foreseen]]) -> list[Foreseen]:
    """Of two runs, by each other, the joints that are odd in either, each as it is more so."""
    by_excess = sorted((one for each in beside for one in each if one.odd), key=lambda one: one.excess)
    return list({one.joint: one for one in by_excess}.values())


def _told(some: Sequence[Foreseen], numbers: Sequence[int]) -> str:
    return listed(
        f"joint {numbers[one.joint]} (a fit of the others leaves {100 * one.left / one.spread:.2g} % of its torque's "
        f"spread, fits of either alone {100 * one.noise / one.spread:.2g} %)"
        for one in sorted(some, key=lambda one: one.joint)
    )


def _each(runs: Sequence[Observed], problem: Problem, model: Model) -> list[list[Foreseen]]:
    """Of each run by all others; of one alone nothing."""
    if len(runs) < 2:
        return [[] for _ in runs]
    before, after = (_sums([one.factors for one in order]) for order in (runs, runs[::-1]))
    others = [added([*a, *b]) for a, b in zip(before, after[::-1], strict=True)]
    return [by_others(run, replace(problem, factors=each), model) for run, each in zip(runs, others, strict=True)]


def _sums(runs: Sequence[tuple[Factor, ...]]) -> list[tuple[Factor, ...]]:
    """Before each of the runs, the factors of all rows of those before."""
    sums: list[tuple[Factor, ...]] = [()]
    for one in runs[:-1]:
        sums.append(added([*sums[-1], *one]))
    return sums


def _check_signs(
    runs: Sequence[Observed], beside: Sequence[Sequence[Foreseen]], problem: Problem, model: Model
) -> None:
    """Raises InputError where a run's torques are the other way than those of the others: of the run whose own friction
    and inertia are negative, or the least.
    """
    numbers, braking = model.robot.numbers, list[tuple[float, Observed, int]]()
    for run, each in zip(runs, beside, strict=True):
        for number in (numbers[one.joint] for one in each if one.opposite):
            own = replace(problem, factors=run.factors, weighted=True).solve()
            std = {name: own.std(name) for name in own.names if name not in own.hidden}
            directed(run.sampled.run.place, model, own.values, std, set(numbers) - {number})
            size = sum(size for joint, size in above_zero(model, own.values, std) if joint == number)
            braking.append((size, run, number))
    if braking:
        _, run, number = min(braking, key=lambda one: one[0])
        raise another_sign(run.sampled.run.place, "those of the other runs", f" of joint {number}")


def _foreseen(one: Factor, solution: Solution, own: Solution, friction: Collection[str]) -> Foreseen:
    W, Y = one.R[:, :-1], one.R[:, -1]
    made = W @ np.array([solution.values[name] for name in one.names])
    F = W[:, [name in friction for name in one.names]]
    error = Y - made
    anew = F @ np.linalg.lstsq(F, error, rcond=None)[0]
    columns = one.on(solution.names)[:, :-1]
    variance = float(np.sum((columns @ solution.covariance) * columns))
    sigma = max(solution.sigma[one.joint], own.sigma[one.joint])
    left, negated = (float(np.linalg.norm(x)) for x in (error - anew, Y + made))
    noise, uncertain = float(sigma * np.sqrt(one.rows)), float(np.sqrt(max(variance, 0.0)))
    return Foreseen(one.joint, one.norm, one.spread, left, negated, noise, uncertain)


@dataclass(frozen=True)
class _Shown:
    """Directions ``V`` (p x k) that rows show of parameters (p), these in units of their columns' lengths ``size``."""

    size: Array
    V: Array

    def hold(self, W: Array) -> bool:
        """Whether rows ``W`` (r x p) are in these directions."""
        scaled = W / self.size
        return bool(np.linalg.norm(scaled - (scaled @ self.V) @ self.V.T) <= _UNSEEN * np.linalg.norm(scaled))


def _shown(fit: Problem, solution: Solution) -> _Shown:
    W = np.concatenate([one.on(fit.names)[:, :-1] / solution.sigma[one.joint] for one in fit.factors])
    scaled, size, _ = in_lengths(W)
    _, s, Vt = np.linalg.svd(scaled, full_matrices=False)
    return _Shown(size, Vt[nonzero(s)].T)
