"""Least squares among physically consistent parameters: bodies that can be, friction that brakes.

What the rows say is weighed by the residuals' variance; what they leave open is settled by the divergence from prior
bodies, as in ``consistency``. The result is a set of standard parameters, whose inertia matrix is positive definite at
every position.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from generator.errors import InputError
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.pseudo_inertia import of_body, uniform_bar
from identification.arrays import Array
from identification.inverse_model import Identification
from identification.left_open import LeftOpen, columns_of_standard, left_open, settled, told
from identification.residuals import Residuals, residuals
from identification.sidecar import Payload

#: Radius of gyration of the ball that an unknown body is compared with, in parts of the longest link; that link's
#: length [m] and the ball's mass [kg] where nothing tells them.
_PART, _LENGTH, _MASS = 0.3, 1.0, 10.0
#: Part of the largest mass below which one is that of noise.
_NONE = 1e-4
#: The solver loses its way where misfits of thousands stand beside small divergences, not where they are small numbers.
_SCALE = 1e-6
#: Part by which a body is made more than just possible.
_ABOVE = 1e-6
#: What possible bodies leave of the torques' spread [%], and in parts of what least squares leave, to doubt the data.
_POOR, _POORER = 4.0, 2.0
#: Radius of gyration [m] that a prior body has at least in every direction: none is a point.
_LEAST_RADIUS = 0.02


@dataclass(frozen=True)
class ConsistentFit:
    """``standard`` parameters by name [SI], payloads' among them, ``base`` ones, and what they leave of the torques.

    ``prior`` tells whether bodies were known beforehand, ``open`` what the rows say nothing of.
    """

    standard: Mapping[str, float]
    base: Mapping[str, float]
    weight: float
    prior: bool
    train: Residuals
    test: Residuals | None
    open: LeftOpen


def consistent_fit(found: Identification, prior: Mapping[str, float] | None, weight: float) -> ConsistentFit:
    """The consistent parameters nearest to the rows of ``found``.

    ``prior`` holds standard parameters of physically possible bodies; a unit of divergence from one of them costs
    ``weight`` variances of a residual. Without it every body is compared with the same ball.

    Raises InputError where a body of the prior is impossible, and ValueError where the solver finds no parameters, as
    with impossible values that were given to the identification.
    """
    import cvxpy

    from identification.consistency import divergence, grouped, possible, relative_to

    cp: Any = cvxpy
    if not found.problem.names:
        raise ValueError("no physically consistent parameters were sought: every value is given")
    model = found.regressors.model
    payloads = _payloads(found)
    names = [p.name for p in model.standard_parameters]
    names += [name for one in payloads for name in one.names().values()]
    s = {name: cp.Variable(name=name) for name in names}
    base = grouped(model, s)
    start = np.array([found.full.solution.values[name] for name in found.problem.names])
    R, rest = _rows(found, start)
    values = base | {name: s[name] for one in payloads for name in one.names().values()}
    scale = np.linalg.norm(R, axis=0) + 1e-300
    # About the least squares' solution, so that the solver need not see what no parameters explain.
    away = cp.hstack([(values[n] - x) * k for n, x, k in zip(found.problem.names, start, scale, strict=True)])
    relative = [
        relative_to(body, [s[f"{stem}{number}"] for stem in INERTIAL_STEMS])
        for number, body in _bodies(found, prior).items()
    ]
    relative += [relative_to(_ball(found), [s[name] for name in one.names().values()]) for one in payloads]
    cost = cp.sum_squares((R / scale) @ away - rest) + weight * divergence(relative)
    constraints = possible(model, s, relative)
    constraints += [values[name] == value for name, value in found.problem.fixed.items() if name in values]
    _solve(cp.Problem(cp.Minimize(_SCALE * cost), constraints), cp)
    bodies = [*(str(joint.number) for joint in found.robot.bodies), *(one.name for one in payloads)]
    for body in bodies:
        _raise_to_possible(body, {name: one for name, one in s.items() if name not in found.problem.fixed}, s)
    standard = {name: float(variable.value) for name, variable in s.items()}
    columns = columns_of_standard(model, found.problem.names, R)
    open_ = left_open(model, found.problem.names, columns)
    for name, value in settled(model, columns, open_, standard, prior or {}).items():
        standard[name] = s[name].value = value
    at = dict(found.problem.fixed) | {name: float(one.value) for name, one in values.items()}
    train = residuals([f for run in found.train for f in run.factors], at)
    test = residuals([f for run in found.test for f in run.factors], at) if found.test else None
    return ConsistentFit(standard, {name: at[name] for name in base}, weight, prior is not None, train, test, open_)


def doubts(found: Identification, fit: ConsistentFit) -> list[str]:
    """Notes on what the rows leave open; torques that free parameters explain and no bodies do are another robot's, or
    of wrong sign or order.
    """
    return [*told(fit.open, fit.standard, fit.prior), *_impossible(found, fit)]


def _impossible(found: Identification, fit: ConsistentFit) -> list[str]:
    free, possible = (one.train.total.relative_to_mean for one in (found.full, fit))
    if possible < _POOR or possible < _POORER * free:
        return []
    left = f"{possible:.1f} % of their spread is left, {free:.1f} % by impossible ones"
    question = f"are they of {found.robot.name}, all columns in place, with right signs and units?"
    return [f"no possible bodies and friction explain these torques ({left}): {question}"]


def _solve(problem: Any, cp: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # about accuracy: the residuals tell what was reached
        try:
            problem.solve(solver=cp.CLARABEL)
        except cp.SolverError as error:
            raise ValueError(f"no physically consistent parameters were found: {error}") from None
    if problem.status not in (cp.OPTIMAL, cp.OPTIMAL_INACCURATE):
        raise ValueError(f"no physically consistent parameters were found: {problem.status}")


def _raise_to_possible(body: str, free: Mapping[str, Any], s: Mapping[str, Any]) -> None:
    """What a body's pseudo-inertia lacks within the solver's accuracy is added to it, as far as it is ``free``."""
    lacking = -float(np.linalg.eigvalsh(of_body(body, {name: float(one.value) for name, one in s.items()})).min())
    if lacking > 0:
        for stem, part in (("XX", 2), ("YY", 2), ("ZZ", 2), ("M", 1)):
            if (name := f"{stem}{body}") in free:
                free[name].value += part * (1 + _ABOVE) * lacking


def _payloads(found: Identification) -> list[Payload]:
    """The payloads of which anything is estimated."""
    by_name = {one.sampled.run.payload.name: one.sampled.run.payload for one in found.train if one.sampled.run.payload}
    return [one for one in by_name.values() if set(one.names().values()) & set(found.problem.names)]


def _rows(found: Identification, start: Array) -> tuple[Array, Array]:
    """R (at most p x p) of the free parameters beyond ``start`` (p), and what is left there that they may explain, in
    standard deviations of the residuals. Nothing is, where ``start`` minimises their squares.
    """
    problem, sigma = found.problem, found.full.solution.sigma
    stacked = np.concatenate([one.on(problem.names) / sigma[one.joint] for one in problem.factors])
    stacked[:, -1] -= stacked[:, :-1] @ start
    T = np.asarray(np.linalg.qr(stacked, mode="r"))[: len(start)]
    return T[:, :-1], T[:, -1]


def _ball(found: Identification) -> Array:
    """A ball of the size of the robot's links. Its mass is the median of those that slides show, and of those that make
    first moments at the longest link's end.
    """
    robot, values = found.robot, found.full.solution.values
    lengths = [abs(float(length.value)) for length in robot.lengths if length.unit == "m"]
    size = max(lengths, default=0.0) or _LENGTH
    arms = {"M": 1.0, "MX": size, "MY": size, "MZ": size}
    masses = [
        abs(values[p.name]) / arms[stem]
        for p in found.regressors.model.base_parameters
        for stem in arms
        if p.name in (f"{stem}{p.joint}", f"{stem}{p.joint}R")
        if p.name in values and p.name not in found.full.solution.hidden
    ]
    some = [one for one in masses if one > _NONE * max(masses)]
    mass = float(np.median(some)) if some else _MASS
    return uniform_bar(mass, (0, 0, 0), (0, 0, 0), _PART * size * np.sqrt(5))


def _bodies(found: Identification, prior: Mapping[str, float] | None) -> dict[int, Array]:
    """Pseudo-inertias to keep to, by body."""
    numbers = [joint.number for joint in found.robot.bodies]
    if prior is None:
        return dict.fromkeys(numbers, _ball(found))
    result = {}
    for number in numbers:
        mass = prior[f"M{number}"]
        result[number] = of_body(number, prior) + np.diag([mass * _LEAST_RADIUS**2] * 3 + [0.0])
        if np.linalg.eigvalsh(result[number]).min() <= 0:
            place = found.robot.place
            raise InputError(place, f"body {number} of the prior is impossible", "a positive pseudo-inertia")
    return result
