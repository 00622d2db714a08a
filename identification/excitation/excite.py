"""The motion that shows a robot's parameters best, and what will be known of them afterwards, as one call."""

from __future__ import annotations

import numpy as np

from generator.command_line import command_line
from generator.robot.description import Robot
from identification.excitation.checks import check
from identification.excitation.criterion import Criterion
from identification.excitation.design import Progress, designed, usual_torques
from identification.excitation.expectation import expected
from identification.excitation.limits import limits_of
from identification.excitation.memory import Memory
from identification.excitation.noise import noise_of
from identification.excitation.request import Request
from identification.excitation.results import Excitation
from identification.excitation.shapes import Shapes
from identification.named_set import resolved_set
from identification.observation import Regressors


def excite(
    robot: Robot,
    request: Request | None = None,
    regressors: Regressors | None = None,
    progress: Progress = lambda part: None,
) -> Excitation:
    """The motion that is asked for, the same for the same ``request`` on one machine.

    ``regressors`` may be given to use them again; ``progress`` is told the part of the search that is done.

    Raises InputError for a request that is wrong, or wrong for the robot, and where its limits leave no motion.
    """
    request = request or Request()
    check(request, robot)
    recipe = request.filters_of(robot)
    given = regressors or Regressors(robot)
    values = resolved_set(given.model, request.parameters, command_line("--parameters"))
    loaded, filters = given.loaded_by(values), recipe.at(request.rate)
    limits = limits_of(robot, request.speed, request.acceleration)
    shapes = Shapes(limits, request.lowest, request.harmonics)
    memory = Memory(loaded, values, shapes.frequency, request.periods)
    usual = usual_torques(shapes, memory, request.seed)
    noise = noise_of(robot, request.noise or [0.0], request.unexplained, usual)
    judge = Criterion(memory, limits, noise, recipe.standstills(robot), filters.factor, request.criterion)
    design = designed(judge, shapes, request.evaluations, request.seed, progress)
    motion = design.series.motion(np.arange(request.samples) / request.rate)
    motion = memory.completed(motion, 1 / request.rate)
    foreseen = expected(motion, request.rate, loaded, recipe, values, noise)
    units = {one.name: one.unit for one in loaded.model.base_parameters}
    return Excitation(robot, request, design, limits, noise, motion, filters, foreseen, units)
