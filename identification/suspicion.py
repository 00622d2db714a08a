"""Fits that are too bad to be believed: is it another robot's run, are columns swapped, of the wrong sign or unit?

Where a joint's residual is large, the fit is repeated on a thinned run with each two joints' columns exchanged, or two
motors', with the sign of each one's torques or positions changed, and with its torques in another unit. If that
explains the torques far better, the columns are refused and named.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations, product

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.errors import InputError
from generator.robot.description import REVOLUTE, Robot
from generator.words import listed
from identification.arrays import Array
from identification.drive_train import constants, coupling
from identification.factors import Factor, triangular
from identification.filtering import smoothed
from identification.least_squares import Problem
from identification.observation import Motion, Regressors
from identification.residuals import Residual, Residuals
from identification.sampling import Sampled
from identification.signs import SENSE

#: Residual of a joint [% of the spread] from which swapped columns are looked for, and that of all joints together
#: from which the data are refused.
_DOUBTFUL, _REFUSED = 10.0, 50.0
#: How many times what is fitted leaves of a torque a test may leave.
_FURTHER = 3.0
#: By how much the product of the joints' residuals must fall.
_BETTER = 20.0
#: The same where much stays unexplained, for a joint that is read wrong; the logarithm by which two may differ that do
#: as well; and angles [deg] by which a zero is another one.
_BETTER_MISREAD, _ALIKE, _ZEROS = 2.0, 0.2, (-90, 90, 180)
#: Factors by which efforts in another unit are too small or too large: m, k.
_UNITS = (1e-3, 1e3)
#: Samples that the fits are repeated on.
_THINNED = 1500
#: Rows for each parameter that a joint must have for that, those alone counted that the filter leaves independent; and
#: where signs alone are asked, which are far fewer ways to explain a run than pairs.
_FEWEST, _FEWEST_TURNED = 5, 3


def suspect(runs: Sequence[Sampled], regressors: Regressors, residuals: Residuals) -> list[str]:
    """Doubts about a fit; raises InputError where columns are swapped, or of another unit, and where the model does not
    explain the data.
    """
    ordered(runs, regressors, residuals)
    each, total = residuals.per_joint, residuals.total.relative_to_mean
    bad = _doubtful(residuals)
    robot = regressors.model.robot
    upright = _mounted(runs[0], regressors) if bad and total > _DOUBTFUL else ""
    mounted = f"gravity as the robot is mounted: with {upright} m/s2 far less is left"
    if bad and total > _REFUSED:
        problem = f"the model of {robot.name} leaves {total:.0f} % of the torques unexplained"
        if upright:
            raise InputError(robot.place, problem, mounted)
        raise InputError(runs[0].run.place, problem, "a run of this robot, in rad and N m")
    return [
        *([f"does the file have {mounted}"] if upright else []),
        *(
            f"joint {robot.numbers[k]}: {each[k].relative_to_mean:.0f} % of its torque's spread is unexplained"
            f"{_asked(each[k])}"
            for k in bad
            if each[k].relative_to_mean > _REFUSED
        ),
    ]


def beyond(train: Residuals, test: Residuals, numbers: Sequence[int]) -> list[str]:
    """What is to be told of joints that runs which test show far worse than those that are fitted, or alone."""
    tested = {k: one.relative_to_mean for k, one in test.per_joint.items() if one.rows}
    fitted = {k: one.relative_to_mean for k, one in train.per_joint.items() if one.rows}
    far = [
        f"joint {numbers[k]} ({fitted[k]:.2g} % of its spread fitted, {left:.2g} % tested)"
        for k, left in tested.items()
        if k in fitted and left > max(_FURTHER * fitted[k], _DOUBTFUL)
    ]
    unseen = [
        f"the fitted runs have no rows of joint {numbers[k]}: {left:.3g} % of its torque's spread is unexplained in "
        "the runs that test"
        for k, left in tested.items()
        if k not in fitted and left > _DOUBTFUL
    ]
    if not far:
        return unseen
    return [
        f"the runs that test are explained far worse on {listed(far)}: they go where the fitted ones do not, or are of "
        "another state of the robot",
        *unseen,
    ]


def _asked(one: Residual) -> str:
    """What is asked where a model leaves more of a torque than its mean would."""
    return ", more than its mean leaves: is it in N m, or its current in A?" if one.relative_to_mean > 100 else ""


def ordered(runs: Sequence[Sampled], regressors: Regressors, residuals: Residuals | None = None) -> None:
    """Raises InputError where columns of two joints or motors are swapped, or efforts of one are of another unit, of
    which one has large ``residuals``; without any, each run is fitted by itself in some of its samples.
    """
    bad = None if residuals is None else _doubtful(residuals)
    if bad is None or bad:
        for one in runs:
            _in_order(one, regressors, bad)


def of_one_sense(runs: Sequence[Sampled], regressors: Regressors, residuals: Residuals) -> None:
    """Raises InputError where ``residuals`` are large and one of the runs is explained far better with another sign of
    one column.
    """
    if _doubtful(residuals):
        for one in runs:
            _of_one_sense(one, regressors)


def misread(one: Sampled, regressors: Regressors) -> list[str]:
    """Joints that move the other way than the robot's file has it, or from another zero, if that explains a run better:
    several where one is the mirror image of another.
    """
    motion, tau, used, independent = _thinned(one)
    joints = regressors.model.robot.moving

    def misfit(moved: Motion, torques: Array) -> float:
        return _Thinned(regressors, moved, torques, used, independent).misfit(np.eye(len(tau)))

    ways: dict[str, tuple[Motion, Array]] = {}
    for k, joint in enumerate(joints):
        way = np.where(np.arange(len(tau)) == k, -1.0, 1.0)[:, None]
        ways[f"positions and torques of joint {joint.number} the other way"] = (motion.turned(k), way * tau)
        for degrees in _ZEROS if joint.sigma == REVOLUTE else ():
            away = f"positions of joint {joint.number} {degrees:+d} deg away"
            ways[away] = (motion.shifted(k, np.radians(degrees)), tau)
    misfits = {what: misfit(*of) for what, of in ways.items()}
    best = min(misfits.values())
    if best > misfit(motion, tau) - np.log(_BETTER_MISREAD):
        return []
    alike = [what for what, x in misfits.items() if x < best + _ALIKE]
    return [
        f"with {', or '.join(alike)} less is left of {one.run.file}: are zeros and signs of the columns, axes and gear "
        "ratios right?"
    ]


def _doubtful(residuals: Residuals) -> list[int]:
    return [k for k, one in residuals.per_joint.items() if one.rows and one.relative_to_mean > _DOUBTFUL]


def _mounted(one: Sampled, regressors: Regressors) -> str:
    """Gravity [m/s2] along an axis of the world with which a run is explained far better, as a robot's file has it;
    empty where there is none. On a wall or under a ceiling other parameters are base parameters, too.
    """
    robot = regressors.model.robot
    own, size = robot.gravity, sympy.sqrt(sum(x**2 for x in robot.gravity))
    axes = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    others = [(sign * x * size, sign * y * size, sign * z * size) for x, y, z in axes for sign in (-1, 1)]
    motion, tau, used, independent = _thinned(one)
    # Its parameter sets have the base parameters of the gravity that the file says.
    bare = replace(robot, parameter_sets={})
    tried = {each: Regressors(replace(bare, gravity=each)) for each in others if size and each != own}
    misfits = {
        gravity: _Thinned(each, motion, tau, used, independent).misfit(np.eye(len(tau)))
        for gravity, each in {own: regressors, **tried}.items()
    }
    best = min(misfits, key=lambda gravity: misfits[gravity])
    if misfits[best] > misfits[own] - np.log(_BETTER):
        return ""
    return f"[{', '.join(f'{float(x):g}' for x in best)}]"


def _thinned(one: Sampled) -> tuple[Motion, Array, NDArray[np.bool_], float]:
    """Motion, torques and rows that count (n x M each) in some samples of a run, and the part of them that the filter
    leaves independent.
    """
    tau = smoothed(one.tau, one.filters.order, one.filters.cutoff, one.filters.rate)
    thin = np.unique(np.linspace(0, one.motion.samples - 1, _THINNED).astype(int))
    independent = min(2 * one.filters.cutoff / one.filters.rate * one.motion.samples / len(thin), 1.0)
    return one.motion.at(thin), tau[:, thin], ~one.left_out[:, thin], independent


def _in_order(one: Sampled, regressors: Regressors, bad: Collection[int] | None) -> None:
    """Raises InputError where a run is explained far better with two columns exchanged, or one of the efforts in
    another unit, which stands out as one of another joint does.
    """
    given, robot = _Thinned(regressors, *_thinned(one)), regressors.model.robot
    same = np.eye(len(robot.moving))
    if bad is None:
        bad = [k for k, x in given.relative(same).items() if x > _DOUBTFUL]
    swapped = _swapped(given, robot, one.run.by_motors, bad)
    scaled = _in_other_units(given, robot, one.run.by_motors) if bad else {}
    now = given.misfit(same) - np.log(_BETTER)
    least, exchanged = (min(each.values(), default=np.inf) for each in (scaled, swapped))
    if least < min(exchanged, now):
        what = " or ".join(each for each, x in scaled.items() if x < least + _ALIKE)
        raise InputError(one.run.place, what, "all efforts in their units: N m, N or A")
    if exchanged < now:
        what, whose = min(swapped, key=lambda each: swapped[each])
        raise InputError(one.run.place, what, f"columns in the {whose}' order")


def _swapped(given: _Thinned, robot: Robot, by_motors: bool, bad: Collection[int]) -> dict[tuple[str, str], float]:
    """Misfits with the columns of two joints or motors exchanged, one of which is ``bad``, by what that says and whose
    columns those are.
    """
    same = np.eye(len(robot.moving))
    misfits: dict[tuple[str, str], float] = {}
    for i, k in combinations(range(len(same)), 2):
        if (i not in bad and k not in bad) or not (given.shows(i) and given.shows(k)):
            continue
        P = same.copy()
        P[[i, k]] = P[[k, i]]
        for whose, A, B in _mixed(robot, P, by_motors):
            other = given.mixed(A)
            tried = {"torques": given.misfit(B), "positions": other.misfit(same), "columns": other.misfit(B)}
            for name, misfit in tried.items():
                what = f"the {name} of {whose} {robot.numbers[i]} and {robot.numbers[k]} look swapped", whose
                misfits[what] = min(misfit, misfits.get(what, np.inf))
    return misfits


def _in_other_units(given: _Thinned, robot: Robot, by_motors: bool) -> dict[str, float]:
    """Misfits with one column of the efforts in another unit, in parts of its own size, by what that says; only of
    those with which the model explains all torques.
    """
    misfits: dict[str, float] = {}
    count = len(robot.moving)
    for k, factor in product((k for k in range(count) if given.shows(k)), _UNITS):
        times = f"{max(factor, 1 / factor):g} times too {'large' if factor < 1 else 'small'}"
        scale = np.diag(np.where(np.arange(count) == k, factor, 1.0))
        for whose, _, B in _mixed(robot, scale, by_motors):
            what = f"the torques of {whose.removesuffix('s')} {robot.numbers[k]} look {times}"
            if max(given.relative(B).values()) < _DOUBTFUL:
                misfits[what] = min(given.misfit(B) - np.log(factor), misfits.get(what, np.inf))
    return misfits


def _of_one_sense(one: Sampled, regressors: Regressors) -> None:
    """Raises InputError where a run is explained far better with another sign of one column; where two of them do as
    well, it is told of both.
    """
    motion, tau, used, independent = _thinned(one)
    same = np.eye(len(tau))
    given = _Thinned(regressors, motion, tau, used, independent)
    robot = regressors.model.robot
    misfits: dict[str, float] = {}
    for k in (k for k in range(len(tau)) if given.shows(k, _FEWEST_TURNED)):
        turn = np.diag(np.where(np.arange(len(tau)) == k, -1.0, 1.0))
        for whose, A, B in _mixed(robot, turn, one.run.by_motors):
            if whose == "motors" and np.allclose(A, turn) and np.allclose(B, turn):
                continue
            of = f"of {whose.removesuffix('s')} {robot.numbers[k]}"
            turned = _Thinned(regressors, motion.mixed(A), tau, used, independent)
            for what, misfit in (("torques", given.misfit(B)), ("positions", turned.misfit(same))):
                misfits[f"the {what} {of}"] = min(misfit, misfits.get(f"the {what} {of}", np.inf))
    best = min(misfits.values(), default=np.inf)
    if best < given.misfit(same) - np.log(_BETTER):
        alike = [what for what, x in misfits.items() if x < best + _ALIKE]
        raise InputError(one.run.place, f"{' or '.join(alike)} look of the wrong sign", SENSE)


def _mixed(robot: Robot, P: Array, by_motors: bool) -> Iterator[tuple[str, Array, Array]]:
    """Whose columns may be mixed by ``P`` (n x n), and by which matrices (n x n each) that mixes the joints' motion and
    torques: of joints, and of motors where the run is ``by_motors``, whose efforts are torques or currents.
    """
    yield "joints", P, P
    if by_motors:
        N, kt = coupling(robot), constants(robot)
        for per_effort in dict.fromkeys([(1.0,) * len(kt), tuple(kt.tolist())]):
            K = np.diag(per_effort)
            motion, torques = np.linalg.solve(N, P @ N), N.T @ K @ P @ np.linalg.inv(N.T @ K)
            yield "motors", np.asarray(motion), np.asarray(torques)


def _size(left: Mapping[int, float]) -> float:
    """Sum of the logarithms of the joints' residuals."""
    return float(np.log(list(left.values())).sum())


