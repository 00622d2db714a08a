"""The library of effects as a document: every effect by its id, with its law, signs, assumptions and source."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

import sympy

from generator.effects.effect import Effect, Site
from generator.effects.library import Instance, library
from generator.review.laws import observables, rates, torque
from generator.review.plain import plain
from generator.robot.description import REVOLUTE, Joint

#: A joint that stands for any; another one turns a coupled rotor with it.
_JOINT = Joint(1, 0, REVOLUTE, *(sympy.S.Zero,) * 2, sympy.Symbol("q1", real=True), sympy.S.Zero)
_OTHER = sympy.Integer(2)
_WIDTH = 120


def page() -> str:
    """Markdown: one section per effect, in the order of their parameters on a joint."""
    return "\n".join(line for effect in library().values() for line in _section(effect)).rstrip("\n") + "\n"


def _section(effect: Effect) -> Iterator[str]:
    motor_side = "qe" in effect.needs
    yield f"### `{effect.id}`\n"
    yield f"{effect.title[:1].upper()}{effect.title[1:]}.\n"
    yield "```text"
    instance = Instance(effect, _site(effect))
    equations = [*(observables(instance) or torque(instance, "j")), *rates(instance, "j")]
    yield from map(plain, equations)
    yield "```\n"
    yield "| | unit | | |"
    yield "| --- | --- | --- | --- |"
    for parameter in effect.parameters:
        bounds = [f"at least {parameter.lower:g}"] if parameter.lower is not None else []
        bounds += [f"at most {parameter.upper:g}"] if parameter.upper is not None else []
        yield f"| `{parameter.stem}` | {_units(*parameter.units)} | {parameter.meaning} | {', '.join(bounds)} |"
    for shape in effect.shapes:
        limits = [f"more than {shape.lower:g}"] if shape.lower is not None else []
        limits += [f"less than {shape.upper:g}"] if shape.upper is not None else []
        limits += ["not 0"] if shape.nonzero else []
        limits += ["rad/m or m/rad between a slide and a revolute joint"] if shape.per_other else []
        limits += [f"default {shape.default}"] if shape.default is not None else []
        units = _units(shape.unit, shape.prismatic or shape.unit)
        yield f"| value `{shape.name}` | {units} | {shape.meaning} | {', '.join(limits)} |"
    for state in effect.states:
        yield f"| state `{state.stem}` | {_units(*state.units)} | {state.meaning} | |"
    yield ""
    side = "elastic drive trains" if motor_side else "link side"
    sides = [f"{side}, part of the load" if effect.loads else side]
    sides += ["motor side of elastic joints" if effect.drive_train and not motor_side else ""]
    notes = [f"Sign: {effect.sign_convention}.", f"Acts on the {' and the '.join(filter(None, sides))}."]
    notes += [f"Assumed: {effect.assumptions}."] if effect.assumptions else []
    yield from textwrap.wrap(" ".join([*notes, f"Source: {effect.source}."]), _WIDTH)
    yield ""


def _site(effect: Effect) -> Site:
    """Values by name, powers included."""
    values = {s.name: _OTHER if s.joint else sympy.Symbol(s.name, positive=True) for s in effect.shapes}
    return Site(_JOINT, values, {1: sympy.Integer(1)} if "motor" in effect.needs else {})


def _units(revolute: str, prismatic: str) -> str:
    return revolute if revolute == prismatic else f"{revolute}; {prismatic}"
