"""Stiffness and torque constants from a tool pressed on a rigid stop with steps of force (report eq. 73-78).

The links stand still, so that what changes between two forces is the drive trains' twist: J^T dT = k dq_m, axis by
axis, and N^-T (J^T dT + Ia qdd) = kt di, motor by motor (the acceleration's term is that of report fig. 37), less dry
friction (``torque_constants``). A run is a pose; its mean stands for the weight and the preload. Components of the
wrench that a run does not hold do not change.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generator.derivation import derive
from generator.errors import InputError
from generator.robot.description import Robot
from identification import torque_constants
from identification.arrays import Array
from identification.colour import scatter
from identification.corrections import with_unit_constants
from identification.dataset import Run, load
from identification.drive_train import constants, coupling, motor_torques, stated_constants
from identification.filtering import decimated, derivative, kept_indices, kept_rows, smoothed
from identification.held import check_held
from identification.observation import generated_module
from identification.outcome import LIMIT, Value
from identification.recipes import Filters, Recipe
from identification.residuals import Residual
from identification.run_filters import filters_of, notes_of
from identification.shared_samples import unshared
from identification.signals import EFFORTS, WRENCH, NoColumns
from identification.torque_constants import Turning

#: The report: Butterworth of order 5 at 10 Hz, forward and backward.
RECIPE = Recipe(dynamics=4.0, cutoff=10.0, order=5)
#: Part of a pose's largest change of a joint torque from which another joint's change counts as the force's.
_LEVER = 0.05
#: Samples (at the decimated rate) after which the noise of a signal is another, and its steps are still the same.
_LAG = 4
#: Difference of two poses, in parts and in standard deviations, from which they contradict each other.
_APART, _DEVIATIONS = 0.2, 4.0
#: Part of a joint's largest speed from which its motor turns.
_TURNING = 0.2


@dataclass(frozen=True)
class Pose:
    """A run about its mean, filtered and decimated: positions ``q``, torques of the wrench (``wrench_torque``) and of
    the rotors' acceleration (``rotors``) on the joint side; currents ``i``, None without (n x N each).

    ``turning`` (n x N) is 1 where a motor turns forward, -1 where backward, 0 where it stands, nearly does, or its
    sample is unusable. ``at`` are the motors' mean positions (n), ``wrench`` is the whole wrench (6 x N), ``load`` the
    mean torques of the drive trains (n), weight included.
    """

    run: Run
    filters: Filters
    q: Array
    wrench_torque: Array
    rotors: Array
    i: Array | None
    turning: Array
    at: Array
    wrench: Array
    load: Array


@dataclass(frozen=True)
class ForceSteps:
    """Stiffness k and torque constants kt by name, with residuals by joint and by motor (from 0)."""

    robot: Robot
    poses: tuple[Pose, ...]
    components: tuple[str, ...]
    stiffness: Mapping[str, Value]
    constants: Mapping[str, Value]
    residuals: Mapping[int, Residual]
    motor_residuals: Mapping[int, Residual]
    notes: tuple[str, ...]

    @property
    def values(self) -> dict[str, Value]:
        """All that was found, by name."""
        return {**self.stiffness, **self.constants}


def force_steps(
    robot: Robot,
    sources: Sequence[str],
    inertias: Mapping[str, float] | None = None,
    recipe: Recipe = RECIPE,
    generated: Any = None,
) -> ForceSteps:
    """Values from the runs ``sources``, one a pose, each with columns of the wrench in the tool frame.

    ``inertias`` hold Iam or Ia of the joints by name, for the rotors' acceleration, which is left out without.
    Torque constants need currents in every run. ``generated`` is that of ``wrench_torque``, to be used again.

    Raises InputError for runs without a wrench, joints that move freely, and where no joint's stiffness shows.
    """
    runs = [_loaded(str(source), robot, recipe) for source in sources]
    unshared({"fit": [run for run, _ in runs]})
    components = tuple(name for name in WRENCH if any(name in run.others for run, _ in runs))
    generated = generated or wrench_torque(robot)
    Ia = _inertias(robot, inertias or {})
    poses = tuple(_pose(run, with_current, robot, recipe, Ia, generated) for run, with_current in runs)
    stiffness, _, _ = _stiffness(robot, poses, components)
    kt, _ = _constants(robot, poses)
    poses = tuple(_untwisted(_weighed(pose, kt, robot), stiffness, robot, generated) for pose in poses)
    stiffness, residuals, notes = _stiffness(robot, poses, components)
    if all(value.value is None for value in stiffness.values()):
        first = next(iter(stiffness.values())).refused
        raise InputError(runs[0][0].place, f"no joint's stiffness can be told: {first}", "steps of a measured force")
    kt, motor_residuals = _constants(robot, poses)
    if kt and not np.any(Ia):
        notes.append("torque constants without the rotors' acceleration: no inertia Iam or Ia was given")
    found = {j: one.value for j in robot.numbers if (one := kt.get(f"kt{j}")) and one.value is not None}
    notes += torque_constants.doubts(found, stated_constants(robot), "the wrench or the currents of the other sign")
    notes = [note for run, _ in runs for note in notes_of(run, recipe)] + notes
    return ForceSteps(robot, poses, components, stiffness, kt, residuals, motor_residuals, tuple(notes))


def _loaded(source: str, robot: Robot, recipe: Recipe) -> tuple[Run, bool]:
    """A run, and whether its efforts are N^T i of currents."""
    try:
        return load(source, with_unit_constants(robot), recipe.columns, ("i",), resting=True), True
    except NoColumns:
        return load(source, robot, recipe.columns, tuple(stem for stem in EFFORTS if stem != "i"), resting=True), False


def wrench_torque(robot: Robot) -> Any:
    """The generated module with the function wrench_torque(q, wrench)."""
    return generated_module(derive(robot, names=("wrench_torque",)))


def _inertias(robot: Robot, values: Mapping[str, float]) -> Array:
    numbers = robot.numbers
    return np.array([values.get(f"Iam{j}", values.get(f"Ia{j}", 0.0)) for j in numbers])


def _pose(run: Run, with_current: bool, robot: Robot, recipe: Recipe, Ia: Array, generated: Any) -> Pose:
    filters = filters_of(run, recipe)
    if not any(name in run.others for name in WRENCH):
        raise InputError(run.place, "there are no columns of the wrench", f"one at least of {' '.join(WRENCH)}")
    for k, joint in enumerate(robot.moving):
        check_held(run, k, joint, "a robot pressed on a stop")
    q = smoothed(run.q, filters.order, filters.cutoff, run.rate)
    qd = derivative(q, run.period)
    qdd = derivative(qd, run.period)
    wrench: Array = np.stack([run.others[name] if name in run.others else np.zeros(run.samples) for name in WRENCH])
    force = smoothed(wrench, filters.order, filters.cutoff, run.rate)
    signals = [q, force, Ia[:, None] * qdd]
    if with_current:
        current = motor_torques(robot, run.tau)
        signals.append(smoothed(current, filters.order, filters.cutoff, run.rate))
    inner = filters.inner(run.samples)
    signals = [decimated(one[:, inner], filters.factor) for one in signals]
    level, wrench, rotors = signals[:3]
    # Not of the decimated signal: the decimation's ripple shrinks a constant by 1 %.
    at = q[:, inner].mean(axis=1)
    i = _about_mean(signals[3]) if with_current else None
    held = _held(at, wrench, generated)
    unusable = np.zeros(run.q.shape, dtype=bool) if run.unusable is None else run.unusable
    turning = _turning(qd[:, inner], unusable[:, inner], filters)
    return Pose(
        run,
        filters,
        _about_mean(level),
        _about_mean(held),
        _about_mean(rotors),
        i,
        turning,
        at,
        wrench,
        run.tau.mean(axis=1),
    )


def _turning(qd: Array, unusable: NDArray[np.bool_], filters: Filters) -> Array:
    """Directions at the decimated samples, zero within half a period of the filter's cut-off from a standstill or from
    what is ``unusable``.
    """
    fast = (np.abs(qd) > _TURNING * np.abs(qd).max(axis=1, keepdims=True)) & ~unusable
    reach = round(filters.rate / filters.cutoff / 2)
    steady = np.array([kept_rows(~one, filters.factor, reach) for one in fast])
    result: Array = np.sign(qd[:, kept_indices(qd.shape[1], filters.factor)]) * steady
    return result


def _about_mean(x: Array) -> Array:
    result: Array = x - x.mean(axis=1, keepdims=True)
    return result


def _held(links: Array, wrench: Array, generated: Any) -> Array:
    """J^T wrench (n x N) for links that stand at ``links`` (n)."""
    result: Array = generated.wrench_torque(np.tile(links, (wrench.shape[1], 1)), wrench.T).T
    return result


def _weighed(pose: Pose, kt: Mapping[str, Value], robot: Robot) -> Pose:
    """The pose with the load that its mean currents carry, by the torque constants found, else the file's."""
    if pose.i is None:
        return pose
    N, values = coupling(robot), constants(robot)
    for m, joint in enumerate(robot.moving):
        found = kt.get(f"kt{joint.number}")
        values[m] = (found and found.value) or values[m]
    return replace(pose, load=N.T @ (values * np.linalg.solve(N.T, pose.load)))


