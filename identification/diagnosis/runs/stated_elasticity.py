"""Drive trains that the robot's file says give way: what they add to the torques of rigid joints.

With q the motors' positions over the gears and q + e the links', M e'' + (C + D) e' + K e = -tau, M and tau those of
the links alone along q, C what tau changes by with the speeds: an inertia that grows slows a link down (report eq. 7,
8). All joints of the file at once: their swings pull at each other. What the motors supply more than for rigid joints
is one column; how it changes with each stiffness and each damping, which no file states, are others. They are fitted
with the base parameters: where the runs are of a rigid robot they come out as zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.runs.link_side import Train, link_side, without_drive_train
from identification.diagnosis.runs.perturbation import alone, quicker, sensitivity
from identification.diagnosis.runs.rotor import rotor_inertia, told
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion

#: The column of all drive trains without a gap.
TOGETHER = "elasticity"
#: That of one with a gap, by the joint's number after it.
BOUNCING = "backlash"
#: What a drive train may differ in from the file's, and by how much, in the standard deviation of the logarithm.
_ABOUT = {"stiffness": 0.5, "damping": 1.5, "gap": 0.3}
#: Damping ratio of the link on its drive train, and the factor by which another one is tried.
_DAMPING, _MORE_DAMPED = 0.03, 3.0
#: Factor of a stiffness, and of a gap, by which columns say how the torque changes with them.
_STIFFER, _WIDER = 1.02, 1.1
#: Largest step of the logarithms of a stiffness, a damping or a gap, and the least part of the torque that must show.
_STEP, _SHOWN = 0.3, 0.2
#: Time [s] in which the inertia matrix hardly changes.
_HELD = 0.02


@dataclass(frozen=True)
class Stated:
    """A drive train of the file: coordinate ``k`` of joint ``number``, stiffness [N m/rad, N/m], gap [rad, m]."""

    k: int
    number: int
    stiffness: float
    gap: float = 0.0


def stated(robot: Robot) -> list[Stated]:
    """The drive trains whose stiffness a parameter set of the file tells, the first one that does."""
    gaps = {
        number: float(use.values["gap"].value)
        for use in robot.effects
        if use.effect == "joint_elasticity" and "gap" in use.values
        for number in use.joints
    }
    found = []
    for k, joint in enumerate(robot.moving):
        stiffness = told(robot, f"k{joint.number}")
        if joint.number in robot.flexible and stiffness is not None and stiffness > 0:
            found.append(Stated(k, joint.number, stiffness, gaps.get(joint.number, 0.0)))
    return found


def names(robot: Robot) -> tuple[str, ...]:
    """Of the columns: of all drive trains without a gap together, then of what they may differ in."""
    plain, loose = _plain_and_loose(robot)
    together = [TOGETHER] if plain else []
    return (
        *together,
        *(f"{what}{one.number}" for one in plain for what in ("stiffness", "damping")),
        *(name for one in loose for name in names_of_backlash(one.number)),
    )


def bouncing(robot: Robot) -> tuple[str, ...]:
    """Those of ``names`` whose torque the smallest error of the motion changes: how a link bounces in its gap."""
    return tuple(name for one in _plain_and_loose(robot)[1] for name in names_of_backlash(one.number))


def names_of_backlash(number: int) -> tuple[str, ...]:
    """Those of ``names`` that are of a drive train with a gap."""
    return tuple(f"{what}{number}" for what in (BOUNCING, "stiffness", "damping", "gap"))


def moved(old: Mapping[str, float], new: Mapping[str, float]) -> dict[str, float]:
    """Values by name, those of ``names`` as the logarithms of what stiffness, damping and gap are of the file's.

    The columns of which ``new`` holds the weights are about ``old``; where the torque hardly shows nothing moves.
    """
    result = dict(new)
    for name in new:
        what = name.rstrip("0123456789")
        if what in _ABOUT:
            number = name.removeprefix(what)
            whole = new.get(f"{BOUNCING}{number}", new.get(TOGETHER, 0.0))
            step = np.clip(new[name] / whole, -_STEP, _STEP) if whole > _SHOWN else 0.0
            result[name] = old.get(name, 0.0) + float(step)
    return result


def weights(scene: Scene) -> dict[str, float]:
    """Of the torques of the drive trains without a gap by the scene's values: how links bounce in gaps no small error
    changes by little.
    """
    plain, _ = _plain_and_loose(scene.robot)
    return {TOGETHER: scene.values.get(TOGETHER, 0.0)} if plain else {}


def damped(number: int, ratio: float) -> dict[str, float]:
    """The value by its name in ``names`` that says the damping ratio of the drive train of a joint by its number."""
    return {f"damping{number}": float(np.log(ratio / _DAMPING))}


def torque(scene: Scene) -> Array:
    """What the file's drive trains add to the torques (n x N) [N m, N] of rigid joints along a scene, by its values:
    nothing where these do not say how much of it shows.
    """
    result = np.zeros_like(scene.motion.q)
    plain, loose = _plain_and_loose(scene.robot)
    if plain and (shown := scene.values.get(TOGETHER, 0.0)):
        (usual,) = _Links(scene, plain).torques(*(each[None] for each in _factors(scene, plain)))
        result += shown * usual
    for one in loose:
        if shown := scene.values.get(f"{BOUNCING}{one.number}", 0.0):
            result += shown * next(_loose(scene, one))
    return result


def precision(name: str) -> float:
    """Of one of ``names`` beforehand: whether the runs show any elasticity nobody knows."""
    std = _ABOUT.get(name.rstrip("0123456789"))
    return std**-2 if std else 0.0


def columns(scene: Scene) -> Array:
    """Torques (c x n x N) [N m, N] of ``names`` along a scene, by its values."""
    if not any(scene.values.values()):
        return np.zeros((len(names(scene.robot)), *scene.motion.q.shape))
    plain, loose = _plain_and_loose(scene.robot)
    result = [*_together(scene, plain), *(each for one in loose for each in _loose(scene, one))]
    return np.stack(result) if result else np.empty((0, *scene.motion.q.shape))


def _plain_and_loose(robot: Robot) -> tuple[list[Stated], list[Stated]]:
    """The drive trains of the file without a gap, and those with one."""
    trains = stated(robot)
    return [one for one in trains if not one.gap], [one for one in trains if one.gap]


def _together(scene: Scene, trains: Sequence[Stated]) -> Iterator[Array]:
    if not trains:
        return
    links = _Links(scene, trains)
    m = len(trains)
    stiffness, damping = (np.tile(each, (1 + 2 * m, 1)) for each in _factors(scene, trains))
    for j in range(m):
        stiffness[1 + 2 * j, j] *= _STIFFER
        damping[2 + 2 * j, j] *= _MORE_DAMPED
    usual, *others = links.torques(stiffness, damping)
    yield usual
    for i, other in enumerate(others):
        yield (other - usual) / np.log(_STIFFER if i % 2 == 0 else _MORE_DAMPED)


def _loose(scene: Scene, one: Stated) -> Iterator[Array]:
    """Alone: what crosses a gap is not linear in its load. A link too light for its stiffness swings faster than the
    samples follow, and adds nothing.
    """
    side = link_side(scene, one.k, rotor_inertia(scene, one.k))
    own = [_factor(scene, what, one) for what in _ABOUT]

    def train(stiffer: float = 1.0, damped: float = 1.0, wider: float = 1.0) -> Train:
        return Train(one.stiffness * own[0] * stiffer, _DAMPING * own[1] * damped, one.gap * own[2] * wider)

    if not side.follows(train(stiffer=_STIFFER)):
        yield from np.zeros((4, *scene.motion.q.shape))
        return

    def torque(**other: float) -> Array:
        return side.torque_per(side.deflection(train(**other)))

    usual = torque()
    yield usual
    yield (torque(stiffer=_STIFFER) - usual) / np.log(_STIFFER)
    yield (torque(damped=_MORE_DAMPED) - usual) / np.log(_MORE_DAMPED)
    yield (torque(wider=_WIDER) - usual) / np.log(_WIDER)


def _factors(scene: Scene, trains: Sequence[Stated]) -> tuple[Array, Array]:
    """Those of the trains' stiffnesses and dampings (m each)."""
    stiffness, damping = (np.array([_factor(scene, what, one) for one in trains]) for what in ("stiffness", "damping"))
    return stiffness, damping


