"""C99 on top of the C library: fixed-step simulation of the rigid and the flexible robot, closed loop included."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from generator.backends.printing.c_functions import c_language
from generator.backends.printing.language import LINE
from generator.backends.printing.plants import plants, turns_rotors
from generator.backends.printing.runge_kutta import METHODS, Method, Stage, stages
from generator.backends.printing.signals import paragraph
from generator.backends.printing.templates import render
from generator.symbolic.model import Model
from generator.version import VERSION

NAME = "simulation"


@dataclass(frozen=True)
class Integrator:
    """A method as C: the ``name`` of its function, a title, and the stages; the last one is the result."""

    name: str
    title: str
    stages: tuple[Stage, ...]

    @property
    def evaluations(self) -> int:
        """Evaluations of the accelerations a step: the last stage, which is the result, needs none."""
        return len(self.stages) - 1


def emit(model: Model) -> dict[str, str | bytes]:
    """Header and source by their paths; none where the model reads signals that are not simulated."""
    return sources(model, METHODS)


def sources(model: Model, methods: Sequence[Method]) -> dict[str, str | bytes]:
    """Header and source with these methods, at least two."""
    found = plants(model)
    if not found:
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
        "plants": found,
        "methods": [Integrator(m.name, m.title, tuple(stages(m, language))) for m in methods],
        "drives": turns_rotors(model),
    }
    return {
        f"{prefix}_simulation.h": render("simulation/header.h.jinja", **context),
        f"{prefix}_simulation.c": render("simulation/source.c.jinja", **context),
    }
