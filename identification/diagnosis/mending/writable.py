"""Which of what was found a robot file can hold, so that it and the runs can still be read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from generator.effects.library import library
from generator.errors import InputError
from generator.robot.description import Robot
from generator.words import numbered
from identification import recipes
from identification.corrections import TooWarm, Untold
from identification.dataset import Run, load
from identification.diagnosis.columns.hypothesis import EFFECT, SIGNAL
from identification.diagnosis.columns.warming import following
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.runs.roles import Roles
from identification.diagnosis.runs.scene import Scene


def writable(
    text: str, file: str, additions: Sequence[Addition], roles: Roles, scenes: Sequence[Scene]
) -> tuple[list[Addition], list[str]]:
    """The additions without those that the robot file ``text`` cannot hold, and without drifts by which some run's
    torque constant would be none; and what is to be told.

    Where a run lacks the temperature that tells how warm a drive is, ``scenes`` say after what time it is.
    """
    kept, notes = _held(text, file, additions)
    while any(map(_by_warmth, kept)):
        try:
            # What can be read is not too warm, nor of an unknown warmth.
            for _ in loaded((*roles.searched, *roles.test), repaired(text, file, kept).robot):
                pass
            break
        except TooWarm as error:
            fewer = [one for one in kept if one.effect != "torque_drift" or error.joint not in one.joints]
            if len(fewer) == len(kept):
                raise
            kept = fewer
            notes.append(f"the drift of the torque constant of joint {error.joint} is not written: {error}")
        except Untold as error:
            kept.append(_by_time(error.joint, scenes))
            notes.append(
                f"{error.place.file} has no temperature of joint {error.joint}: its drive gets warm there after the "
                "same time as in the other runs"
            )
    return kept, notes


def loaded(sources: Sequence[str], robot: Robot) -> Iterator[Run]:
    """Runs as a robot's recipe reads them."""
    columns = recipes.recipe_of(robot.name).columns
    for source in sources:
        yield load(source, robot, columns, resting=True)


def _held(text: str, file: str, additions: Sequence[Addition]) -> tuple[list[Addition], list[str]]:
    """Those that are read back, each beside the ones before it."""
    kept, notes = list[Addition](), list[str]()
    try:
        repaired(text, file, additions)
        return list(additions), notes
    except InputError:
        # One of them is to blame.
        pass
    for one in additions:
        try:
            repaired(text, file, [*kept, one])
            kept.append(one)
        except InputError as error:
            where = numbered("joint", one.joints)
            notes.append(f"{one.effect} on {where} is not written: {error.problem}, expected {error.expected}")
    return kept, notes


def _by_warmth(one: Addition) -> bool:
    """Whether torques depend on how warm a drive is by it."""
    return one.effect == "torque_drift" or (one.kind == EFFECT and "warmth" in library()[one.effect].needs)


def _by_time(joint: int, scenes: Sequence[Scene]) -> Addition:
    """A time constant of the drive of ``joint`` (number), as the warmth goes that the file tells by temperature."""
    k = scenes[0].robot.numbers.index(joint)
    told = [scene for scene in scenes if scene.warmth_is_stated(k)]
    return Addition(
        SIGNAL, "warm_up_time", (joint,), {"warm_up_time": following(told, [scene.warmth(k) for scene in told])}
    )
