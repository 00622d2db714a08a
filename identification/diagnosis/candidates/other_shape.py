"""Another shape of an effect that the robot's file has: another order, Stribeck speed, place of a balancer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from generator.effects.effect import Effect
from generator.effects.library import Instance, effects_of
from generator.robot.description import Robot
from identification.arrays import Array
from identification.diagnosis.candidates.library import on_joint
from identification.diagnosis.columns.effect_columns import NEEDS
from identification.diagnosis.columns.hypothesis import SHAPE, Hypothesis, reshaped
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for each effect of the file whose shape can be searched, on each joint that moves.

    The columns are what a torque of the new shape has beyond one of the file's, so that a coefficient is how much of
    the effect has it: all, where that is the file's own coefficient.
    """
    if not scenes:
        return []
    robot = scenes[0].robot
    return [
        _otherwise(one, stated)
        for stated in effects_of(robot)
        if _searched(stated.effect, robot)
        for k in [robot.numbers.index(stated.joint.number)]
        if any(scene.moves(k) for scene in scenes)
        for one in on_joint(stated.effect, stated.joint, k, _without(stated, scenes), True)
        if any(not shape.scale for shape in one.shapes)
    ]


def _without(stated: Instance, scenes: Sequence[Scene]) -> Sequence[Scene]:
    """The scenes without an effect of the file, where the runs tell at which shapes a search begins."""
    if not any(shape.several for shape in stated.effect.shapes):
        return scenes
    nothing = dict.fromkeys(stated.names, 0.0)
    return [replace(one, values={**one.values, **nothing}) for one in scenes]


def _searched(effect: Effect, robot: Robot) -> bool:
    """Whether runs tell its shape beside its coefficients, and columns of other shapes can be made."""
    tried = any(shape.tried for shape in effect.shapes)
    return tried and set(effect.needs) <= NEEDS and ("motor" not in effect.needs or robot.drives is not None)


def _otherwise(one: Hypothesis, stated: Instance) -> Hypothesis:
    file = {name: float(value) for name, value in stated.site.values.items()}

    def columns(scene: Scene, shape: Mapping[str, float]) -> Array:
        return one.columns(scene, shape) - one.columns(scene, {**shape, **file})

    # Of a scale any value will do: the file's.
    kept = [shape for shape in one.shapes if shape.name in file and not shape.scale]
    names = {shape.name for shape in kept}
    return replace(
        one,
        title=f"{one.title} of another shape than the file's",
        kind=SHAPE,
        coefficients=tuple(replace(each, name=reshaped(each.name)) for each in one.coefficients),
        columns=columns,
        shapes=tuple(kept),
        given={name: value for name, value in file.items() if name not in names},
    )
