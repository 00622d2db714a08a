"""A link between a point of the fixed body and a point of the moving one: two pivots and the joint between them.

The report's balancers sit on it (eq. 19-29, Table 6). Its lever arm is taken by virtual work as the derivative of the
length, which holds on both sides of the dead centre; the printed arctangent (eq. 29) has the wrong branch beyond it.
"""

from __future__ import annotations

import sympy

from generator.effects.effect import Positive, Shape, Site

_ANGLES = tuple(round(k * 0.5236 - 3.1416, 4) for k in range(12))

SHAPES = (
    Shape(
        "d21",
        "m",
        "distance from the joint's axis to the pivot on the fixed body",
        lower=0.0,
        tried=(1.0,),
        scale=True,
    ),
    Shape(
        "d22", "m", "distance from the joint's axis to the pivot on the moving body", lower=0.0, tried=(0.15, 0.25, 0.4)
    ),
    Shape("phi", "rad", "angle between the two arms at q = 0", tried=_ANGLES),
)


def length(at: Site) -> sympy.Expr:
    """r24(q) [m] (report eq. 22, 28)."""
    d21, d22, phi = (at.values[name] for name in ("d21", "d22", "phi"))
    return sympy.sqrt(d21**2 + d22**2 + 2 * d21 * d22 * sympy.cos(phi + at.q))


def length_at_zero(at: Site) -> sympy.Expr:
    """r24(0) [m]."""
    return length(at).subs(at.q, 0)


def apart(at: Site) -> Positive:
    """The pivots do not meet: where they do, the line of the force has no direction."""
    return Positive("d22", length(at), "equal to d21", "pivots that stay apart")


def extremes(at: Site, lower: sympy.Expr, upper: sympy.Expr) -> list[sympy.Expr]:
    """Positions [rad] from ``lower`` to ``upper`` among which r24 has its least and its largest value: both ends and
    the dead centres between them, of which two in a row stand for all.
    """
    phi = at.values["phi"]
    first, last = (
        int(turns) for turns in (sympy.ceiling((lower + phi) / sympy.pi), sympy.floor((upper + phi) / sympy.pi))
    )
    return [lower, *(k * sympy.pi - phi for k in range(first, min(last, first + 1) + 1)), upper]


def lever_arm(at: Site) -> sympy.Expr:
    """d r24 / d q [m]: equal to d22 sin(psi) of report eq. 20 with the quadrant kept."""
    d21, d22, phi = (at.values[name] for name in ("d21", "d22", "phi"))
    return -d21 * d22 * sympy.sin(phi + at.q) / length(at)


def observables(at: Site, force: sympy.Expr) -> dict[str, tuple[sympy.Expr, str, str]]:
    """What may be told of a balancer that pulls its pivots together with ``force`` [N]: each with unit and meaning."""
    return {
        "length": (length(at), "m", "distance r24 between the balancer's pivots"),
        "force": (force, "N", "force F1 with which the balancer pulls its pivots together"),
        "torque": (force * lever_arm(at), "N m", "torque of the balancer in the inverse dynamic model"),
    }
