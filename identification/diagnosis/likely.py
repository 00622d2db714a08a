"""Which effects are to be thought of first."""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.bank import Variant

#: What nearly every robot has; what many wrists have; what holds an arm up.
_COMMON = ("rotor_inertia", "viscous_friction", "coulomb_friction", "offset", "payload")
_WRIST = ("coupled_rotor",)
BALANCERS = ("gas_balancer", "spring_balancer")
#: What pulls a link to where it rests.
SPRINGS = (*BALANCERS, "cable_spring", "joint_spring")


def common(variant: Variant) -> bool:
    """Whether nearly every robot has the effect."""
    return variant.hypothesis.effect in _COMMON


def likely(variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether an effect is to be thought of first: common ones, a wrist's coupling, one balancer in its place. A
    spring that has lost a coefficient is not: without stiffness it pushes as gas does.
    """
    effect = variant.hypothesis.effect
    if effect in BALANCERS:
        whole = len(variant.used) == len(variant.hypothesis.coefficients)
        return whole and variant.hypothesis.usual and not any(one.hypothesis.effect in BALANCERS for one in others)
    return common(variant) or effect in _WRIST
