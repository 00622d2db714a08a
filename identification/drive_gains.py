"""Drive gains of all motors at once, from runs without and with a payload of known mass (report section 3.2).

Where a gain cannot be told from the parameters of the model its motor is left out, and named: the others do not suffer
from it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from identification import recipes, torque_constants
from identification.arrays import Array
from identification.corrections import with_unit_constants
from identification.dataset import Run, load
from identification.drive_train import coupling, stated_constants
from identification.motor_rows import MotorRows, motor_rows
from identification.observation import Regressors
from identification.outcome import LIMIT
from identification.own_load import settled
from identification.recipes import Recipe
from identification.residuals import Residual, Residuals
from identification.run_filters import filters_of, notes_of
from identification.sampling import SPOILED, Sampled, sampled
from identification.shared_samples import unshared
from identification.sidecar import Payload, by_name, check_carried
from identification.total_least_squares import Fit, Part, solve

#: Step of a payload's known value for its derivative, in standard deviations.
_STEP = 0.5
#: Largest standard deviation [SI] of a value that is zero: beyond, sums overflow.
_LARGEST = 1e12
#: Unexplained part of a motor's torque [%] that is told.
_DOUBTFUL = 50.0


@dataclass(frozen=True)
class MotorTorque:
    """Rows of a motor (from 0) in a run: times [s], kt i as measured and as estimated [N m] (rows each)."""

    run: str
    motor: int
    t: Array
    measured: Array
    estimated: Array


@dataclass(frozen=True, kw_only=True)
class DriveGains:
    """Torque constants and parameters with their standard deviations, by motor (from 0) and by name.

    ``constants`` [N m/A] lack the ``refused`` motors, for each of which the reason is told. ``payload_share`` is the
    part of each relative standard deviation that comes from the payload's. Parameters that nothing shows have an
    infinite standard deviation. ``torques`` and ``residuals`` are on the motor side [N m].
    """

    regressors: Regressors
    recipe: Recipe
    empty: tuple[Sampled, ...]
    loaded: tuple[Sampled, ...]
    constants: Mapping[int, tuple[float, float]]
    refused: Mapping[int, str]
    payload_share: Mapping[int, float]
    payload_std: Mapping[str, float]
    parameters: Mapping[str, tuple[float, float]]
    torques: tuple[MotorTorque, ...]
    residuals: Residuals
    separation: float
    condition: float
    notes: tuple[str, ...]

    @property
    def robot(self) -> Robot:
        """The robot as its file says."""
        return self.regressors.model.robot

    @property
    def coupling(self) -> Array:
        """N (n x n): motor speeds from joint speeds."""
        return coupling(self.robot)

    def gain(self, motor: int) -> tuple[float, float]:
        """g_tau = N_jj kt_j of a motor and its standard deviation [N m/A, N/A] (report eq. 16)."""
        value, std = self.constants[motor]
        ratio = float(self.coupling[motor, motor])
        return ratio * value, abs(ratio) * std


def drive_gains(
    robot: Robot,
    empty: Sequence[str],
    loaded: Sequence[str],
    payload: Payload | None = None,
    payload_std: Mapping[str, float] | None = None,
    recipe: Recipe | None = None,
    regressors: Regressors | None = None,
) -> DriveGains:
    """Gains from runs ``empty`` and ``loaded``, whose efforts are currents.

    ``payload`` is that of loaded runs whose sidecar tells none, and contradicts no other; at least one of its values
    must be known.
    ``payload_std`` are standard deviations of known values by stem [SI].

    Raises InputError for runs without currents, loaded ones without a payload, empty ones with one, for a standard
    deviation larger than its value is, but for zero, and where the known values of the payload show in no torque.
    """
    recipe = recipe or recipes.recipe_of(robot.name)
    if robot.drives is None:
        raise InputError(robot.place, f"{robot.name} has no drives", "gear ratios, to know what currents do")
    N = coupling(robot)
    as_current = with_unit_constants(robot)
    unloaded, carrying = ([_run(source, as_current, recipe) for source in sources] for sources in (empty, loaded))
    for run in unloaded:
        _check_empty(run)
    carrying = [_carrying(run, payload) for run in carrying]
    stds = dict(payload_std or {})
    _check_known(carrying, stds)
    check_carried(payload, [run.payload for run in carrying])
    runs = [*unloaded, *carrying]
    unshared({"fit": runs})
    given = regressors or Regressors(robot)
    seen = [sampled(run, recipe, given) for run in runs]
    regressors, told = settled(given, lambda with_load: _found(seen, with_load, carrying[0], stds))
    found = _found(seen, regressors, carrying[0], stds)
    constants = {m: (float(found.fit.k[m]), found.gain_std(m)) for m in range(len(N)) if m not in found.refused}
    share = {m: abs(found.from_payload[m] / value) if value else 0.0 for m, (value, _) in constants.items()}
    residuals = _residuals(found.fit, found.parts)
    notes = [*(note for run in runs for note in notes_of(run, recipe)), *told, *_doubts(residuals, constants, robot)]
    return DriveGains(
        regressors=regressors,
        recipe=recipe,
        empty=tuple(seen[: len(empty)]),
        loaded=tuple(seen[len(empty) :]),
        constants=constants,
        refused=found.refused,
        payload_share=share,
        payload_std=stds,
        parameters={name: (found.values[name], found.std(name)) for name in found.names},
        torques=_torques(found.fit, found.rows, found.refused, found.parts),
        residuals=residuals,
        separation=found.fit.separation,
        condition=found.fit.condition,
        notes=tuple(notes),
    )


Observations = Sequence[tuple[Sampled, Sequence[MotorRows]]]


@dataclass(frozen=True)
class _Found:
    """The ``fit`` of the ``rows`` with all parameters ``every`` (p), of which the ``known`` ones [SI] are given.

    ``from_payload`` are standard deviations of [k, chi] that come from the payload's known values; ``refused`` motors
    have no part in it.
    """

    rows: Observations
    every: tuple[str, ...]
    known: Mapping[str, float]
    fit: Fit
    refused: Mapping[int, str]
    parts: Sequence[Part]
    from_payload: Array

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(name for name in self.every if name not in self.known)

    @property
    def values(self) -> Mapping[str, float]:
        return dict(zip(self.every, self.fit.chi.tolist(), strict=True)) | dict(self.known)

    @property
    def hidden(self) -> tuple[str, ...]:
        return tuple(name for name in self.names if self.fit.hidden[self.every.index(name)])

    def std(self, name: str) -> float:
        return np.inf if name in self.hidden else self._deviation(len(self.fit.k) + self.every.index(name))

    def gain_std(self, motor: int) -> float:
        return self._deviation(motor)

    def _deviation(self, k: int) -> float:
        return float(np.sqrt(self.fit.covariance[k, k] + self.from_payload[k] ** 2))


def _found(seen: Sequence[Sampled], regressors: Regressors, loaded: Run, stds: Mapping[str, float]) -> _Found:
    """The fit of all runs with the load that ``regressors`` have; ``loaded`` is the run to tell where there is none."""
    robot, runs = regressors.model.robot, [one.run for one in seen]
    N, names = coupling(robot), _names(regressors, runs)
    rows = [(one, motor_rows(one, regressors, N, names)) for one in seen]
    fit, refused, parts, from_payload = _observable(rows, names, len(N), robot, loaded, stds)
    return _Found(rows, names, _known(runs), fit, refused, parts, from_payload)


def _run(source: str, robot: Robot, recipe: Recipe) -> Run:
    run = load(str(source), robot, recipe.columns, ("i",))
    filters_of(run, recipe)
    return run


def _check_empty(run: Run) -> None:
    if run.payload is not None:
        raise InputError(run.place, f"payload {run.payload.name} is on a run that counts as empty", "a run without any")


def _carrying(run: Run, payload: Payload | None) -> Run:
    if run.empty:
        raise InputError(run.place, "no payload is on a run that counts as loaded", "a run with one")
    run = run.carrying(payload)
    if run.payload is None:
        raise InputError(run.place, "nothing tells the payload of this run", "payload: {M: ... kg} in its sidecar")
    if not any(run.payload.known.values()):
        raise InputError(run.place, f"nothing is known of payload {run.payload.name}", "its mass or first moments")
    return run


def _check_known(loaded: Sequence[Run], stds: Mapping[str, float]) -> None:
    if not loaded:
        raise ValueError("no loaded run")
    by_name((run.place, run.payload) for run in loaded)
    for run in loaded:
        assert run.payload is not None
        for stem, std in stds.items():
            if stem not in run.payload.known:
                problem = f"{stem} of payload {run.payload.name} is not known"
                raise InputError(
                    command_line("--payload-std"), problem, f"a value {stem}=VALUE of which this is the std"
                )
            if not std <= (most := abs(run.payload.known[stem]) or _LARGEST):
                raise InputError(command_line("--payload-std"), f"{stem}={std:g}", f"{most:g} at most")


def _names(regressors: Regressors, runs: Sequence[Run]) -> tuple[str, ...]:
    """Base parameters, then all ten of each payload."""
    names = dict.fromkeys(regressors.names)
    for run in runs:
        if run.payload is not None:
            names |= dict.fromkeys(run.payload.names().values())
    return tuple(names)


def _known(runs: Sequence[Run]) -> dict[str, float]:
    """Values [SI] of all payloads' parameters that are known."""
    carried = [run.payload for run in runs if run.payload is not None]
    return {name: value for payload in carried for name, value in payload.fixed.items()}


