"""What a parameter is, and the ten inertial parameters of a body in their standard order (report eq. 4)."""

from __future__ import annotations

from dataclasses import dataclass

from generator.robot.description import Joint

#: What is a sum of masses times squares, which is never negative.
NOT_NEGATIVE = ("XX", "YY", "ZZ", "M")
#: Stem, unit and meaning, in the standard order; tensor and first moments about the frame's origin, in its axes.
INERTIAL = (
    ("XX", "kg m2", "moment of inertia about x, about the frame's origin"),
    ("XY", "kg m2", "element xy of the inertia tensor (minus the integral of x y dm)"),
    ("XZ", "kg m2", "element xz of the inertia tensor (minus the integral of x z dm)"),
    ("YY", "kg m2", "moment of inertia about y, about the frame's origin"),
    ("YZ", "kg m2", "element yz of the inertia tensor (minus the integral of y z dm)"),
    ("ZZ", "kg m2", "moment of inertia about z, about the frame's origin"),
    ("MX", "kg m", "first moment along x: mass times x of the centre of mass"),
    ("MY", "kg m", "first moment along y: mass times y of the centre of mass"),
    ("MZ", "kg m", "first moment along z: mass times z of the centre of mass"),
    ("M", "kg", "mass"),
)
INERTIAL_STEMS = tuple(stem for stem, _, _ in INERTIAL)
INERTIAL_UNITS = tuple(unit for _, unit, _ in INERTIAL)


@dataclass(frozen=True)
class Parameter:
    """A parameter of the model.

    ``name`` is the field's symbol and the joint's number ("ZZ1R", "Fv1", "k1"), or a length's name. ``joint`` is 0
    where it belongs to none. ``lower`` and ``upper`` are physical bounds on its value (a friction coefficient is not
    negative), None where it has none; one that is ``positive`` is not at its lower bound either.
    """

    name: str
    unit: str
    joint: int
    meaning: str
    lower: float | None = None
    upper: float | None = None
    positive: bool = False

    def allows(self, value: float) -> bool:
        """Whether ``value`` is within the physical bounds."""
        return (
            not (self.positive and value == self.lower)
            and (self.lower is None or value >= self.lower)
            and (self.upper is None or value <= self.upper)
        )


def inertial_parameters(joint: Joint) -> tuple[Parameter, ...]:
    """The ten inertial parameters of the body that frame ``joint`` carries, XX XY XZ YY YZ ZZ MX MY MZ M."""
    return tuple(
        Parameter(f"{stem}{joint.number}", unit, joint.number, meaning, 0.0 if stem in NOT_NEGATIVE else None)
        for stem, unit, meaning in INERTIAL
    )
