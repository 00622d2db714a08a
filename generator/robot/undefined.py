"""Effects that have a real value at hardly any position: what is told of them."""

from __future__ import annotations

from generator.errors import InputError
from generator.robot.description import Robot


def hardly_defined(robot: Robot, effect: str, number: int) -> InputError:
    """The error, where the file asks for the effect on joint ``number``, that too few positions were found for it."""
    problem = f"effect {effect} has a real value at hardly any position of joint {number}"
    return InputError(robot.use(effect, number).place, problem, "values with which it has one where the joint moves")
