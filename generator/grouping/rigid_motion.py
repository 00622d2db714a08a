"""How twists, energies and inertial parameters pass a joint: the linear maps that grouping works with.

Energy rows: the kinetic energy of a body is e(V) . chi with V = (v, w) the twist of its frame and chi its ten inertial
parameters; e is quadratic in V (Gautier and Khalil 1990).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from generator.grouping.linear_algebra import Matrix, Vector
from generator.grouping.scalars import Numbers, Scalar, fixed_angle, fixed_shift
from generator.robot.description import PRISMATIC, REVOLUTE, Joint

#: Position of each entry of the inertia tensor in the ten inertial parameters; 6..8 the first moments, 9 the mass.
_TENSOR = ((0, 1, 2), (1, 3, 4), (2, 4, 5))


def placement(joint: Joint, numbers: Numbers) -> tuple[Matrix, Vector]:
    """Axes and origin of frame j in its antecedent's frame, the joint variable set to zero where it may be."""
    ca, sa = numbers.cosine_sine(joint.alpha)
    ct, st = numbers.cosine_sine(fixed_angle(joint))
    cg, sg = numbers.cosine_sine(joint.gamma)
    d, r, b = (numbers.length(length) for length in (joint.d, fixed_shift(joint), joint.b))
    zero, one = numbers.zero, numbers.one
    about_x = [[ct, -st, zero], [ca * st, ca * ct, -sa], [sa * st, sa * ct, ca]]
    along = [d, -(sa * r), b + ca * r]
    about_z = [[cg, -sg, zero], [sg, cg, zero], [zero, zero, one]]
    rotation = [[_sum(numbers, (about_z[i][m] * about_x[m][k] for m in range(3))) for k in range(3)] for i in range(3)]
    position = [_sum(numbers, (about_z[i][m] * along[m] for m in range(3))) for i in range(3)]
    return rotation, position


def transport(joint: Joint, numbers: Numbers) -> Matrix:
    """The 10 x 10 matrix T: chi seen from the antecedent = T chi; energy rows pass the other way, e -> e T."""
    rotation, position = placement(joint, numbers)
    columns = []
    for parameter in range(10):
        unit = [numbers.integer(int(k == parameter)) for k in range(10)]
        columns.append(_moved(unit, rotation, position, numbers))
    return [[column[k] for column in columns] for k in range(10)]


def _moved(chi: Vector, rotation: Matrix, position: Vector, numbers: Numbers) -> Vector:
    """Ten parameters turned by ``rotation`` and shifted by ``position``: Huygens with first moments."""
    mass = chi[9]
    moment = [_sum(numbers, (rotation[i][k] * chi[6 + k] for k in range(3))) for i in range(3)]
    twice = numbers.integer(2) * _sum(numbers, (position[k] * moment[k] for k in range(3)))
    twice = twice + mass * _sum(numbers, (p * p for p in position))
    result = [numbers.zero] * 10
    for i in range(3):
        for k in range(i, 3):
            turned = _sum(
                numbers,
                (rotation[i][m] * chi[_TENSOR[m][n]] * rotation[k][n] for m in range(3) for n in range(3)),
            )
            entry = turned - position[i] * moment[k] - moment[i] * position[k] - mass * position[i] * position[k]
            result[_TENSOR[i][k]] = entry + twice if i == k else entry
    result[6:9] = [moment[i] + mass * position[i] for i in range(3)]
    result[9] = mass
    return result


def drift(joint: Joint, numbers: Numbers) -> Matrix:
    """The 10 x 10 matrix A: d chi / dq = A chi as the joint moves, chi seen from a frame that stays behind."""
    matrix = [[numbers.zero] * 10 for _ in range(10)]

    def put(row: int, column: int, value: int) -> None:
        matrix[row][column] = numbers.integer(value)

    if joint.sigma == REVOLUTE:
        # J' = ZJ - JZ and MS' = Z MS with Z the cross product with z.
        for row, column, value in ((0, 1, -2), (3, 1, 2), (1, 0, 1), (1, 3, -1), (2, 4, -1), (4, 2, 1)):
            put(row, column, value)
        put(6, 7, -1)
        put(7, 6, 1)
    elif joint.sigma == PRISMATIC:
        # MS' = M z and J' = 2 MZ I - z MS^T - MS z^T.
        put(8, 9, 1)
        for row, column, value in ((0, 8, 2), (3, 8, 2), (2, 6, -1), (4, 7, -1)):
            put(row, column, value)
    return matrix


def twist_transport(joint: Joint, numbers: Numbers) -> Matrix:
    """The 6 x 6 matrix X for row twists: (v, w) of frame j = (v, w) of its antecedent times X, at the joint's zero."""
    rotation, position = placement(joint, numbers)
    rows = []
    for k in range(6):
        v = [numbers.integer(int(i == k)) for i in range(3)]
        w = [numbers.integer(int(i + 3 == k)) for i in range(3)]
        v = [x + y for x, y in zip(v, _cross(w, position), strict=True)]
        rows.append(_turned(v, rotation, numbers) + _turned(w, rotation, numbers))
    return rows


def twist_drift(joint: Joint, numbers: Numbers) -> Matrix:
    """The 6 x 6 matrix for row twists: how a twist of the antecedent, seen from frame j, changes as the joint moves."""
    matrix = [[numbers.zero] * 6 for _ in range(6)]
    one = numbers.one
    if joint.sigma == REVOLUTE:
        for start in (0, 3):
            matrix[start][start + 1], matrix[start + 1][start] = -one, one
    elif joint.sigma == PRISMATIC:
        # d v = w x z.
        matrix[4][0], matrix[3][1] = one, -one
    return matrix


def screw(joint: Joint, numbers: Numbers) -> Vector:
    """The unit twist (v, w) of a moving joint in its own frame."""
    vector = [numbers.zero] * 6
    vector[5 if joint.sigma == REVOLUTE else 2] = numbers.one
    return vector


def energy(a: Sequence[Scalar], b: Sequence[Scalar], numbers: Numbers) -> Vector:
    """The symmetric bilinear form of the kinetic energy: row with T(V) = row(V, V) . chi."""
    va, wa, vb, wb = list(a[:3]), list(a[3:]), list(b[:3]), list(b[3:])
    half = numbers.one / numbers.integer(2)
    pairs = [(i, k) for i in range(3) for k in range(i, 3)]
    tensor = [(wa[i] * wb[i] if i == k else wa[i] * wb[k] + wa[k] * wb[i]) * half for i, k in pairs]
    moment = [(x + y) * half for x, y in zip(_cross(va, wb), _cross(vb, wa), strict=True)]
    return [*tensor, *moment, _sum(numbers, (x * y for x, y in zip(va, vb, strict=True))) * half]


def turn_to_frame(vector: Vector, joint: Joint, numbers: Numbers) -> Vector:
    """A free vector of the antecedent's frame in frame j, at the joint's zero."""
    return _turned(vector, placement(joint, numbers)[0], numbers)


def _turned(vector: Vector, rotation: Matrix, numbers: Numbers) -> Vector:
    return [_sum(numbers, (rotation[k][i] * vector[k] for k in range(3))) for i in range(3)]


def _cross(a: Vector, b: Vector) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _sum(numbers: Numbers, terms: Iterable[Scalar]) -> Scalar:
    total = numbers.zero
    for term in terms:
        total = total + term
    return total
