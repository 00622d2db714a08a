"""The robot on the link side of one joint's drive train, where the log has the motor's motion.

With q_l = q + e the link's position and q the motor's over the gear, what the motor must supply changes by
(dtau_link/dq) e + (dtau_link/dqd) e' + (dtau_link/dqdd) e'' (report eq. 7, 8). The drive train's own inertia and
friction turn with the motor and do not see e.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from generator.symbolic.model import Model
from identification.arrays import Array
from identification.diagnosis.runs.link_steps import (
    STABLE,
    STABLE_IN_GAPS,
    Link,
    Spring,
    Value,
    played,
    torques_in_gaps,
)
from identification.diagnosis.runs.perturbation import alone, quicker, sensitivity
from identification.diagnosis.runs.rotor import rotor_is_apart
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion

#: Change of a position [rad, m] and of a speed [rad/s, m/s] by which a torque's derivative is found.
_SMALL = 1e-4


@dataclass(frozen=True)
class Train:
    """An elastic drive train: ``stiffness`` k [N m/rad, N/m], ``gap`` its play [rad, m], and ``damping`` the ratio
    d / (2 sqrt(k M)) of the link on it, the motor held. Arrays are many of them.
    """

    stiffness: Value
    damping: Value
    gap: Value = 0.0


@dataclass(frozen=True)
class LinkSide:
    """Past the drive train of coordinate ``k``, whose inertia on the joint side is ``rotor`` [kg m2, kg].

    ``load`` (N) [N m, N] is what the drive train transmits; ``by_position``, ``by_speed`` and ``by_acceleration`` are
    the torques of all but the drive train (n x N) per unit of the joint's own.
    """

    scene: Scene
    k: int
    rotor: float
    load: Array
    by_position: Array
    by_speed: Array
    by_acceleration: Array

    @property
    def inertia(self) -> Array:
        """Of the links about the joint (N) [kg m2, kg]."""
        result: Array = self.by_acceleration[self.k]
        return result

    @property
    def drag(self) -> Array:
        """Change of the load per unit of the joint's speed (N) [N m s/rad, N s/m]: an inertia that grows slows a link
        down.
        """
        result: Array = self.by_speed[self.k]
        return result

    @property
    def along(self) -> Link:
        """What a step takes of the link, sample by sample (N each)."""
        smooth = self.load.copy()
        smooth[1:-1] += np.diff(self.load, 2) / 12
        return Link(self.load, smooth, self.inertia, self.drag)

    def with_rotor(self, rotor: float) -> LinkSide:
        """The same with another share of the whole inertia on the motor's side, unless that is a base parameter of its
        own.
        """
        if rotor_is_apart(self.scene, self.k):
            return replace(self, rotor=rotor)
        load = self.load - (rotor - self.rotor) * self.scene.motion.qdd[self.k]
        by_acceleration = self.by_acceleration.copy()
        by_acceleration[self.k] -= rotor - self.rotor
        return replace(self, rotor=rotor, load=load, by_acceleration=by_acceleration)

    def loaded(self, more: float) -> LinkSide:
        """The same with a load that is larger by ``more`` [N m, N] all along."""
        return replace(self, load=self.load + more)

    def deflection(self, train: Train) -> Motion:
        """The link's motion against the motor's on a drive train of plain numbers."""
        return self._played(train, self.start(train))

    def free(self, train: Train, start: tuple[float, float]) -> Motion:
        """The same without a load, from a ``start``: deflection [rad, m] and its speed [rad/s, m/s]."""
        return replace(self, load=np.zeros_like(self.load))._played(train, start)

    def swing(self, train: Train, end: int) -> Array:
        """Torque of the link by its swing against the motor [N m, N], of the first ``end`` samples."""
        along = Link(*(each[:end] for each in self.along))
        return np.asarray(along.inertia * played(along, self.spring(train), self.start(train))[2])

    def _played(self, train: Train, start: tuple[Value, Value]) -> Motion:
        """No numbers where the samples do not follow the swings all along: they would grow without end."""
        if not self.follows(train):
            return alone(self.scene.motion, self.k, np.full((3, self.scene.motion.samples), np.nan))
        return alone(self.scene.motion, self.k, played(self.along, self.spring(train), start))

    def follows(self, train: Train) -> bool:
        """Whether the samples follow the swings: the differences are stable all along, of the lightest link too."""
        least = float(np.min(self.inertia))
        if least <= 0:
            return False
        return bool(train.stiffness * self.scene.period**2 / least < (STABLE if train.gap == 0 else STABLE_IN_GAPS))

    def spring(self, train: Train) -> Spring:
        """What a step takes of a drive train."""
        d = 2 * train.damping * np.sqrt(train.stiffness * float(np.mean(self.inertia)))
        return Spring(train.stiffness, d, train.gap / 2, self.scene.period)

    def start(self, train: Train) -> tuple[Value, Value]:
        """Deflection and its speed when the log begins, of a link that hangs still."""
        k, half = train.stiffness, train.gap / 2
        e = -(half * np.sign(self.load[0]) + self.load[0] / k)
        return e, (self.load[0] - self.load[1]) / (self.scene.period * k)

    def torque_per(self, deflection: Motion) -> Array:
        """Change of the motors' torques (n x N) by a small deflection of the joint's link."""
        k = self.k
        per = (self.by_position, self.by_speed, self.by_acceleration)
        parts = [rate * signal[k] for rate, signal in zip(per, deflection.signals, strict=True)]
        return np.asarray(sum(parts))


def swings_in_gaps(sides: Sequence[LinkSide], trains: Sequence[Train], end: int) -> Iterator[Array]:
    """Torque of the joint's link by its swing against the motor (... x S x K) [N m, N], some samples at a time up to
    ``end``, along S ``sides`` of one scene, each on K ``trains``, all with a gap.
    """
    springs = [side.spring(train) for side, train in zip(sides, trains, strict=True)]
    starts = [side.start(train) for side, train in zip(sides, trains, strict=True)]
    e, v = (np.stack(each) for each in zip(*starts, strict=True))
    links = Link(*(np.stack(each, axis=-1)[:end] for each in zip(*(side.along for side in sides), strict=True)))
    stiffness, damping, half = (np.stack(each) for each in list(zip(*springs, strict=True))[:-1])
    yield from torques_in_gaps(links, Spring(stiffness, damping, half, springs[0].period), (e, v))


def link_side(scene: Scene, k: int, rotor: float) -> LinkSide:
    """Past the drive train of coordinate ``k``, whose inertia on the joint side is ``rotor`` [kg m2, kg]."""
    values, motion = without_drive_train(scene, k, rotor), scene.motion

    def torque_on(moved: Motion) -> Array:
        return scene.torque_of(values, moved)

    still = torque_on(motion)
    by_position, by_speed = (
        sensitivity(torque_on, motion, alone(motion, k, change)) / _SMALL
        for change in ((_SMALL, 0.0, 0.0), (0.0, _SMALL, 0.0))
    )
    return LinkSide(scene, k, rotor, still[k], by_position, by_speed, torque_on(quicker(motion, k)) - still)


class LinkSides:
    """Those of one coordinate along several scenes, which are found once: the ``first`` is."""

    def __init__(self, first: LinkSide) -> None:
        self.first = first
        self._made = {id(first.scene): first}

    def along(self, scene: Scene, rotor: float) -> LinkSide:
        """That of a scene, past a drive train of inertia ``rotor`` [kg m2, kg]."""
        # A scene that is kept by its link side keeps its identity.
        made = self._made.get(id(scene))
        if made is None:
            made = self._made[id(scene)] = link_side(scene, self.first.k, self.first.rotor)
        return made if made.rotor == rotor else made.with_rotor(rotor)


def without_drive_train(scene: Scene, k: int, rotor: float) -> dict[str, float]:
    """The scene's values with those of the joint's own drive-train effects taken out, ``rotor`` from where it is
    grouped: one that was found beside a model without it is in no base parameter.
    """
    model = scene.regressors.model
    number = model.robot.moving[k].number
    own, grouped = _of_motor(model, number), model.grouping.numeric()
    result = dict(scene.values)
    result |= {name: 0.0 for name, terms in grouped.items() if set(terms) <= own}
    beside = scene.found(f"Ia{number}") and not scene.robot.has("rotor_inertia", number)
    rotors = {} if beside else scene.regressors.rotors[k]
    for name, per_inertia in rotors.items():
        if not set(grouped[name]) <= own:
            result[name] = result.get(name, 0.0) - per_inertia * rotor
    return result


def _of_motor(model: Model, number: int) -> frozenset[str]:
    """Parameters whose torque turns with the motor of a joint, or with another joint's that turns with it."""
    names: set[str] = set()
    for instance in model.effects:
        columns = instance.columns()
        if not instance.effect.on_link and any(number in column for column in columns):
            names |= set(instance.names)
    return frozenset(names)
