"""Gravity balancers from plain statics: a force along the line between two pivots, and its moment about the joint.

The joint's axis is the origin of a plane; the fixed pivot lies at (-d21, 0), the moving one at d22 (cos q21, sin q21)
with q21 = phi + q (report eq. 22, 23 and Table 6). No angle of the balancer itself is needed, hence no quadrant.
"""

from __future__ import annotations

from decimal import Decimal

from generator.reference.arithmetic import cosine, sine
from generator.reference.law import Values


def length(shape: Values, q: Decimal) -> Decimal:
    """Distance r24 between the pivots [m]."""
    x, y = _between(shape, q)
    return (x * x + y * y).sqrt()


def lever_arm(shape: Values, q: Decimal) -> Decimal:
    """Moment about the joint [m] that holds a unit force which pulls the moving pivot to the fixed one."""
    x, y = _between(shape, q)
    at_x, at_y = _pivot(shape, q)
    return (at_x * y - at_y * x) / length(shape, q)


def spring_forces(shape: Values, q: Decimal) -> tuple[Decimal, ...]:
    """Force F1 per unit of Kr [m] and of K0 (report eq. 19)."""
    return length(shape, q), Decimal(1)


def spring_energies(shape: Values, q: Decimal) -> tuple[Decimal, ...]:
    """Work against F1 from q = 0, per unit of Kr [m2] and of K0 [m]."""
    r, start = length(shape, q), length(shape, Decimal(0))
    return (r * r - start * start) / 2, r - start


def gas_forces(shape: Values, q: Decimal) -> tuple[Decimal, ...]:
    """Force F1 per unit of F0: p V^exponent stays constant in a chamber that the rod shortens (eq. 34-36)."""
    compression = shape["l0"] / _chamber(shape, q)
    return (compression ** shape["exponent"],)


def gas_energies(shape: Values, q: Decimal) -> tuple[Decimal, ...]:
    """Work against F1 from q = 0, per unit of F0 [m]; a logarithm on the isotherm."""
    compression, excess = shape["l0"] / _chamber(shape, q), shape["exponent"] - 1
    if excess == 0:
        return (shape["l0"] * compression.ln(),)
    return (shape["l0"] * (compression**excess - 1) / excess,)


def _pivot(shape: Values, q: Decimal) -> tuple[Decimal, Decimal]:
    angle = shape["phi"] + q
    return shape["d22"] * cosine(angle), shape["d22"] * sine(angle)


def _between(shape: Values, q: Decimal) -> tuple[Decimal, Decimal]:
    """From the fixed pivot to the moving one."""
    x, y = _pivot(shape, q)
    return x + shape["d21"], y


def _chamber(shape: Values, q: Decimal) -> Decimal:
    """Length of the gas chamber [m] (eq. 35)."""
    return shape["l0"] - length(shape, q) + length(shape, Decimal(0))