def _parts(
    rows: Observations, names: Sequence[str], left_out: Mapping[int, str], more: Mapping[str, float]
) -> list[Part]:
    """The rows with the payloads' known values, plus ``more`` by parameter name, in w."""
    result = []
    every = _known([one.run for one, _ in rows])
    free = np.array([name not in every for name in names])
    for one, each in rows:
        known = np.zeros(len(names))
        payload = one.run.payload
        if payload is not None:
            for name, value in payload.fixed.items():
                known[names.index(name)] = value + more.get(name, 0.0)
        for motor in each:
            if motor.motor not in left_out:
                result.append(Part(motor.motor, motor.B * free, motor.B @ known, motor.i))
    return result


def _observable(
    rows: Observations, names: Sequence[str], n: int, robot: Robot, first: Run, stds: Mapping[str, float]
) -> tuple[Fit, dict[int, str], list[Part], Array]:
    """The fit of all motors whose gain can be told, why that of the others cannot, and what comes ``_of_payload``."""
    refused: dict[int, str] = {}
    too_loose = False
    for m in range(n):
        if not any(len(each[m].i) for _, each in rows):
            spoiled = any(one.spoiled(m) for one, _ in rows)
            slow = "its joint is never faster than the standstill threshold"
            refused[m] = f"it has no rows: {SPOILED if spoiled else slow}"
    while len(refused) < n:
        parts = _parts(rows, names, refused, {})
        fit = solve(parts, n)
        if fit.scale == 0.0:
            break
        live = [m for m in range(n) if m not in refused]
        from_payload = np.zeros(n + len(names))
        relative = _relative(fit, from_payload)
        shown = bool(np.all(relative[live] <= LIMIT))
        if fit.unsettled and np.all(relative[live] <= LIMIT * fit.misfit[live]):
            problem = f"no drive gain of {robot.name} can be told: the currents contradict what is known of the payload"
            raise InputError(first.place, problem, "currents of all motors and the payload of one and the same run")
        if shown:
            from_payload = _of_payload(rows, names, fit, refused, stds)
            relative = _relative(fit, from_payload)
        worst = max(live, key=lambda m: relative[m])
        if relative[worst] <= LIMIT:
            return fit, refused, parts, from_payload
        size = f"{100 * relative[worst]:.3g} %" if np.isfinite(relative[worst]) else "infinite"
        lack = "is not exact enough" if shown else "does not show in its torque"
        refused[worst] = f"what is known of the payload {lack} (relative std {size})"
        too_loose = shown
    if too_loose:
        problem = f"no drive gain of {robot.name} can be told: what is known of the payload is not exact enough"
        raise InputError(command_line("--payload-std"), problem, f"one gain within {100 * LIMIT:g} % at least")
    problem = f"no drive gain of {robot.name} can be told: the currents do not show what is known of the payload"
    expected = "loaded runs on which it is mounted and moves against gravity, and its mass or first moments"
    raise InputError(first.place, problem, expected)