class _Thinned:
    """Factors of a few rows, each joint's with the torques of all joints beside; a part of them is ``independent``."""

    def __init__(
        self, regressors: Regressors, motion: Motion, tau: Array, used: NDArray[np.bool_], independent: float
    ) -> None:
        self._regressors, self._motion, self._independent = regressors, motion, independent
        self._names, self._structure = regressors.names, regressors.structure
        self._rows, self._tau, self._used = independent * used.sum(axis=1), tau, used
        self._factors = [
            triangular(np.concatenate([W[:, rows], tau[:, rows]]).T)
            for W, rows in zip(regressors.base(motion), used, strict=True)
        ]

    def mixed(self, mix: Array) -> _Thinned:
        """The same rows where the joints' motion is ``mix`` (n x n) times the given one, of joints all of whose given
        ones count.
        """
        used = np.all(self._used | (mix == 0)[:, :, None], axis=1)
        return _Thinned(self._regressors, self._motion.mixed(mix), self._tau, used, self._independent)

    def shows(self, k: int, fewest: int = _FEWEST) -> bool:
        """Whether joint k has rows enough to doubt its columns."""
        return bool(self._rows[k] > fewest * len(self._structure[k]))

    def misfit(self, mix: Array) -> float:
        """The ``_size`` of what is left with torques that are ``mix`` (n x n) times the given ones."""
        return _size(self.left(mix))

    def relative(self, mix: Array) -> Mapping[int, float]:
        """The joints' residuals with such torques [% of their spread], of those that have rows."""
        torques = mix @ self._tau
        spread = {k: float(np.std(torques[k, rows])) for k, rows in enumerate(self._used) if rows.any()}
        return {k: 100 * x / spread[k] if spread[k] else 0.0 for k, x in self.left(mix).items() if k in spread}

    def left(self, mix: Array) -> Mapping[int, float]:
        """Residuals [N m, N] of joints that have rows, with torques that are ``mix`` (n x n) times the given ones."""
        factors = []
        for k, (R, names) in enumerate(zip(self._factors, self._structure, strict=True)):
            # What is left of no rows is rounding, by the size of all torques.
            if not self._used[k].any():
                continue
            mixed = np.column_stack([R[:, : len(names)], R[:, len(names) :] @ mix[k]])
            factors.append(Factor(k, names, mixed, int(self._rows[k]), 0.0))
        return Problem(tuple(factors), self._names, {}, weighted=True).solve().sigma
