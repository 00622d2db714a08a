"""Inertia and friction of what a motor turns, and the constant part of a torque (report eq. 4, 5)."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal

from generator.reference.law import Law

#: By the effects' ids.
LAWS: Mapping[str, Law] = {
    "rotor_inertia": Law(
        ("Ia",), lambda at: (at.qdd,), kinetic=lambda at: (at.qd * at.qd / 2,), ranges={"Ia": (0.5, 3.0)}
    ),
    "coupled_rotor": Law(
        ("Iar", "Fvr", "Fcr"),
        lambda at: (at.qdd, at.qd, at.direction),
        kinetic=lambda at: (at.qd * at.qd / 2, Decimal(0), Decimal(0)),
        along="pair",
        ranges={"Iar": (0.5, 3.0), "Fvr": (1.0, 9.0), "Fcr": (2.0, 15.0)},
    ),
    # Of the flexible robot alone, with its own parameters: see ``flexible``.
    "joint_elasticity": Law((), lambda at: ()),
    "offset": Law(("Off",), lambda at: (Decimal(1),), loads=True, ranges={"Off": (-4.0, 4.0)}),
}
