"""Torques of the effects on the joints, per unit of each parameter, and the energies that they store."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

from generator.discovery import modules
from generator.reference import laws
from generator.reference.arithmetic import Array, decimals, exact, sign, zeros
from generator.reference.law import At, Law, Values
from generator.robot.description import EffectUse, Robot

#: By the effects' ids; sign(0) = 0.
LAWS: Mapping[str, Law] = {name: law for module in modules(laws) for name, law in module.LAWS.items()}


@dataclass(frozen=True)
class Beside:
    """What effects see beside the motion: ``load`` and ``warmth`` of each joint (n), their ``states`` by name."""

    load: Array
    warmth: Array
    states: Values


@dataclass(frozen=True)
class Acting:
    """An effect on one joint: ``number`` the joint, ``coordinate`` its place in q, ``shape`` the fixed values.

    It acts along ``shares`` @ q (n): a joint, or a motor over its own ``ratio``. ``direction`` stands for the sign of
    the joint's speed where it is given. The methods give values by parameter name, each per unit of that parameter;
    none where the effect has none.
    """

    law: Law
    number: int
    coordinate: int
    shape: Values
    shares: Array
    ratio: Decimal = Decimal(1)
    direction: Decimal | None = None

    def sliding(self, direction: Decimal) -> Acting:
        """The same with ``direction`` for sign(qd); what a pair of joints turns has no joint's direction."""
        return self if self.law.along == "pair" else replace(self, direction=direction)

    def torques(self, q: Array, qd: Array, qdd: Array, beside: Beside | None = None) -> dict[str, Array]:
        """What the effect adds to the inverse dynamic model (n each)."""
        columns = self.law.torque(self._at(q, qd, qdd, beside))
        return {name: column * self.shares for name, column in self._named(columns).items()}

    def is_defined(self, q: Array) -> bool:
        """Whether all that it tells is a number at the positions ``q`` (n), at rest: a gas chamber has an end."""
        at = replace(self._at(q), states=(Decimal(0),) * len(self.law.states))
        try:
            told = [*self.law.torque(at), *self.law.pull(at), *self.law.potential(at), *self.law.rates(at)]
        except ArithmeticError:
            return False
        return all(number.is_finite() for number in told)

    def rates(self, q: Array, qd: Array, beside: Beside) -> dict[str, Decimal]:
        """Time derivatives of its states by their names."""
        rates = self.law.rates(self._at(q, qd, None, beside))
        return {f"{stem}{self.number}": rate for stem, rate in zip(self.law.states, rates, strict=True)}

    def pulls(self, q: Array) -> dict[str, Decimal]:
        """Force F1 with which a balancer pulls its pivots together."""
        return self._named(self.law.pull(self._at(q)))

    def potential(self, q: Array) -> dict[str, Decimal]:
        """Energy stored since q = 0."""
        return self._named(self.law.potential(self._at(q)))

    def kinetic(self, qd: Array) -> dict[str, Decimal]:
        """Energy of motion."""
        return self._named(self.law.kinetic(self._at(0 * qd, qd)))

    def inertia(self) -> dict[str, Decimal]:
        """Inertia along ``shares``: the energy is quadratic in the speed there."""
        one = At(self.shape, Decimal(0), Decimal(1), Decimal(0), Decimal(1), self.ratio)
        return self._named(tuple(2 * energy for energy in self.law.kinetic(one)))

    def _at(self, q: Array, qd: Array | None = None, qdd: Array | None = None, beside: Beside | None = None) -> At:
        position, speed, acceleration = (self._along(x) for x in (q, qd, qdd))
        direction = sign(speed) if self.direction is None else self.direction
        at = At(self.shape, position, speed, acceleration, direction, self.ratio)
        if beside is None:
            return at
        k = self.coordinate
        states = tuple(beside.states[f"{stem}{self.number}"] for stem in self.law.states)
        return replace(at, load=beside.load[k], warmth=beside.warmth[k], states=states)

    def _along(self, x: Array | None) -> Decimal:
        return Decimal(0) if x is None else sum(self.shares * x, Decimal(0))

    def _named(self, columns: tuple[Decimal, ...]) -> dict[str, Decimal]:
        return {f"{stem}{self.number}": column for stem, column in zip(self.law.stems, columns, strict=False)}


def acting(robot: Robot) -> Iterator[Acting]:
    """The effects of ``robot`` in its file's order; raises KeyError for one that has no law here."""
    coordinate = {joint.number: k for k, joint in enumerate(robot.moving)}
    for use in robot.effects:
        law = LAWS[use.effect]
        for number in use.joints:
            k = coordinate[number]
            shape = _shape(use)
            shares, ratio = zeros(len(robot.moving)), Decimal(1)
            shares[k] = Decimal(1)
            if law.along == "motor":
                shares, ratio = _of_motor(robot, k)
            elif law.along == "pair":
                shares[coordinate[int(shape["other"])]] = shape["ratio"]
            yield Acting(law, number, k, shape, shares, ratio)


def _of_motor(robot: Robot, k: int) -> tuple[Array, Decimal]:
    """The motor's row of N over its own ratio, and that ratio."""
    assert robot.drives is not None
    row = decimals([exact(entry) for entry in robot.drives.coupling[k]])
    return row / row[k], row[k]


def _shape(use: EffectUse) -> Values:
    """The fixed values, those that the file leaves out included."""
    return {**LAWS[use.effect].defaults, **{name: exact(given.value) for name, given in use.values.items()}}