def _untwisted(pose: Pose, stiffness: Mapping[str, Value], robot: Robot, generated: Any) -> Pose:
    """The pose with its links where their drive trains leave them, which is not where the motors are.

    A joint whose stiffness is not known follows its motor, as a wrist does that turns against the arm's twist.
    """
    links = pose.at[:, None] + pose.q
    for k, joint in enumerate(robot.moving):
        value = stiffness[f"k{joint.number}"].value
        if value:
            links[k] -= (pose.load[k] + pose.wrench_torque[k]) / value
    return replace(pose, wrench_torque=_about_mean(generated.wrench_torque(links.T, pose.wrench.T).T))


def _stiffness(
    robot: Robot, poses: Sequence[Pose], components: Sequence[str]
) -> tuple[dict[str, Value], dict[int, Residual], list[str]]:
    values: dict[str, Value] = {}
    residuals: dict[int, Residual] = {}
    notes: list[str] = []
    for k, joint in enumerate(robot.moving):
        name, unit = f"k{joint.number}", joint.stiffness_unit
        shown = [one for one in poses if _changes(one.wrench_torque, k)]
        if not shown:
            why = f"{' '.join(components)} has no lever arm about joint {joint.number} in any pose"
            values[name] = Value.unknown(unit, why)
            continue
        slope, residuals[k] = _slope([one.q[k] for one in shown], [one.wrench_torque[k] for one in shown])
        values[name] = _stiff(_value(slope, unit))
        notes += _contradictions(name, slope, [(one.run.name, one.q[k], one.wrench_torque[k]) for one in shown])
    return values, residuals, notes


