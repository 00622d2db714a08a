"""Which effects are to be thought of first."""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects.effect import BALANCER, EVERYWHERE, OFTEN, SPRING
from generator.effects.library import library
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import BODY, LENGTH, Hypothesis


def balances(effect: str) -> bool:
    """Whether an effect by its id holds an arm up."""
    return _role(effect) == BALANCER


def pulls(effect: str) -> bool:
    """Whether an effect by its id pulls a link to where it rests."""
    return _role(effect) in (BALANCER, SPRING)


def misplaces(hypothesis: Hypothesis) -> bool:
    """Whether with it the links stand elsewhere than the model says."""
    return hypothesis.kind == LENGTH or hypothesis.effect in ("base_tilt", "gear_ratio", "position_offset")


def common(variant: Variant) -> bool:
    """Whether nearly every robot has the effect, or this one by what its file says."""
    return variant.hypothesis.kind == BODY or variant.hypothesis.stated or _occurs(variant) == EVERYWHERE


def likely(variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether an effect is to be thought of first: common ones, a wrist's coupling, one balancer in its place. A
    spring that has lost a coefficient is not: without stiffness it pushes as gas does.
    """
    if balances(variant.hypothesis.effect):
        whole = len(variant.used) == len(variant.hypothesis.coefficients)
        return whole and variant.hypothesis.usual and not any(balances(one.hypothesis.effect) for one in others)
    return common(variant) or _occurs(variant) == OFTEN


def _occurs(variant: Variant) -> str:
    return one.occurs if (one := library().get(variant.hypothesis.effect)) else ""


def _role(effect: str) -> str:
    return one.role if (one := library().get(effect)) else ""