def _factor(scene: Scene, what: str, one: Stated) -> float:
    return float(np.exp(scene.values.get(f"{what}{one.number}", 0.0)))


@dataclass(frozen=True)
class _Links:
    """The links past the drive trains of m coordinates."""

    scene: Scene
    trains: Sequence[Stated]

    @cached_property
    def at(self) -> list[int]:
        """Coordinates (m)."""
        return [one.k for one in self.trains]

    @cached_property
    def values(self) -> dict[str, float]:
        """Base parameters without what turns with the motors."""
        scene = self.scene
        for k in self.at:
            rotor = rotor_inertia(self.scene, k)
            scene = Scene(scene.sampled, scene.regressors, without_drive_train(scene, k, rotor))
        return dict(scene.values)

    def torque_on(self, motion: Motion) -> Array:
        """Torques (n x N) of all but the drive trains."""
        return self.scene.torque_of(self.values, motion)

    @cached_property
    def samples_per_inertia(self) -> int:
        """Samples for which the inertia matrix is taken as constant."""
        return max(round(_HELD / self.scene.period), 1)

    @cached_property
    def held(self) -> Motion:
        """One sample in ``samples_per_inertia``, the middle one of them."""
        count, last = self.samples_per_inertia, self.scene.motion.samples - 1
        return self.scene.motion.at(np.minimum(np.arange(0, last + 1, count) + count // 2, last))

    @cached_property
    def drag(self) -> Array:
        """Change of the loads per unit of the links' speeds (C x m x m), as the inertia."""
        changes = [sensitivity(self.torque_on, self.held, alone(self.held, k, (0.0, 1.0, 0.0))) for k in self.at]
        return np.stack([change[self.at].T for change in changes], axis=-1)

    @cached_property
    def inertia(self) -> Array:
        """Of the links (C x m x m), once in ``samples_per_inertia``."""
        still = self.torque_on(self.held)
        result = np.stack([(self.torque_on(quicker(self.held, k)) - still)[self.at].T for k in self.at], axis=-1)
        # Values that hardly show may make too little inertia: nothing swings too fast for the samples.
        root = np.sqrt([one.stiffness for one in self.trains])
        scaled = (result + result.transpose(0, 2, 1)) / (2 * np.outer(root, root))
        times, modes = np.linalg.eigh(scaled)
        slow = np.maximum(times, self.scene.period**2)
        return np.asarray((modes * slow[:, None]) @ modes.transpose(0, 2, 1) * np.outer(root, root))

    def torques(self, stiffness: Array, damping: Array) -> Iterator[Array]:
        """What the motors supply more (n x N) for V combinations of factors (V x m) of the stiffnesses and dampings."""
        K = stiffness * [one.stiffness for one in self.trains]
        M = np.mean(np.diagonal(self.inertia, axis1=1, axis2=2), axis=0)
        D = 2 * _DAMPING * damping * np.sqrt(K * M)
        for e in self._deflections(K, D):
            yield sensitivity(self.torque_on, self.scene.motion, alone(self.scene.motion, self.at, e))

    def _deflections(self, K: Array, D: Array) -> Iterator[Array]:
        """Positions, speeds and accelerations (3 x m x N) of the links against the motors, for each of V combinations
        (V x m each).

        Of x' = F x + g, the rule of order four with two derivatives at both ends of a step, which no stiffness makes
        unstable: x+ - x = h/2 (x'+ + x') - h^2/12 (x''+ - x'').
        """
        h, N = self.scene.period, self.scene.motion.samples
        V, m = K.shape
        load = self.torque_on(self.scene.motion)[self.at].T
        each = np.arange(N) // self.samples_per_inertia
        inverse = np.linalg.inv(self.inertia)
        F = np.zeros((len(inverse), V, 2 * m, 2 * m))
        F[..., :m, m:] = np.eye(m)
        slows = self.drag[:, None] + D[:, None] * np.eye(m)
        F[..., m:, :m], F[..., m:, m:] = -inverse[:, None] * K[:, None], -inverse[:, None] @ slows
        even = np.eye(2 * m) + F @ F * (h * h / 12)
        P = np.linalg.inv(even - F * (h / 2))
        A = P @ (even + F * (h / 2))
        # Blocks of samples with one inertia: what drives a step is that of its end.
        blocks = np.zeros((len(inverse) * self.samples_per_inertia, 2 * m, 2))
        g = np.zeros((N, 2 * m))
        g[:, m:] = -(inverse[each] @ load[..., None])[..., 0]
        blocks[1:N] = np.stack([(g[1:] + g[:-1]) * (h / 2), (g[1:] - g[:-1]) * (h * h / 12)], axis=-1)
        in_blocks = blocks.reshape(len(inverse), 1, self.samples_per_inertia, 2 * m, 2).swapaxes(2, 3)
        mean, change = np.moveaxis(in_blocks, -1, 0)
        b = P @ mean - (P @ F) @ change
        x = np.empty((N, V, 2 * m, 1))
        # The log does not tell how the links swing when it begins: they hang still on their springs.
        x[0, :, :m, 0], x[0, :, m:, 0] = -load[0] / K, -(load[1] - load[0]) / (h * K)
        for t in range(1, N):
            block, i = divmod(t, self.samples_per_inertia)
            np.matmul(A[block], x[t - 1], out=x[t])
            x[t, ..., 0] += b[block, ..., i]
        for v in range(V):
            e, speed = x[:, v, :m, 0], x[:, v, m:, 0]
            pull = load + (slows[each, v] @ speed[..., None])[..., 0] + K[v] * e
            acceleration = -(inverse[each] @ pull[..., None])[..., 0]
            yield np.stack([e.T, speed.T, acceleration.T])