def _constants(robot: Robot, poses: Sequence[Pose]) -> tuple[dict[str, Value], dict[int, Residual]]:
    values: dict[str, Value] = {}
    residuals: dict[int, Residual] = {}
    if any(one.i is None for one in poses):
        return values, residuals
    to_motors = np.asarray(np.linalg.inv(coupling(robot)).T, dtype=float)
    for m, joint in enumerate(robot.moving):
        name = f"kt{joint.number}"
        pressed = [one for one in poses if one.i is not None and _changes(one.wrench_torque, m)]
        if not pressed:
            why = f"the measured force asks nothing of motor {joint.number} in any pose"
            values[name] = Value.unknown("N m/A", why)
            continue
        try:
            kt, std, residuals[m] = torque_constants.torque_constant([_of_motor(one, m, to_motors) for one in pressed])
        except ValueError as error:
            values[name] = Value.unknown("N m/A", str(error))
            continue
        values[name] = _value((kt, std), "N m/A")
    return values, residuals


def _of_motor(pose: Pose, m: int, to_motors: Array) -> Turning:
    assert pose.i is not None
    turning = pose.turning[m] != 0
    tau = (to_motors @ (pose.wrench_torque + pose.rotors))[m]
    return Turning(pose.i[m, turning], tau[turning], pose.q[m, turning], pose.turning[m, turning])


def _changes(held: Array, k: int) -> bool:
    """Whether the wrench changes torque ``k`` of a pose by enough."""
    size = held.std(axis=1)
    return bool(size[k] > _LEVER * size.max(initial=0.0) > 0)


def _slope(x: Sequence[Array], y: Sequence[Array]) -> tuple[tuple[float, float], Residual]:
    """y = slope x of several poses, each about its mean: slope with its standard deviation, and what is left.

    The instrument is x itself some samples before and after: least squares would come out too small, as x is noisy too.
    """
    inner = slice(_LAG, -_LAG)
    Z = [(one[: -2 * _LAG] + one[2 * _LAG :]) / 2 for one in x]
    X, Y = ([one[inner] for one in some] for some in (x, y))
    rows, size = sum(map(len, Y)), float(np.linalg.norm(np.concatenate(Y)))
    power = sum(float(z @ one) for z, one in zip(Z, X, strict=True))
    if not power:
        return (0.0, np.inf), Residual(rows, size, size, size)
    slope = sum(float(z @ one) for z, one in zip(Z, Y, strict=True)) / power
    errors = [theirs - slope * ours for ours, theirs in zip(X, Y, strict=True)]
    std = scatter(Z, errors, len(x) + 1) / abs(power)
    return (slope, std), Residual(rows, float(np.linalg.norm(np.concatenate(errors))), size, size)


def _value(slope: tuple[float, float], unit: str) -> Value:
    value, std = slope
    relative = std / abs(value) if value else np.inf
    if relative > LIMIT:
        return Value.unknown(unit, f"relative std {100 * relative:.3g} %")
    return Value(value, std, unit)


def _stiff(one: Value) -> Value:
    """A stiffness, refused where it is negative."""
    if one.value is None or one.value > 0:
        return one
    return Value.unknown(one.unit, "the joint turns against the force; is the wrench's sign right?")


def _contradictions(name: str, pooled: tuple[float, float], poses: Sequence[tuple[str, Array, Array]]) -> list[str]:
    """Poses whose own value is far from that of all together: their links moved, or a component was not measured."""
    notes = []
    for run, x, y in poses if len(poses) > 1 else ():
        (value, std), _ = _slope([x], [y])
        distance = abs(value - pooled[0])
        if distance > _APART * abs(pooled[0]) and distance > _DEVIATIONS * std:
            notes.append(f"{run}: {name} is {value:.4g} in this pose alone, far from {pooled[0]:.4g} of all")
    return notes
