"""The library of effects, and the effects of one robot: found by listing this package, checked against the library."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy

import generator.effects
from generator.discovery import modules
from generator.effects.effect import Column, Effect, Shape, Site
from generator.errors import InputError, Place
from generator.robot.description import FIXED, EffectUse, Joint, Robot
from generator.robot.parameters import Parameter

#: Points at which a range is looked at.
_STEPS = 200


@dataclass(frozen=True)
class Instance:
    """An effect on one joint of one robot: ``parameters`` carry the joint's number, ``suffix`` "m" the motor side."""

    effect: Effect
    site: Site
    suffix: str = ""

    @property
    def joint(self) -> Joint:
        return self.site.joint

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(f"{p.stem}{self.suffix}{self.joint.number}" for p in self.effect.parameters)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        side = ", motor side" if self.suffix else ""
        return tuple(
            Parameter(name, p.unit(self.joint), self.joint.number, p.meaning + side, p.lower)
            for name, p in zip(self.names, self.effect.parameters, strict=True)
        )

    def columns(self) -> tuple[Column, ...]:
        return self.effect.columns(self.site)


@cache
def library() -> Mapping[str, Effect]:
    """Every effect by its id, in the order of their parameters on a joint."""
    found = [module.EFFECT for module in modules(generator.effects) if hasattr(module, "EFFECT")]
    return {effect.id: effect for effect in sorted(found, key=lambda effect: (effect.rank, effect.id))}


def effects_of(robot: Robot) -> tuple[Instance, ...]:
    """The effects of a robot's rigid model, joint by joint in the order of the library.

    Raises InputError for an unknown effect or value, a value with the wrong unit or out of its bounds, an effect given
    twice on a joint or on a joint that cannot carry it.
    """
    instances: dict[tuple[int, str], Instance] = {}
    for use in robot.effects:
        effect = _effect(use)
        for number in use.joints:
            joint = robot.joints[number - 1]
            if (number, effect.id) in instances:
                raise InputError(use.place, f"effect {effect.id} stands twice on joint {number}", "it once")
            if joint.sigma == FIXED:
                raise InputError(use.place, f"effect {effect.id} sits on fixed joint {number}", "a moving joint")
            if joint.sigma not in effect.kinds:
                raise InputError(use.place, f"effect {effect.id} cannot sit on joint {number}", "a revolute joint")
            site = Site(joint, _values(use, effect))
            _check_range(use, effect, site)
            instances[number, effect.id] = Instance(effect, site)
            _check_joints(robot, use, instances[number, effect.id])
    _check_names(robot, list(instances.values()))
    order = list(library())
    return tuple(instances[key] for key in sorted(instances, key=lambda key: (key[0], order.index(key[1]))))


def _check_joints(robot: Robot, use: EffectUse, instance: Instance) -> None:
    """An effect acts on joints that move."""
    moving = [joint.number for joint in robot.moving]
    for joint in {joint: None for column in instance.columns() for joint in column}:
        if joint not in moving:
            problem = f"effect {use.effect} acts on joint {joint}, which does not move"
            raise InputError(use.place, problem, f"one of {', '.join(map(str, moving))}")


def _check_range(use: EffectUse, effect: Effect, site: Site) -> None:
    """What must be positive is so over the joint's limits, where the file gives them."""
    lower, upper = site.joint.lower, site.joint.upper
    if effect.positive is None or lower is None or upper is None:
        return
    for name, expression in effect.positive(site).items():
        value = sympy.lambdify(site.q, expression, "math")
        least = min(value(float(lower + (upper - lower) * step / _STEPS)) for step in range(_STEPS + 1))
        if least <= 0:
            place = use.values[name].place if name in use.values else use.place
            raise InputError(
                place, f"{name} is too small: within the joint's limits {least:.3g} m is left", "a longer one"
            )


def _check_names(robot: Robot, instances: list[Instance]) -> None:
    """Every parameter has a name of its own, among the lengths too."""
    known = {length.name for length in robot.lengths} | {name for one in motor_side(robot) for name in one.names}
    for one in instances:
        for name in one.names:
            if name in known:
                place = next(use.place for use in robot.effects if use.effect == one.effect.id)
                raise InputError(place, f"the parameter {name} of {one.effect.id} has its name twice", "another name")
            known.add(name)


def motor_side(robot: Robot) -> tuple[Instance, ...]:
    """The drive-train effects of the elastic joints on the motor side: Iam, Fvm, Fcm, Offm, k (report eq. 12)."""
    sides = []
    for number in robot.flexible:
        for effect in library().values():
            if effect.drive_train:
                suffix = "" if "qe" in effect.needs else "m"
                sides.append(Instance(effect, Site(robot.joints[number - 1]), suffix))
    return tuple(sides)


def _effect(use: EffectUse) -> Effect:
    effect = library().get(use.effect)
    if effect is None or "qe" in effect.needs:
        known = [name for name, one in library().items() if "qe" not in one.needs]
        raise InputError(use.place, f"unknown effect {use.effect!r}", _one_of(use.effect, known))
    return effect


def _values(use: EffectUse, effect: Effect) -> dict[str, sympy.Expr]:
    shapes = {shape.name: shape for shape in effect.shapes}
    for name, quantity in use.values.items():
        if name not in shapes:
            known = _one_of(name, list(shapes)) if shapes else "none"
            raise InputError(quantity.place, f"effect {effect.id} has no value {name!r}", known)
    return {name: _value(use, effect, shape) for name, shape in shapes.items()}


def _value(use: EffectUse, effect: Effect, shape: Shape) -> sympy.Expr:
    quantity = use.values.get(shape.name)
    if quantity is None:
        if shape.default is None:
            problem = f"effect {effect.id} lacks its value {shape.name}"
            raise InputError(use.place, problem, f"{shape.meaning} [{shape.unit}]")
        return shape.default
    if quantity.unit != shape.unit:
        raise InputError(quantity.place, f"{shape.name} is given in {quantity.unit or '1'}", f"a value in {shape.unit}")
    _check_bounds(quantity.place, shape, quantity.value)
    return quantity.value


def _check_bounds(place: Place, shape: Shape, value: sympy.Expr) -> None:
    if shape.lower is not None and not value > shape.lower:
        raise InputError(place, f"{shape.name} is {value}", f"more than {shape.lower:g} {shape.unit}")
    if shape.upper is not None and not value < shape.upper:
        raise InputError(place, f"{shape.name} is {value}", f"less than {shape.upper:g} {shape.unit}")


def _one_of(name: str, known: list[str]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    return f"{near[0]!r} perhaps; known are {', '.join(known)}" if near else f"one of {', '.join(known)}"
