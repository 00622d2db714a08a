"""Cases at random: which robot, which effect on which joint, from the seed of the study alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from zlib import crc32

import numpy as np

from benchmarks.diagnosis_study.case import FREE, KNOWN, Case, Hidden
from benchmarks.diagnosis_study.study import STUDY
from generator.effects.library import library
from generator.robot.description import PRISMATIC, REVOLUTE
from tests.plant.effect import Effect
from tests.plant.known_effects import entry
from tests.plant.library import LAWS
from tests.plant.robots import ROBOTS

MODES = (FREE, KNOWN)
#: Sizes of the power curve, in multiples of the noise.
SIZES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
#: Motions of a case: three of four are periodic excitation alone.
_MOTIONS = ("fourier", "fourier", "fourier", "mixed")


def cells() -> tuple[str, ...]:
    """Names of the parts of the study."""
    return ("null", "one_3x", "one_1x", "two", "three", "pair", "outside", *(f"power_{size:g}x" for size in SIZES))


def cases(cell: str, mode: str, reserved: bool = True) -> Iterator[Case]:
    """Cases of a cell without end. Without ``reserved`` laws that are kept from the development are left out."""
    laws = [law for law in STUDY.laws if reserved or law not in STUDY.reserved]
    outside = [law for law in STUDY.outside if reserved or law not in STUDY.reserved]
    number = 0
    while True:
        rng = np.random.default_rng([STUDY.seed, crc32(cell.encode()), MODES.index(mode), number])
        robot = str(rng.choice(STUDY.robots))
        hidden = _hidden(cell, robot, laws, outside, rng)
        motion = str(rng.choice(_MOTIONS))
        beside = _beside(robot, hidden or (), rng)
        seed = int(rng.integers(1, 1_000_000))
        number += 1
        if hidden is not None:
            yield Case(cell, robot, mode, seed, hidden, motion, beside)


def _hidden(
    cell: str, robot: str, laws: Sequence[str], outside: Sequence[str], rng: np.random.Generator
) -> tuple[Hidden, ...] | None:
    """None where the draw has no place on the robot."""
    size = 3.0
    match cell.split("_"):
        case ["null"]:
            return ()
        case ["one", times]:
            names, size = [str(rng.choice(laws))], float(times.removesuffix("x"))
        case ["power", times]:
            names, size = [str(rng.choice(STUDY.power))], float(times.removesuffix("x"))
        case ["two"] | ["three"] as word:
            names = [str(name) for name in rng.choice(laws, 2 if word == ["two"] else 3, replace=False)]
        case ["pair"]:
            names = list(STUDY.pairs[rng.integers(len(STUDY.pairs))])
        case ["outside"]:
            names = [str(rng.choice(outside))]
        case _:
            raise ValueError(f"no cell {cell}")
    drawn = [_somewhere(name, robot, size, rng) for name in names]
    hidden = tuple(one for one in drawn if one)
    places = {(one.joint, STUDY.laws[one.law].named if one.law in STUDY.laws else one.law) for one in hidden}
    return hidden if len(places) == len(names) and not shares_coulomb(hidden) else None


def _beside(robot: str, hidden: tuple[Hidden, ...], rng: np.random.Generator) -> tuple[Hidden, ...]:
    """In a third of the cases one more effect that the robot file holds, on a joint without a hidden one."""
    law, joint = str(rng.choice(STUDY.beside)), int(rng.integers(1, ROBOTS[robot].joints + 1))
    there = rng.random() < 1 / 3 and joint not in {one.joint for one in hidden}
    return (Hidden(law, joint),) if there and has_place(law, robot, joint) else ()


def shares_coulomb(hidden: Sequence[Hidden]) -> bool:
    """Whether two of the laws are Coulomb friction of one joint, or take its place: together they may take more of it
    than there is.
    """
    of_coulomb = [one.joint for one in hidden if one.law == "coulomb" or LAWS[one.law].replaces_coulomb]
    return len({*of_coulomb}) < len(of_coulomb)


def has_place(law: str, robot: str, joint: int) -> bool:
    """Whether a robot file may hold a law on a joint, and the library an effect that it may be called: not each has a
    place on a slide.
    """
    kind = PRISMATIC if ROBOTS[robot].chain[joint - 1].prismatic else REVOLUTE
    known, effects = entry(Effect(law, joint), ROBOTS[robot]), library()
    names = [effects[name] for name in STUDY.laws[law].named if name in effects]
    named = not names or any(kind in one.kinds for one in names)
    return named and (known is None or kind in effects[known.effect].kinds)


def _somewhere(law: str, robot: str, size: float, rng: np.random.Generator) -> Hidden | None:
    n = ROBOTS[robot].joints
    places: Sequence[int] = range(1, n + 1)
    if law in STUDY.laws:
        expected = STUDY.laws[law]
        if expected.anywhere:
            places = [1]
        elif expected.joints is not None:
            places = expected.joints.get(robot, ())
        else:
            places = [joint for joint in places if has_place(law, robot, joint)]
    if not places:
        return None
    joint = int(rng.choice(places))
    other = int(rng.choice([j for j in range(1, n + 1) if j != joint])) if law == "cross_drag" else None
    return Hidden(law, joint, size, other)
