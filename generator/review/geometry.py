"""The rows of the Denavit-Hartenberg table and the lengths in them, ready for any notation."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import sympy

from generator.constants import exact_constant
from generator.review.decimals import decimal
from generator.review.formula import Formula, formula
from generator.robot.description import PRISMATIC, Joint, Length, Robot


@dataclass(frozen=True)
class Row:
    """One joint of the table: its label, kind, antecedent and six parameters."""

    joint: Joint
    label: str
    cells: tuple[tuple[str, Formula], ...]


def rows(robot: Robot) -> list[Row]:
    """The table of modified Denavit-Hartenberg parameters; gamma and b appear only where a robot needs them."""
    branched = any(joint.gamma != 0 or joint.b != 0 for joint in robot.joints)
    columns = ("gamma", "b", "alpha", "d", "theta", "r") if branched else ("alpha", "d", "theta", "r")
    return [
        Row(
            joint,
            f"{joint.number} ({joint.label})" if joint.label else str(joint.number),
            tuple((name, formula(getattr(joint, name))) for name in columns),
        )
        for joint in robot.joints
    ]


def limits(joint: Joint) -> str:
    """The range of a joint in degrees or metres, then its limits of speed, acceleration and torque [SI]; "none" where
    the file gives none.
    """
    told = []
    if joint.lower is not None and joint.upper is not None:
        unit = "m" if joint.sigma == PRISMATIC else "deg"
        told.append(f"{_end(joint.lower, joint)} to {_end(joint.upper, joint)} {unit}")
    either_way = {
        f"{joint.position_unit}/s": joint.speed_limit,
        f"{joint.position_unit}/s2": joint.acceleration_limit,
        joint.torque_unit: joint.torque_limit,
    }
    sizes = [f"{decimal(exact_constant(size))} {unit}" for unit, size in either_way.items() if size is not None]
    if sizes:
        told.append(f"{', '.join(sizes)} either way")
    return "; ".join(told) or "none"


def length_value(length: Length) -> str:
    """The value of a length with its unit."""
    return f"{decimal(exact_constant(length.value))} {length.unit}"


def _end(value: sympy.Expr, joint: Joint) -> str:
    exact: Fraction = exact_constant(value if joint.sigma == PRISMATIC else value * 180 / sympy.pi)
    return decimal(exact, 5)
