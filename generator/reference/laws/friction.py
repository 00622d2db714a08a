"""Laws of friction, direction by direction: what the motor supplies against it, per unit of each parameter."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal

from generator.reference.arithmetic import cosine, sign, sine
from generator.reference.law import At, Columns, Law


def _asymmetric_viscous(at: At) -> Columns:
    return (at.qd, Decimal(0)) if at.qd > 0 else (Decimal(0), at.qd)


def _asymmetric_coulomb(at: At) -> Columns:
    forward = (1 + at.direction) / 2
    return forward, forward - 1


def _power(at: At) -> Columns:
    speed = abs(at.qd)
    return (at.direction * (speed / at.shape["v"]) ** at.shape["exponent"] if speed else Decimal(0),)


def _stribeck(at: At) -> Columns:
    speed = abs(at.qd)
    film = (speed / at.shape["vs"]) ** at.shape["exponent"] if speed else Decimal(0)
    return (at.direction * (-film).exp(),)


def _gradual(at: At) -> Columns:
    # exp(-2 |x|) vanishes far from rest, where exp(2 |x|) is no decimal.
    shrunk = (-2 * abs(at.qd) / at.shape["v0"]).exp()
    return (sign(at.qd) * (1 - shrunk) / (1 + shrunk),)


def _of_position(at: At) -> Columns:
    phase = at.shape["order"] * at.q
    parts = cosine(phase), sine(phase), cosine(2 * phase), sine(2 * phase)
    return tuple(at.direction * one for one in parts)


#: Ranges of viscous and of Coulomb friction, and the parameters of friction that changes along the range.
_VISCOUS, _DRY = (1.0, 9.0), (2.0, 15.0)
_WAVES = ("Fqc", "Fqs", "Fq2c", "Fq2s")

#: By the effects' ids; sources as in ``generator.effects``.
LAWS: Mapping[str, Law] = {
    "viscous_friction": Law(("Fv",), lambda at: (at.qd,), ranges={"Fv": _VISCOUS}),
    "coulomb_friction": Law(("Fc",), lambda at: (at.direction,), ranges={"Fc": _DRY}),
    "asymmetric_viscous": Law(("Fvp", "Fvn"), _asymmetric_viscous, ranges={"Fvp": _VISCOUS, "Fvn": _VISCOUS}),
    "asymmetric_coulomb": Law(("Fcp", "Fcn"), _asymmetric_coulomb, ranges={"Fcp": _DRY, "Fcn": _DRY}),
    "power_friction": Law(
        ("Fp",), _power, ranges={"Fp": (1.0, 5.0)}, defaults={"v": Decimal(1), "exponent": Decimal(2)}
    ),
    "stribeck_friction": Law(("Fst",), _stribeck, ranges={"Fst": (1.0, 8.0)}, defaults={"exponent": Decimal(2)}),
    "gradual_friction": Law(("Fg",), _gradual, ranges={"Fg": (1.0, 8.0)}),
    "load_friction": Law(
        ("Fl",),
        lambda at: (at.direction * abs(at.load - at.shape["rotor"] * at.qdd),),
        by_load=True,
        ranges={"Fl": (0.01, 0.2)},
        defaults={"rotor": Decimal(0)},
    ),
    "warm_friction": Law(
        ("Fvw", "Fcw"),
        lambda at: (at.warmth * at.qd, at.warmth * at.direction),
        ranges={"Fvw": (-3.0, -0.5), "Fcw": (-4.0, -0.5)},
    ),
    "position_friction": Law(
        _WAVES, _of_position, ranges=dict.fromkeys(_WAVES, (-2.0, 2.0)), defaults={"order": Decimal(1)}
    ),
}
