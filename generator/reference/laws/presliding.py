"""Effects with a state of their own: what is built up, and how fast it changes."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal

from generator.reference.arithmetic import sign
from generator.reference.law import At, Columns, Law


def _dahl_rate(at: At) -> Columns:
    # Dahl's dF/dx = stiffness (1 - F/Fc sign(qd)), over Fc.
    (built_up,) = at.states
    return (at.qd * (1 - sign(at.qd) * built_up) / at.shape["xs"],)


def _bristle_speed(at: At) -> Decimal:
    """Of LuGre: z' = v - |v| z / g(v), with z in units of its end xs in fast sliding."""
    (z,) = at.states
    excess = at.shape["excess"] * (-(at.qd * at.qd) / (at.shape["vs"] * at.shape["vs"])).exp()
    return at.qd - abs(at.qd) * z / (1 + excess)


def _bouc_wen_rate(at: At) -> Columns:
    # Yielding takes place only while the torque grows.
    (z,) = at.states
    growing = at.qd * z > 0
    yielding = abs(z) ** at.shape["exponent"] if growing else Decimal(0)
    return (at.qd * (1 - yielding) / at.shape["xs"],)


#: By the effects' ids; sources as in ``generator.effects``.
LAWS: Mapping[str, Law] = {
    "dahl_friction": Law(("Fd",), lambda at: at.states, states=("zd",), rates=_dahl_rate, ranges={"Fd": (2.0, 15.0)}),
    "lugre_friction": Law(
        ("Fz", "Dz"),
        lambda at: (at.states[0], _bristle_speed(at)),
        states=("zl",),
        rates=lambda at: (_bristle_speed(at) / at.shape["xs"],),
        ranges={"Fz": (2.0, 15.0), "Dz": (0.1, 2.0)},
    ),
    "hysteresis": Law(
        ("Fh",),
        lambda at: at.states,
        states=("zh",),
        rates=_bouc_wen_rate,
        ranges={"Fh": (2.0, 15.0)},
        defaults={"exponent": Decimal(2)},
    ),
}
