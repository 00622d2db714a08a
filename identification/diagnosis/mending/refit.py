"""The parameters of the repaired robot: base parameters anew from the fitted runs, near what was known of them, beside
those of effects as they were found.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from generator.effects.library import names_of_effects
from generator.robot.description import ParameterSet
from generator.robot.parameters import INERTIAL_STEMS
from identification.arrays import Array
from identification.colour import inflation
from identification.diagnosis.columns.normal_equations import FAR, Normal, Prior
from identification.diagnosis.columns.payload_body import PARAMETERS
from identification.factors import Factor, added
from identification.least_squares import Problem, Solution
from identification.observation import Motion, Regressors
from identification.observed import Observed
from identification.outcome import Value
from identification.own_load import under_own_load
from identification.robot_file import rounded
from identification.sampling import Sampled
from identification.set_values import identified_values, shown_together

#: Name of the set in the robot file.
SET = "diagnosed"
#: Times that the rows are weighed by what the last fit left of them.
_PASSES = 6
#: Least residual [N m, N] by which rows are weighed: its square is a number.
_TINY = 1e-150
#: Samples at which a payload is compared with base parameters.
_SAMPLES = 80


@dataclass(frozen=True)
class Refit:
    """Base parameters by name with their standard deviations [SI], the set that holds them, what is to be told.

    What the runs do not show has an infinite standard deviation. Of that, what shows together with others has a value
    that only serves their torques, in the set with a standard deviation that tells nothing, and the rest no place in
    the set. ``regressors`` are those with the load that the parameters make. ``contradicted`` are, by name, those of
    bodies that are far from what was known of them.
    """

    values: Mapping[str, float]
    std: Mapping[str, float]
    parameter_set: ParameterSet
    regressors: Regressors
    notes: tuple[str, ...]
    contradicted: tuple[str, ...] = ()

    @property
    def written(self) -> dict[str, float]:
        """The base parameters as the set tells them, 0 where it leaves them out: what the rigid model plays with."""
        told = self.parameter_set.values
        return {name: rounded(told[name].value) if name in told else 0.0 for name in self.values}


def refit(
    runs: Sequence[Sampled],
    regressors: Regressors,
    prior: Prior | None = None,
    description: str = "",
    given: Mapping[str, Value] | None = None,
    held: bool = False,
) -> Refit:
    """The base parameters of ``regressors`` from runs, weighted by joint; ``prior`` is of the same base parameters.

    What was known was known less well where the runs contradict it, unless it is ``held``.
    Standard deviations allow for the colour of each joint's residuals (``colour.inflation``). Base parameters that are
    ``given`` stay as they are; how uncertain they are the others are too. Those of which a base parameter holds more
    are fitted like any other.
    """
    given = {name: one for name, one in (given or {}).items() if name in regressors.names}
    runs = _by_own_payloads(runs)
    payloads = [one.run.payload for one in runs if one.run.payload is not None]
    known = {name: value for payload in payloads for name, value in payload.fixed.items()}
    carried = [name for payload in payloads for name in payload.names().values()]
    sought = [name not in given for name in regressors.names]
    known |= {name: one.value or 0.0 for name, one in given.items()}
    free = tuple(dict.fromkeys(name for name in (*regressors.names, *carried) if name not in known))
    near = None if prior is None else prior.only(np.flatnonzero(sought))

    def fit(factors: tuple[Factor, ...]) -> Solution:
        solution = Problem(factors, free, known, weighted=True).solve()
        return solution if near is None else _near(near, factors, solution, {}, held)

    regressors, notes = under_own_load(runs, regressors, fit)
    observed = [Observed(one, regressors) for one in runs]
    factors = added([factor for one in observed for factor in one.factors])
    plain = fit(factors)
    if near is None:
        coloured = _coloured(plain, factors, observed)
    else:
        coloured = plain = _near(near, factors, plain, _colours(plain.values, observed), held)
    solution = replace(coloured, covariance=coloured.covariance + _brought(plain, factors, given))
    values = {name: solution.values[name] for name in regressors.names}
    std = {name: given[name].std if name in given else solution.std(name) for name in regressors.names}
    notes += _of_hidden([name for name in regressors.names if name in solution.hidden], values)
    names = ", ".join(dict.fromkeys(Path(one.run.name).name for one in runs))
    how = "least squares" if prior is None else "least squares near what was known"
    units = {parameter.name: parameter.unit for parameter in regressors.model.parameters if parameter.name in values}
    written = ParameterSet(
        SET,
        description or "base parameters with what the diagnosis found",
        f"diagnosed with the inverse dynamic model, weighted {how}, from {names}",
        identified_values(units, values, std.__getitem__, {}),
    )
    near_prior = {name: 0.0 if name in given else coloured.std(name) for name in regressors.names}
    far = () if prior is None else _far(prior, regressors, values, near_prior)
    return Refit(values, std, written, regressors, tuple(notes), far)


def _of_hidden(hidden: Sequence[str], values: Mapping[str, float]) -> list[str]:
    """What is to be told of parameters that the runs do not show: nothing of them at all, or not one by one."""
    out = [name for name in hidden if not values[name]]
    notes = [f"the runs do not show {' '.join(out)}, which the set leaves out: zero where it plays"] if out else []
    return notes + shown_together(hidden, values)


def _far(
    prior: Prior, regressors: Regressors, values: Mapping[str, float], std: Mapping[str, float]
) -> tuple[str, ...]:
    """Base parameters of bodies that are far from what was known."""
    found, deviations = (np.array([one[name] for name in regressors.names]) for one in (values, std))
    effects = names_of_effects(regressors.model.robot)
    far = prior.far(found, np.diag(deviations**2)) > FAR
    return tuple(name for name, is_far in zip(regressors.names, far, strict=True) if is_far and name not in effects)


def _by_own_payloads(runs: Sequence[Sampled]) -> list[Sampled]:
    """The runs, their payloads by names of their own: payloads of several runs may share one and be others."""
    different: list[Mapping[str, float]] = []
    result = []
    for one in runs:
        if (payload := one.run.payload) is not None:
            if payload.known not in different:
                different.append(payload.known)
            named = replace(payload, name=f"{payload.name}_{different.index(payload.known)}")
            one = replace(one, run=replace(one.run, payload=named))
        result.append(one)
    return result


def with_payload(prior: Prior, regressors: Regressors, payload: Mapping[str, float], std: Mapping[str, float]) -> Prior:
    """What is known of the base parameters once the last body carries a payload, and how well.

    ``payload`` holds coefficients of ``payload_body`` [SI].
    """
    to_base = _payload_in_base(regressors)
    for name, value in payload.items():
        direction = np.sum([to_base[:, INERTIAL_STEMS.index(stem)] for stem in PARAMETERS[name]], axis=0)
        prior = prior.shifted(direction, value, std.get(name, 0.0))
    return prior


def with_values(prior: Prior, regressors: Regressors, beyond: Mapping[str, Value]) -> Prior:
    """What is known of the base parameters where parameters of the file by name are other ones by so much [SI]."""
    for name, more in beyond.items():
        direction = np.array(regressors.model.grouping.coefficients(name))
        prior = prior.shifted(direction, more.value or 0.0, more.std)
    return prior


def _payload_in_base(regressors: Regressors) -> Array:
    """Base parameters per inertial parameter of a body in the tool frame (p x 10), by their torques."""
    shape = (regressors.model.dof, _SAMPLES)
    rng = np.random.default_rng(1)
    motion = Motion(*(rng.uniform(-1.5, 1.5, shape) for _ in range(3)))
    place = {name: k for k, name in enumerate(regressors.names)}
    W = np.zeros((*shape, len(place)))
    for row, names, columns in zip(W, regressors.structure, regressors.base(motion), strict=True):
        row[:, [place[name] for name in names]] = columns.T
    body = np.stack([columns.T for columns in regressors.payload(motion)])
    solution = np.linalg.lstsq(W.reshape(-1, len(place)), body.reshape(-1, len(INERTIAL_STEMS)), rcond=None)[0]
    return np.asarray(solution, dtype=float)


def _near(
    prior: Prior, factors: Sequence[Factor], start: Solution, colours: Mapping[int, float], held: bool
) -> Solution:
    """The solution with the prior's rows, each joint's rows weighed by what is left of them, less where that has a
    colour: by as much as ``colours`` inflate its variances, 1 where they tell nothing.

    Where the runs contradict what was known, and it is not ``held``, that was known less well by as much (Birge's
    ratio).
    """
    whole = prior.beside([0.0] * (len(start.names) - len(prior.mean)))
    given = {name: value for name, value in start.values.items() if name not in start.names}
    inflated = {one.joint: np.sqrt(colours.get(one.joint, 1.0)) for one in factors}
    result, sigma = start, dict(start.sigma)
    shown = [one for one in factors if one.rows]
    width = 1.0
    for _ in range(_PASSES):
        gram = np.zeros((len(start.names) + 1,) * 2)
        for one in shown:
            R = one.on(start.names)
            R[:, -1] -= one.on(tuple(given))[:, :-1] @ np.array(list(given.values()))
            gram += R.T @ R / (sigma[one.joint] * inflated[one.joint]) ** 2
        rows = sum(one.rows for one in shown)
        known = Prior(whole.mean, whole.precision / width)
        chi, covariance = Normal(gram, len(start.names), rows, known).solution([])
        away = chi - whole.mean
        spread = float(away @ whole.precision @ away) + float(np.sum(whole.precision * covariance))
        width = 1.0 if held else max(spread / max(int(whole.known.sum()), 1), 1.0)
        values = {**given, **dict(zip(start.names, chi.tolist(), strict=True))}
        sigma = sigma | {
            one.joint: _deviation(one, start.names, values, covariance, sigma[one.joint] * inflated[one.joint])
            for one in shown
        }
        unknown = tuple(name for name, one in zip(start.names, whole.known, strict=True) if not one)
        hidden = tuple(name for name in start.hidden if name in unknown)
        result = replace(start, values=values, covariance=covariance, hidden=hidden, sigma=sigma)
    return replace(result, sigma={joint: size * inflated.get(joint, 1.0) for joint, size in result.sigma.items()})


def _deviation(one: Factor, names: Sequence[str], values: Mapping[str, float], covariance: Array, was: float) -> float:
    """Standard deviation of a joint's rows about what ``values`` of all parameters give. The rows' freedom is less that
    which the fit of ``names`` took, which weighed them by the deviation that it ``was``.
    """
    R = one.on(names)[:, :-1] / was
    taken = float(np.sum((R @ covariance) * R))
    return max(one.residual(values) / float(np.sqrt(max(one.rows - taken, 1.0))), _TINY)


def _coloured(solution: Solution, factors: Sequence[Factor], observed: Sequence[Observed]) -> Solution:
    """The solution with the covariance that errors as coloured as the residuals leave, joint by joint."""
    C, colours = solution.covariance, _colours(solution.values, observed)
    more = np.zeros_like(C)
    for one in factors:
        R = one.on(solution.names)[:, :-1] / solution.sigma[one.joint]
        more += (colours[one.joint] - 1) * R.T @ R
    return replace(solution, covariance=C + C @ more @ C)


def _brought(solution: Solution, factors: Sequence[Factor], given: Mapping[str, Value]) -> Array:
    """The covariance of a solution's parameters that those bring which were ``given``, each by itself."""
    across = np.zeros((len(solution.names), len(given)))
    for one in factors:
        R, G = (one.on(names)[:, :-1] for names in (solution.names, tuple(given)))
        across += R.T @ G / solution.sigma[one.joint] ** 2
    moved = solution.covariance @ across * np.array([one.std for one in given.values()])
    return np.asarray(moved @ moved.T)


def _colours(values: Mapping[str, float], observed: Sequence[Observed]) -> dict[int, float]:
    """By how much the colour of each joint's residuals inflates variances, each run's own by its power."""
    power: dict[int, float] = defaultdict(float)
    coloured: dict[int, float] = defaultdict(float)
    for run in observed:
        errors: dict[int, list[Array]] = defaultdict(list)
        for one in run.rows():
            errors[one.joint].append(one.errors(values))
        for joint, parts in errors.items():
            e = np.concatenate(parts)
            power[joint] += float(e @ e)
            coloured[joint] += float(e @ e) * inflation(e)
    return {joint: coloured[joint] / size if size else 1.0 for joint, size in power.items()}
