"""The rotor of a motor that two joints turn together, as in a wrist whose axes are mechanically coupled.

Where the coupling is as strong as the gear ratio, the rotor's inertia and friction show on both joints. Where it is
weak beside the ratio, as report section 2.3.1 says of its robots, they cannot be told from the joint's own.
"""

from __future__ import annotations

import sympy

from generator.effects.effect import OFTEN, Column, Effect, LinearParameter, Shape, Site


def _sum(at: Site, own: sympy.Symbol, stem: str) -> sympy.Expr:
    """What the rotor's motion is in units of its own joint."""
    return own + at.values["ratio"] * sympy.Symbol(f"{stem}{at.values['other']}", real=True)


def _shared(at: Site, torque: sympy.Expr) -> Column:
    """The rotor's torque on its own joint and, by equal power, on the other one."""
    own, other, ratio = at.joint.number, at.values["other"], at.values["ratio"]
    return {own: (1 + ratio) * torque} if own == other else {own: torque, other: ratio * torque}


def _columns(at: Site) -> tuple[Column, ...]:
    speed, acceleration = _sum(at, at.qd, "qd"), _sum(at, at.qdd, "qdd")
    return _shared(at, acceleration), _shared(at, speed), _shared(at, sympy.sign(speed))


EFFECT = Effect(
    id="coupled_rotor",
    title="rotor that two joints turn",
    parameters=(
        LinearParameter("Iar", ("kg m2", "kg"), "inertia of a rotor that two joints turn", 0.0),
        LinearParameter("Fvr", ("N m s/rad", "N s/m"), "viscous friction of a rotor that two joints turn", 0.0),
        LinearParameter("Fcr", ("N m", "N"), "Coulomb friction of a rotor that two joints turn", 0.0),
    ),
    columns=_columns,
    kinetic_energy=lambda at: (_sum(at, at.qd, "qd") ** 2 / 2, sympy.S.Zero, sympy.S.Zero),
    shapes=(
        Shape("other", "1", "number of the other joint that turns the rotor", joint=True),
        Shape(
            "ratio",
            "1",
            "rotor speed per speed of the other joint, in units of that per speed of its own",
            per_other=True,
            nonzero=True,
        ),
    ),
    needs=("qd", "qdd"),
    sign_convention="the motor supplies Iar s'' + Fvr s' + Fcr sign(s'), s = q + ratio q_other, shared by equal power",
    assumptions="gyroscopic terms of the rotor are neglected; sign(0) = 0, also where other dry friction has a given "
    "direction or a smooth stand-in: simulations do not stick by it",
    source="report section 2.3.1; Gautier and Briot 2012",
    rank=45,
    occurs=OFTEN,
)
