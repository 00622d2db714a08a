"""A robot's generated code, compiled for this machine while it is needed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from generator.backends import batch, c, python, simulation
from generator.backends.printing.plants import plants
from generator.derivation import derive
from generator.effects.library import library
from generator.errors import InputError
from generator.python_library import build_library, load_library
from generator.robot.description import Robot
from generator.symbolic.model import Model
from generator.writing import replace

#: What a simulation calls, and what the Python module cannot be without.
_QUANTITIES = (
    "direct_dynamics_sliding",
    "direct_dynamics_smooth",
    "flexible_direct_dynamics_sliding",
    "flexible_direct_dynamics_smooth",
    "gravity",
    "inertia_matrix",
    "inverse_dynamics",
    "joint_torque",
    "motor_position",
    "motor_speed",
    "motor_torque",
    "payload_regressor",
    "regressor_packed",
    "tool_jacobian",
    "tool_transform",
    "wrench_torque",
)


@dataclass(frozen=True)
class Machine:
    """The model of a robot and its generated Python ``module`` on the compiled library."""

    model: Model
    module: Any

    @property
    def robot(self) -> Robot:
        """The robot of the model."""
        return self.model.robot


@contextmanager
def compiled(robot: Robot) -> Iterator[Machine]:
    """The robot's machine, in a temporary folder that lasts as long as the body.

    Raises InputError where there is no C compiler, and for an effect that cannot be simulated, at its place.
    """
    model = derive(robot, names=_QUANTITIES, check=False)
    if not plants(model):
        raise _not_simulated(robot)
    with tempfile.TemporaryDirectory(prefix="counterpoise-") as temporary:
        folder = Path(temporary) / robot.name
        files: dict[str, bytes] = {}
        for name, emitted in (
            (c.NAME, c.library(model, ())),
            *((one.NAME, one.emit(model)) for one in (batch, python, simulation)),
        ):
            for path, content in emitted.items():
                files[f"{name}/{path}"] = content.encode() if isinstance(content, str) else content
        replace(folder, files)
        build_library(folder, robot.name)
        yield Machine(model, load_library(folder, robot.name))


def _not_simulated(robot: Robot) -> InputError:
    """The error of the first effect that reads more than the motion."""
    for use in robot.effects:
        effect = library()[use.effect]
        more = "a state of its own" if effect.states else "the drive's warmth" if "warmth" in effect.needs else ""
        if more:
            problem = f"effect {effect.id} reads {more}, which is not simulated"
            return InputError(use.place, problem, "effects of q, qd and qdd alone")
    return InputError(robot.place, "this robot cannot be simulated", "effects of q, qd and qdd alone")
