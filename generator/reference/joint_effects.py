"""Torques of the effects on their joints, per unit of each parameter, and the energies that they store."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

from generator.reference import balancers
from generator.reference.arithmetic import Array, exact, sign, zeros
from generator.robot.description import EffectUse, Robot

Values = Mapping[str, Decimal]
Columns = tuple[Decimal, ...]


def _none(*_: object) -> Columns:
    return ()


@dataclass(frozen=True)
class Law:
    """One effect: parameter ``stems``, and per unit of each its torque, pull F1 (balancers) and energies.

    ``sliding`` gives the law for a direction that stands for sign(qd), where the effect is dry friction.
    """

    stems: tuple[str, ...]
    torque: Callable[[Values, Decimal, Decimal, Decimal], Columns]
    pull: Callable[[Values, Decimal], Columns] = _none
    potential: Callable[[Values, Decimal], Columns] = _none
    kinetic: Callable[[Decimal], Columns] = _none
    sliding: Callable[[Decimal], Law] | None = None


def _balancer(
    stems: tuple[str, ...], pull: Callable[[Values, Decimal], Columns], energy: Callable[[Values, Decimal], Columns]
) -> Law:
    def torque(shape: Values, q: Decimal, qd: Decimal, qdd: Decimal) -> Columns:
        arm = balancers.lever_arm(shape, q)
        return tuple(arm * force for force in pull(shape, q))

    return Law(stems, torque, pull, energy)


#: Report eq. 5 (rotor, friction), eq. 4 (offset), eq. 19-38 (balancers); sign(0) = 0.
LAWS: Mapping[str, Law] = {
    "rotor_inertia": Law(("Ia",), lambda shape, q, qd, qdd: (qdd,), kinetic=lambda qd: (qd * qd / 2,)),
    "viscous_friction": Law(("Fv",), lambda shape, q, qd, qdd: (qd,)),
    "coulomb_friction": Law(
        ("Fc",),
        lambda shape, q, qd, qdd: (sign(qd),),
        sliding=lambda direction: Law(("Fc",), lambda shape, q, qd, qdd: (direction,)),
    ),
    "offset": Law(("Off",), lambda shape, q, qd, qdd: (Decimal(1),)),
    "joint_spring": Law(("ks",), lambda shape, q, qd, qdd: (q,), potential=lambda shape, q: (q * q / 2,)),
    "spring_balancer": _balancer(("Kr", "K0"), balancers.spring_forces, balancers.spring_energies),
    "coupled_rotor": Law(
        ("Iar", "Fvr", "Fcr"), lambda shape, q, qd, qdd: (qdd, qd, sign(qd)), kinetic=lambda qd: (qd * qd / 2,)
    ),
    "gas_balancer": _balancer(("F0",), balancers.gas_forces, balancers.gas_energies),
}


@dataclass(frozen=True)
class Acting:
    """An effect on one joint: ``number`` the joint, ``coordinate`` its place in q, ``shape`` the fixed values.

    The law is one of the motion ``weights`` @ q (n), which is that of the joint itself but where two joints turn a
    rotor; its torque acts on the joints by the same weights, so that no power is lost.

    The methods give values by parameter name, each per unit of that parameter; none where the effect has none.
    """

    law: Law
    number: int
    coordinate: int
    shape: Values
    weights: Array

    def along(self, signal: Array) -> Decimal:
        """Position, speed or acceleration of the motion that the law is of, from those of the joints (n)."""
        return sum((weight * one for weight, one in zip(self.weights, signal, strict=True)), Decimal(0))

    def sliding(self, direction: Decimal) -> Acting:
        """The same with ``direction`` for sign(qd)."""
        return self if self.law.sliding is None else replace(self, law=self.law.sliding(direction))

    def torques(self, q: Decimal, qd: Decimal, qdd: Decimal) -> dict[str, Decimal]:
        """What the effect adds to the inverse dynamic model."""
        return self._named(self.law.torque(self.shape, q, qd, qdd))

    def pulls(self, q: Decimal) -> dict[str, Decimal]:
        """Force F1 with which a balancer pulls its pivots together."""
        return self._named(self.law.pull(self.shape, q))

    def potential(self, q: Decimal) -> dict[str, Decimal]:
        """Energy stored since q = 0."""
        return self._named(self.law.potential(self.shape, q))

    def kinetic(self, qd: Decimal) -> dict[str, Decimal]:
        """Energy of motion."""
        return self._named(self.law.kinetic(qd))

    def _named(self, columns: Columns) -> dict[str, Decimal]:
        return {f"{stem}{self.number}": column for stem, column in zip(self.law.stems, columns, strict=False)}


def acting(robot: Robot) -> Iterator[Acting]:
    """The effects of ``robot`` in its file's order; raises KeyError for one that has no law here."""
    coordinate = {joint.number: k for k, joint in enumerate(robot.moving)}
    for use in robot.effects:
        for number in use.joints:
            weights, shape = zeros(len(coordinate)), _shape(use)
            weights[coordinate[number]] = Decimal(1)
            if "other" in shape:
                weights[coordinate[int(shape["other"])]] += shape["ratio"]
            yield Acting(LAWS[use.effect], number, coordinate[number], shape, weights)


def _shape(use: EffectUse) -> Values:
    """The fixed values; a gas without exponent is isothermal."""
    return {"exponent": Decimal(1)} | {name: exact(given.value) for name, given in use.values.items()}
