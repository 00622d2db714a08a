"""Regressor columns of the inertial parameters: each joint's screw projected on the wrench of one unit parameter."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from generator.symbolic.frames import Chain, Frame
from generator.symbolic.kinematics import Screw
from generator.symbolic.newton_euler import Motion
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, array, cross, zeros

#: Entries of the inertia tensor that each of its parameters fills.
_TENSOR = {"XX": (0, 0), "XY": (0, 1), "XZ": (0, 2), "YY": (1, 1), "YZ": (1, 2), "ZZ": (2, 2)}


def unit_wrench(program: Program, parameter: str, motion: Motion) -> tuple[Array | None, Array | None]:
    """Force and moment per unit of one inertial parameter (None where zero): the columns of F and N."""
    if parameter == "M":
        return motion.a, None
    if parameter in ("MX", "MY", "MZ"):
        k = ("MX", "MY", "MZ").index(parameter)
        unit = array(program, [int(i == k) for i in range(3)])
        return motion.u[:, k], cross(unit, motion.a)
    row, column = _TENSOR[parameter]
    return None, _tensor_moment(program, row, column, motion)


def _tensor_moment(program: Program, a: int, b: int, motion: Motion) -> Array:
    """J wd + w x J w for a tensor J whose only entries are J_ab = J_ba = 1.

    With c the third index and s the sign of the permutation (a, b, c), the moment is
    n_a = -s U_ca, n_b = s U_cb, n_c = s (U_aa - U_bb): the products of w that U holds serve every column.
    """
    w, wd, u = motion.w, motion.wd, motion.u
    moment = zeros(program, 3)
    if a == b:
        b, c = (a + 1) % 3, (a + 2) % 3
        moment[a], moment[b], moment[c] = wd[a], w[a] * w[c], -(w[a] * w[b])
        return moment
    c = 3 - a - b
    s = 1 if (a + 1) % 3 == b else -1
    moment[a], moment[b], moment[c] = -s * u[c, a], s * u[c, b], s * (u[a, a] - u[b, b])
    return moment


def column(
    chain: Chain, frame: Frame, parameter: str, motion: Motion, carried_by: Mapping[int, Screw]
) -> dict[int, Node]:
    """Torque per unit of ``parameter`` of the body of ``frame``, by coordinate of the joints that carry it."""
    force, moment = unit_wrench(chain.program, parameter, motion)
    entries: dict[int, Node] = {}
    for coordinate, screw in carried_by.items():
        torque = chain.program.zero
        if moment is not None:
            torque = torque + screw.w @ moment
        if force is not None:
            torque = torque + screw.v @ force
        entries[coordinate] = torque
    return entries


#: A column of a frame's origin in terms of columns of a point r before it on the axis: factor, power of r, parameter.
_SHIFTED = {
    "MX": ((-1, 1, "XZ"),),
    "MY": ((-1, 1, "YZ"),),
    "MZ": ((2, 1, "XX"), (2, 1, "YY")),
    "M": ((1, 1, "MZ"), (1, 2, "XX"), (1, 2, "YY")),
}


def columns_about(
    chain: Chain, frame: Frame, stems: Iterable[str], motion: Motion, carried_by: Mapping[int, Screw], r: Node
) -> dict[str, dict[int, Node]]:
    """The columns of a body's parameters ``stems``, from motion and screws of a point of its axis.

    The frame's origin stands ``r`` along z from that point; what moves little there is cheaper there, and a column
    moves back by one product per entry.
    """
    program = chain.program
    result: dict[str, dict[int, Node]] = {}
    for stem in stems:
        entries = column(chain, frame, stem, motion, carried_by)
        for factor, power, other in _SHIFTED.get(stem, ()) if r is not program.zero else ():
            scale = factor * (r if power == 1 else r * r)
            for coordinate, entry in column(chain, frame, other, motion, carried_by).items():
                entries[coordinate] = entries[coordinate] + scale * entry
        result[stem] = entries
    return result