def _relative(fit: Fit, more: Array) -> Array:
    """Relative standard deviations of the gains (n), with ``more`` of [k, chi] beside those of the fit."""
    n = len(fit.k)
    std = np.sqrt(np.diag(fit.covariance)[:n] + more[:n] ** 2)
    result: Array = np.where(fit.k != 0, std / np.maximum(np.abs(fit.k), 1e-300), np.inf)
    return result


def _of_payload(
    rows: Observations, names: Sequence[str], fit: Fit, refused: Mapping[int, str], stds: Mapping[str, float]
) -> Array:
    """Standard deviations of [k, chi] that come from those of the payloads' known values, each on its own."""
    square = np.zeros(len(fit.k) + len(fit.chi))
    payloads = [one.run.payload for one, _ in rows if one.run.payload is not None]
    by_name = {payload.names()[stem]: std for payload in payloads for stem, std in stds.items() if std}
    for name, std in by_name.items():
        ends = [solve(_parts(rows, names, refused, {name: sign * _STEP * std}), len(fit.k)) for sign in (1, -1)]
        change = np.concatenate([ends[0].k, ends[0].chi]) - np.concatenate([ends[1].k, ends[1].chi])
        square += (change / (2 * _STEP)) ** 2
    result: Array = np.sqrt(square)
    return result


