"""Physically consistent parameters and states, the same ones on every machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import localcontext
from itertools import islice
from random import Random

import numpy as np

from generator.reference.arithmetic import CONTEXT, decimals
from generator.reference.joint_effects import LAWS, acting
from generator.reference.matter import INERTIAL
from generator.robot.description import PRISMATIC, REVOLUTE, Joint, Robot
from generator.robot.undefined import hardly_defined

#: Positions drawn until every effect has a value.
_TRIES = 1000
#: Room around a position in which effects have values too [rad, m]: more than what a drive train is stretched by, and
#: enough to stay away from the edge, where torques grow without bound.
_ROOM = 0.1

#: Farthest way from the position within the limits that is nearest to zero, by kind of joint: a turn and little more
#: [rad], or metres. Far from zero, single precision leaves too few digits of a position to compare.
_FARTHEST = {REVOLUTE: 6.4, PRISMATIC: 5.0}

#: Range of a parameter for which no law gives one.
_USUAL = (0.5, 2.0)
#: Ranges of parameters by stem [SI], those of elastic drive trains and those of the effects.
_RANGES = {
    "Iam": (0.5, 3.0),
    "Fvm": (1.0, 9.0),
    "Fcm": (2.0, 15.0),
    "Offm": (-4.0, 4.0),
    "k": (2e3, 9e3),
    **{stem: limits for law in LAWS.values() for stem, limits in law.ranges.items()},
}


def physical_parameters(robot: Robot, seed: int) -> dict[str, float]:
    """Standard parameters of ``robot`` by name, and those of its elastic joints, of at most five decimals.

    Each body is a cloud of point masses that fill a volume, so that its pseudo-inertia is positive definite; what is
    a loss, a stiffness or a rotor's inertia is positive.
    """
    draw = Random(seed)
    values: dict[str, float] = {}
    for body in robot.bodies:
        values |= {f"{stem}{body.number}": value for stem, value in _cloud(draw).items()}
    for use in robot.effects:
        for number in use.joints:
            values |= {f"{stem}{number}": _between(draw, stem) for stem in LAWS[use.effect].stems}
    values |= _loading_nothing(robot, values)
    for number in robot.flexible:
        values |= {f"{stem}{number}": _between(draw, stem) for stem in ("Iam", "Fvm", "Fcm", "Offm", "k")}
    return values


def _loading_nothing(robot: Robot, values: Mapping[str, float]) -> dict[str, float]:
    """A rotor whose inertia the file tells has that, and more; where there is none, nothing rubs by the load."""
    found: dict[str, float] = {}
    for use in robot.effects:
        law = LAWS[use.effect]
        if law.by_load and "rotor" in use.values:
            for number in use.joints:
                name = f"Ia{number}"
                rotor = round(float(use.values["rotor"].value), 5)
                nothing = {f"{stem}{number}": 0.0 for stem in law.stems}
                found |= {name: values[name] + rotor} if name in values else nothing
    return found


def payload(seed: int) -> list[float]:
    """Ten inertial parameters of a physical body in the tool frame, in their order."""
    cloud = _cloud(Random(seed))
    return [cloud[stem] for stem in INERTIAL]


def positions(robot: Robot, seed: int) -> list[float]:
    """Joint positions (n) inside the limits, a turn or a metre either way where there are none, of three decimals.

    Of wide limits, only the part nearest to zero is drawn from. Every effect has a value at the positions and close by;
    one without a law here is taken to have it. Raises InputError where no such positions are found.
    """
    draw = Random(seed)
    with localcontext(CONTEXT):
        uses = [use for use in robot.effects if use.effect in LAWS]
        effects = [(use.effect, one) for use in uses for one in acting(replace(robot, effects=(use,)))]
        for _ in range(_TRIES):
            q = [_position(joint, draw) for joint in robot.moving]
            around = [decimals(_shifted(robot, q, by)) for by in (0.0, -_ROOM, _ROOM)]
            undefined = ((name, one.number) for name, one in effects if not all(map(one.is_defined, around)))
            first = list(islice(undefined, 1))
            if not first:
                return q
    raise hardly_defined(robot, *first[0])


def _position(joint: Joint, draw: Random) -> float:
    reach = 1.0 if joint.sigma == PRISMATIC else 3.1
    lower, upper = joint.limits or (-reach, reach)
    nearest, way = min(max(0.0, lower), upper), _FARTHEST[joint.sigma]
    lower, upper = max(lower, nearest - way), min(upper, nearest + way)
    return round(lower + (upper - lower) * draw.uniform(0.02, 0.98), 3)


def _shifted(robot: Robot, q: Sequence[float], by: float) -> list[float]:
    """All positions moved ``by`` as much, as far as the limits let them."""
    limits = [joint.limits or (-np.inf, np.inf) for joint in robot.moving]
    return [min(max(x + by, lower), upper) for x, (lower, upper) in zip(q, limits, strict=True)]


def signal(size: int, seed: int, scale: float = 1.0) -> list[float]:
    """Numbers within ``scale`` either way, none of them near zero, of three decimals."""
    draw = Random(seed)
    return [round(scale * draw.choice((-1, 1)) * draw.uniform(0.1, 1.0), 3) for _ in range(size)]


def _cloud(draw: Random) -> dict[str, float]:
    """Inertial parameters of eight points of two to five kilograms around a random centre.

    Coordinates are whole centimetres and masses tenths of a kilogram, so that five decimals hold every parameter.
    """
    centre = [draw.randint(-20, 20) for _ in range(3)]
    points = [_add(centre, [side * draw.randint(4, 25) for side in corner]) for corner in _CORNERS]
    masses = [draw.randint(20, 50) for _ in points]
    at, weight = np.array(points), np.array(masses)
    first, second = weight @ at, (weight[:, None] * at).T @ at
    tensor = np.trace(second) * np.eye(3, dtype=int) - second
    xx, xy, xz, yy, yz, zz = (int(tensor[i, k]) / 1e5 for i in range(3) for k in range(i, 3))
    mx, my, mz = (int(moment) / 1e3 for moment in first)
    return dict(zip(INERTIAL, (xx, xy, xz, yy, yz, zz, mx, my, mz, sum(masses) / 10), strict=True))


#: Signs of the eight octants.
_CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def _add(a: Sequence[int], b: Sequence[int]) -> list[int]:
    return [x + y for x, y in zip(a, b, strict=True)]


def _between(draw: Random, stem: str) -> float:
    lower, upper = _RANGES.get(stem, _USUAL)
    return round(draw.uniform(lower, upper), 2)
