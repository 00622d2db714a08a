"""C99 on top of the C library: fixed-step simulation of the rigid and the flexible robot, closed loop included."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from generator.backends.printing.c_functions import c_language
from generator.backends.printing.language import LINE
from generator.backends.printing.runge_kutta import METHODS, Method, Stage, stages
from generator.backends.printing.signals import paragraph
from generator.backends.printing.templates import render
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "simulation"

#: What the direct models read that are simulated.
_SIGNALS = {"q", "qd", "tau", "tau_ext", "direction", "width"}
#: The maps between joints and rotors of a robot that has drives.
_MAPS = ("motor_position", "motor_speed", "motor_torque", "joint_torque")


@dataclass(frozen=True)
class Plant:
    """What is simulated: its ``name``, its coordinates' number ``size`` and meaning, the functions that it calls.

    ``links`` are the coordinates whose links slide as well, in the order of their elongations. ``load`` tells whether
    torques of the surroundings are an input of its own.
    """

    name: str
    size: int
    coordinates: str
    surfaces: str
    sliding: str
    smooth: str
    links: tuple[int, ...]
    load: bool


@dataclass(frozen=True)
class Integrator:
    """A method as C: the ``name`` of its function, a title, and the stages; the last one is the result."""

    name: str
    title: str
    order: int
    stages: tuple[Stage, ...]

    @property
    def evaluations(self) -> int:
        return len(self.stages) - 1


def emit(model: Model) -> dict[str, str | bytes]:
    """Header and source by their paths; none where the model reads signals that are not simulated."""
    return sources(model, METHODS)


def sources(model: Model, methods: Sequence[Method]) -> dict[str, str | bytes]:
    """Header and source with these methods, at least two."""
    plants = [plant for plant in _plants(model) if _known(model, plant)]
    if not plants:
        return {}
    prefix = model.robot.name
    language = c_language(prefix)
    context = {
        "prefix": prefix,
        "macro": prefix.upper(),
        "version": VERSION,
        "digest": model.robot.digest,
        "title": paragraph(f"{prefix}: simulation. {model.robot.description}", LINE - 3),
        "nq": model.dof,
        "plants": plants,
        "methods": [Integrator(m.name, m.title, m.order, tuple(stages(m, language))) for m in methods],
        "drives": all(name in model.functions for name in _MAPS),
    }
    return {
        f"{prefix}_simulation.h": render("simulation/header.h.jinja", **context),
        f"{prefix}_simulation.c": render("simulation/source.c.jinja", **context),
    }


def _plants(model: Model) -> list[Plant]:
    found = [
        Plant(
            "rigid",
            model.dof,
            "joint positions",
            "the joints",
            "direct_dynamics_sliding",
            "direct_dynamics_smooth",
            (),
            False,
        )
    ]
    if model.elastic:
        found.append(
            Plant(
                "flexible",
                model.flexible_dof,
                "[q_m; q_e]: motors in joint units, then elongations",
                "the motors, then the links of the elastic joints",
                "flexible_direct_dynamics_sliding",
                "flexible_direct_dynamics_smooth",
                model.elastic,
                True,
            )
        )
    return found


def _known(model: Model, plant: Plant) -> bool:
    functions = [model.functions[name] for name in (plant.sliding, plant.smooth)]
    return all(signal.name in _SIGNALS for function in functions for signal in function.inputs)
