"""What is asked of a motion, checked before the search begins; the place of an error is the option of the command."""

from __future__ import annotations

from generator.bounds import above, not_negative, whole_number
from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from identification.default_sets import RIGID
from identification.excitation.criterion import CONDITION, DETERMINANT
from identification.excitation.design import DRAWN
from identification.excitation.request import Request
from identification.named_set import named_set

#: Rows that a motion may have.
_MOST = 1e7
#: Least noise that is one, and largest noise, speed and acceleration [SI]: beyond, squares overflow.
_LEAST, _LARGEST = 1e-12, 1e12


def check(request: Request, robot: Robot) -> None:
    """Raises InputError for what no motion can have, for noise that is none or not that of the robot's motors, and for
    a parameter set that the robot has not.
    """
    named_set(robot, request.parameters, command_line("--parameters"), RIGID)
    _check_motion(request)
    _check_noise(request, len(robot.moving))
    fewest = request.filters_of(robot).at(request.rate).fewest
    if request.samples < fewest:
        problem = f"{request.samples} samples at {request.rate:g} Hz"
        raise InputError(command_line("--periods"), problem, f"at least {fewest} for the filters")


def _check_motion(request: Request) -> None:
    for option, value in (("--frequency", request.frequency), ("--rate", request.rate)):
        above(value, option, 0)
    for option, limit in (("--speed", request.speed), ("--acceleration", request.acceleration)):
        if limit is not None:
            above(limit, option, 0, _LARGEST)
    for option, count, least, most in (
        ("--harmonics", request.harmonics, 2, 50),
        ("--periods", request.periods, 1, 1000),
        ("--evaluations", request.evaluations, DRAWN, 10**7),
        ("--seed", request.seed, 0, 2**63),
    ):
        whole_number(count, option, least, most)
    if not (samples := request.periods / request.frequency * request.rate) <= _MOST:
        problem = f"{request.periods} periods of {1 / request.frequency:g} s make {samples:g} rows"
        raise InputError(command_line("--periods"), problem, f"at most {_MOST:g}")
    if request.criterion not in (DETERMINANT, CONDITION):
        raise InputError(command_line("--criterion"), repr(request.criterion), f"{DETERMINANT} or {CONDITION}")
    fastest = request.frequency * request.harmonics
    if request.rate < 20 * fastest:
        raise InputError(command_line("--rate"), f"{request.rate:g}", f"20 times the highest harmonic, {fastest:g} Hz")


def _check_noise(request: Request, n: int) -> None:
    noise, part = request.noise, request.noise_part
    if len(noise) not in (0, 1, n):
        raise InputError(
            command_line("--noise"), f"{len(noise)} numbers", "one" if n == 1 else f"one, or one for each of {n} motors"
        )
    for option, value in (*(("--noise", one) for one in noise), ("--noise-part", 0.0 if part is None else part)):
        if not_negative(value, option, _LARGEST):
            above(value, option, _LEAST, _LARGEST)
    if not part and noise and not all(noise):
        raise InputError(command_line("--noise"), "a motor without noise", "noise on every motor, or --noise-part")
    if part == 0 and not noise:
        raise InputError(command_line("--noise-part"), "0, and no --noise", "a measurement that is not exact")