def _torques(
    fit: Fit, rows: Observations, refused: Mapping[int, str], parts: Sequence[Part]
) -> tuple[MotorTorque, ...]:
    """Of all motors that are not refused, in the order of ``parts``."""
    origins = [(one.run.name, motor) for one, each in rows for motor in each if motor.motor not in refused]
    return tuple(
        MotorTorque(run, motor.motor, motor.t, measured, measured - fit.errors(part))
        for (run, motor), part in zip(origins, parts, strict=True)
        for measured in [fit.k[motor.motor] * part.i]
    )


def _residuals(fit: Fit, parts: Sequence[Part]) -> Residuals:
    found: dict[int, Residual] = {}
    for m in sorted({one.gain for one in parts}):
        mine = [one for one in parts if one.gain == m]
        error = np.concatenate([fit.errors(one) for one in mine])
        tau = fit.k[m] * np.concatenate([one.i for one in mine])
        found[m] = Residual.of(error, tau)
    return Residuals(found)


def _doubts(residuals: Residuals, constants: Mapping[int, tuple[float, float]], robot: Robot) -> list[str]:
    notes = [
        f"motor {robot.moving[m].number}: {one.relative_to_mean:.0f} % of its torque's spread is unexplained"
        for m, one in residuals.per_joint.items()
        if one.relative_to_mean > _DOUBTFUL
    ]
    found = {robot.moving[m].number: value for m, (value, _) in constants.items()}
    exchanged = "the empty and the loaded runs exchanged, or the currents of the other sign"
    return notes + torque_constants.doubts(found, stated_constants(robot), exchanged)
