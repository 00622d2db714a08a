"""What each joint lets be seen of the parameters beyond it: an exact recursion over the chain.

The torques see a combination of parameters unless the energies it makes are zero (kinetic) or constant (potential)
over every motion. Split by the powers of the last joint's speed and by its position, this gives, joint by joint from
the tips, linear conditions on the parameters of one body; what satisfies them all is invisible at this joint and can be
moved to the antecedent body. It generalises the rules of Gautier and Khalil (1990) to any tree and any special
geometry (see also Wensing, Niemeyer and Slotine 2017 on the geometry of observability).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from generator.grouping.linear_algebra import Matrix, Span, Vector, null_space, times
from generator.grouping.rigid_motion import drift, energy, screw, turn_to_frame, twist_drift, twist_transport
from generator.grouping.scalars import Numbers, Scalar
from generator.robot.description import FIXED, PRISMATIC, Joint
from generator.robot.parameters import INERTIAL_STEMS

#: Stems of the twelve parameters of a joint, in their order: ten inertial ones, rotor inertia, offset.
STEMS = (*INERTIAL_STEMS, "Ia", "Off")
SIZE = len(STEMS)
#: Where the body's own parameters end.
ROTOR_INERTIA = STEMS.index("Ia")


@dataclass(frozen=True)
class Reach:
    """What the motion of a frame spans: ``twists`` (6), ``energies`` rows of the kinetic energy (10), and ``gravity``,
    the directions of gravity with a constant 1 as fourth component (4).
    """

    twists: Span
    energies: Span
    gravity: Span


def base_reach(gravity: Sequence[Scalar], numbers: Numbers) -> Reach:
    """Frame 0 stands still; gravity is one vector."""
    still = Reach(Span(6, numbers), Span(10, numbers), Span(4, numbers))
    still.gravity.add([*gravity, numbers.one])
    return still


def carried(joint: Joint, before: Reach, transport: Matrix, numbers: Numbers) -> Reach:
    """What the antecedent's motion alone makes the frame of ``joint`` do, over every position of the joint.

    ``transport`` is that of the joint (see ``rigid_motion``).
    """
    x = twist_transport(joint, numbers)
    twists = Span(6, numbers).add_all(times(row, x, numbers) for row in before.twists.basis)
    energies = Span(10, numbers).add_all(times(row, transport, numbers) for row in before.energies.basis)
    gravity = Span(4, numbers)
    for row in before.gravity.basis:
        gravity.add([*turn_to_frame(row[:3], joint, numbers), row[3]])
    if joint.sigma != FIXED:
        twists.close_under(twist_drift(joint, numbers))
        energies.close_under(drift(joint, numbers))
    if joint.sigma not in (FIXED, PRISMATIC):
        gravity.close_under(_turning(numbers))
    return Reach(twists, energies, gravity)


def moved(joint: Joint, by_antecedent: Reach, numbers: Numbers) -> Reach:
    """What the frame of ``joint`` does with its own speed included."""
    if joint.sigma == FIXED:
        return by_antecedent
    own = screw(joint, numbers)
    energies = Span(10, numbers).add_all(by_antecedent.energies.basis)
    energies.add_all(energy(own, twist, numbers) for twist in by_antecedent.twists.basis)
    energies.add(energy(own, own, numbers))
    twists = Span(6, numbers).add_all(by_antecedent.twists.basis)
    twists.add(own)
    return Reach(twists, energies, by_antecedent.gravity)


def invisible(
    joint: Joint, by_antecedent: Reach, present: Sequence[int], order: Sequence[int], numbers: Numbers
) -> Matrix:
    """Basis of the combinations of a joint's twelve parameters that no torque at it or before it shows.

    ``present`` are the indices of the parameters that exist; ``order`` the indices from the first to be eliminated to
    the last. Each basis vector has a 1 at the parameter it eliminates (its first nonzero in ``order``) where the
    others have 0.
    """
    conditions = Span(SIZE, numbers)
    for index in range(SIZE):
        if index not in present:
            conditions.add([numbers.integer(int(k == index)) for k in range(SIZE)])
    if joint.sigma == FIXED:
        conditions.add([numbers.integer(int(k == ROTOR_INERTIA)) for k in range(SIZE)])
    else:
        conditions.add_all(_conditions(joint, by_antecedent, numbers))
    reordered = Span(SIZE, numbers)
    for vector in null_space(conditions, numbers):
        reordered.add([vector[index] for index in order])
    back = {index: place for place, index in enumerate(order)}
    return [[row[back[index]] for index in range(SIZE)] for row in reordered.basis]


def _conditions(joint: Joint, by_antecedent: Reach, numbers: Numbers) -> list[Vector]:
    own, a = screw(joint, numbers), drift(joint, numbers)
    zero, half = numbers.zero, numbers.one / numbers.integer(2)
    # Coefficient of the squared joint speed, with the rotor's half Ia qd^2.
    rows = [[*energy(own, own, numbers), half, zero]]
    # Coefficients of the joint speed times the antecedent's twists.
    rows += [[*energy(own, twist, numbers), zero, zero] for twist in by_antecedent.twists.basis]
    # What remains must not change with the joint's position.
    rows += [[*times(row, a, numbers), zero, zero] for row in by_antecedent.energies.basis]
    # Torque of gravity, -g . dMS/dq, and the constant torque of the offset.
    for row in by_antecedent.gravity.basis:
        functional = [*[zero] * 6, *(-component for component in row[:3]), zero]
        rows.append([*times(functional, a, numbers), zero, row[3]])
    return rows


def _turning(numbers: Numbers) -> Matrix:
    matrix = [[numbers.zero] * 4 for _ in range(4)]
    matrix[0][1], matrix[1][0] = -numbers.one, numbers.one
    return matrix
