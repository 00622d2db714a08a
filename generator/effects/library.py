"""The library of effects, and the effects of one robot: found by listing this package, checked against the library."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache

import sympy

import generator.effects
from generator.discovery import modules
from generator.effects.effect import Column, Effect, Positive, Shape, Site, State
from generator.errors import InputError, Place
from generator.robot.description import PRISMATIC, REVOLUTE, EffectUse, Joint, Robot
from generator.robot.fields import check_size, nearest
from generator.robot.parameters import Parameter

_KINDS = {REVOLUTE: "revolute", PRISMATIC: "prismatic"}


@dataclass(frozen=True)
class Instance:
    """An effect on one joint of one robot: ``parameters`` carry the joint's number, ``suffix`` "m" the motor side."""

    effect: Effect
    site: Site
    suffix: str = ""

    @property
    def joint(self) -> Joint:
        """The joint that it sits on."""
        return self.site.joint

    @property
    def names(self) -> tuple[str, ...]:
        """Names of its parameters, in their order: stem, ``suffix`` and the joint's number."""
        return tuple(f"{p.stem}{self.suffix}{self.joint.number}" for p in self.effect.parameters)

    @property
    def on_joint(self) -> tuple[str, ...]:
        """The names that the same parameters have on the joint's side."""
        return tuple(f"{p.stem}{self.joint.number}" for p in self.effect.parameters)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Its parameters under these names, in the units of its kind of joint."""
        side = ", motor side" if self.suffix else ""
        return tuple(
            Parameter(name, p.unit(self.joint), self.joint.number, p.meaning + side, p.lower, p.upper)
            for name, p in zip(self.names, self.effect.parameters, strict=True)
        )

    def columns(self) -> tuple[Column, ...]:
        """Torque [N m, N] per unit of each parameter, in their order, by joint number."""
        return self.effect.columns(self.site)


@dataclass(frozen=True)
class StateUse:
    """A state of an effect on one joint, its symbol's name, and its rate of change."""

    state: State
    joint: Joint
    rate: sympy.Expr

    @property
    def name(self) -> str:
        """Name of its symbol: the stem and the joint's number."""
        return f"{self.state.stem}{self.joint.number}"


def states_of(instances: Iterable[Instance]) -> tuple[StateUse, ...]:
    """The states inside effects: joint by joint, in alphabetical order of their stems on each."""
    found = [
        StateUse(state, instance.joint, rate)
        for instance in instances
        if instance.effect.rates is not None
        for state, rate in zip(instance.effect.states, instance.effect.rates(instance.site), strict=True)
    ]
    return tuple(sorted(found, key=lambda one: (one.joint.number, one.state.stem)))


def undefined(instances: Iterable[Instance], names: Collection[str]) -> Instance | None:
    """The effect to blame where the columns of the parameters ``names`` have no real value, None if it is no effect."""
    guilty = [one for one in instances if not set(names).isdisjoint(one.names)]
    # An effect that follows the load has no value where any other one has none.
    return min(guilty, key=lambda one: "load" in one.effect.needs, default=None)


@cache
def library() -> Mapping[str, Effect]:
    """Every effect by its id, in the order of their parameters on a joint."""
    found = [module.EFFECT for module in modules(generator.effects) if hasattr(module, "EFFECT")]
    return {effect.id: effect for effect in sorted(found, key=lambda effect: (effect.rank, effect.id))}


def effects_of(robot: Robot) -> tuple[Instance, ...]:
    """The effects of a robot's rigid model, joint by joint in the order of the library; elasticity is not one of them.

    Raises InputError for an unknown effect or value, a value with the wrong unit or out of its bounds, an effect given
    twice on a joint or on a joint that cannot carry it.
    """
    instances: dict[tuple[int, str], Instance] = {}
    for use in robot.effects:
        effect = _effect(use)
        for number in use.joints:
            joint = robot.joints[number - 1]
            _check_joint(use, effect, robot, joint, [one.effect for (j, _), one in instances.items() if j == number])
            site = Site(joint, _values(use, effect, joint, robot), _ratios(use, effect, robot, joint))
            _check_range(use, effect, site)
            instances[number, effect.id] = Instance(effect, site)
    rigid = {key: one for key, one in instances.items() if "qe" not in one.effect.needs}
    _check_names(robot, list(rigid.values()))
    order = list(library())
    return tuple(rigid[key] for key in sorted(rigid, key=lambda key: (key[0], order.index(key[1]))))


def names_of_effects(robot: Robot) -> frozenset[str]:
    """Names of the parameters of a robot's effects, which no body has; raises as ``effects_of``."""
    return frozenset(name for one in effects_of(robot) for name in one.names)


def _check_joint(use: EffectUse, effect: Effect, robot: Robot, joint: Joint, there: list[Effect]) -> None:
    """The joint can carry the effect, beside those that are there."""
    number = joint.number
    if effect in there:
        raise InputError(use.place, f"effect {effect.id} stands twice on joint {number}", "it once")
    if joint.sigma not in effect.kinds:
        expected = f"a {' or '.join(_KINDS[sigma] for sigma in effect.kinds)} joint"
        raise InputError(use.place, f"effect {effect.id} cannot sit on joint {number}", expected)
    if "qe" in effect.needs and number not in robot.flexible:
        raise InputError(use.place, f"the drive train of joint {number} is not elastic", "a joint of flexible")
    if effect.observables and any(one.observables for one in there):
        raise InputError(use.place, f"joint {number} has two balancers", "one, whose outputs carry its number")
    _check_others(use, effect, robot, joint)


def _check_range(use: EffectUse, effect: Effect, site: Site) -> None:
    """What must be positive is so over the joint's limits; where the file gives none, at q = 0."""
    lower, upper = site.joint.lower, site.joint.upper
    where = "at q = 0" if lower is None or upper is None else "within the joint's limits"
    for one, least in _not_positive(effect, site, lower or sympy.S.Zero, upper or sympy.S.Zero):
        problem = f"{one.value} is {one.problem}: {where} {least:.3g} m is left"
        raise InputError(use.values[one.value].place, problem, one.expected)


def missing_limits(robot: Robot) -> list[tuple[Place, str]]:
    """Where effects ask for limits that their joints lack, and why: what must be positive is not so over a turn."""
    found: list[tuple[Place, str]] = []
    for instance in effects_of(robot):
        joint, effect = instance.joint, instance.effect
        if joint.limits is None:
            values = robot.use(effect.id, joint.number).values
            for one, least in _not_positive(effect, instance.site, -sympy.pi, sympy.pi):
                problem = f"{one.value} is {one.problem} for joint {joint.number} without limits"
                found.append((values[one.value].place, f"{problem}: over a turn {least:.3g} m is left"))
    return found


def _not_positive(effect: Effect, site: Site, lower: sympy.Expr, upper: sympy.Expr) -> list[tuple[Positive, float]]:
    """What must be positive and is not so from ``lower`` to ``upper``, with its least value [m]."""
    if effect.positive is None or effect.extremes is None:
        return []
    positions = effect.extremes(site, lower, upper)
    least = [(one, min(float(one.length.subs(site.q, at)) for at in positions)) for one in effect.positive(site)]
    return [(one, value) for one, value in least if value <= 0]


def _check_names(robot: Robot, instances: list[Instance]) -> None:
    """Every parameter has a name of its own. No length has one that an effect could bring, here or in another file."""
    for length in robot.lengths:
        for effect in library().values():
            own, of_motor = _stems(effect)
            if any(re.fullmatch(rf"{stem}\d+R?", length.name) for stem in own | of_motor):
                problem = f"length {length.name!r} has the name of a parameter of {effect.id}"
                raise InputError(length.place, problem, "another name")
    known = {name for one in motor_side(robot) for name in one.names}
    for one in instances:
        for name in one.names:
            if name in known:
                place = robot.use(one.effect.id, one.joint.number).place
                raise InputError(place, f"the parameter {name} of {one.effect.id} has its name twice", "another name")
            known.add(name)


def _stems(effect: Effect) -> tuple[set[str], set[str]]:
    """Stems of its parameters on the joint, and on the motor side of an elastic one."""
    stems = {parameter.stem for parameter in effect.parameters}
    if "qe" in effect.needs:
        return set(), stems
    return stems, {f"{stem}m" for stem in stems} if effect.drive_train else set()


def motor_side(robot: Robot) -> tuple[Instance, ...]:
    """The drive-train effects of the elastic joints on the motor side: Iam, Fvm, Fcm, Offm, k (report eq. 12).

    Those with a value that only the file can tell are there where the file asks for them.
    """
    sides = []
    for number in robot.flexible:
        for effect in library().values():
            if effect.drive_train and (_by_default(effect) or robot.has(effect.id, number)):
                suffix = "" if "qe" in effect.needs else "m"
                joint = robot.joints[number - 1]
                sides.append(Instance(effect, Site(joint, _motor_values(robot, effect, joint)), suffix))
    return tuple(sides)


def lacking(robot: Robot, name: str) -> str | None:
    """What the robot's file would have to say for a parameter ``name`` to be there, None where no effect has it."""
    for joint in robot.moving:
        stem, rigid = name.removesuffix(str(joint.number)), joint.number not in robot.flexible
        for effect in library().values():
            own, of_motor = _stems(effect)
            if rigid and stem in of_motor:
                return f"joint {joint.number} among flexible"
            if stem in own:
                return f"the effect {effect.id} on joint {joint.number}"
    return None


def _by_default(effect: Effect) -> bool:
    """Whether an effect needs no value of the file."""
    return all(shape.default is not None for shape in effect.shapes)


def _motor_values(robot: Robot, effect: Effect, joint: Joint) -> dict[str, sympy.Expr]:
    """The values of a drive train's effect: those that the file gives on the joint, else the defaults."""
    uses = [use for use in robot.effects if use.effect == effect.id and joint.number in use.joints]
    return _values(uses[0] if uses else EffectUse(effect.id, (joint.number,)), effect, joint, robot)


def _effect(use: EffectUse) -> Effect:
    effect = library().get(use.effect)
    if effect is None:
        raise InputError(use.place, f"unknown effect {use.effect!r}", nearest(use.effect, library()))
    return effect


def _ratios(use: EffectUse, effect: Effect, robot: Robot, joint: Joint) -> dict[int, sympy.Expr]:
    """The row of the joint's motor in N, without its zeros, for an effect that needs it."""
    if "motor" not in effect.needs:
        return {}
    if robot.drives is None:
        raise InputError(use.place, f"effect {effect.id} needs the motor's position", "drives with gear_ratios")
    row = robot.drives.coupling[robot.moving.index(joint)]
    pairs = zip(robot.moving, row, strict=True)
    return {other.number: ratio for other, ratio in pairs if ratio != 0}


def _values(use: EffectUse, effect: Effect, joint: Joint, robot: Robot) -> dict[str, sympy.Expr]:
    shapes = {shape.name: shape for shape in effect.shapes}
    for name, quantity in use.values.items():
        if name not in shapes:
            known = nearest(name, shapes)
            raise InputError(quantity.place, f"effect {effect.id} has no value {name!r}", known)
    others = [use.values[shape.name].value for shape in effect.shapes if shape.joint and shape.name in use.values]
    between = _unit_between(others, joint, robot)
    units = {name: (shape.unit_on(joint), between if shape.per_other else "") for name, shape in shapes.items()}
    return {name: _value(use, effect, shape, *units[name]) for name, shape in shapes.items()}


def _unit_between(numbers: Collection[sympy.Expr], joint: Joint, robot: Robot) -> str:
    """The unit of the joint's motion per that of the joint in ``numbers``; empty where they are of one kind."""
    kinds = {other.sigma for other in robot.moving if other.number in numbers}
    return ("rad/m", "m/rad")[joint.sigma == PRISMATIC] if kinds - {joint.sigma} else ""


def unit_of(shape: Shape, instance: Instance, robot: Robot) -> str:
    """The SI unit of a shape value of an effect on its joint; that of a ratio between two joints is by their kinds."""
    given = instance.site.values
    others = [given[one.name] for one in instance.effect.shapes if one.joint]
    between = _unit_between(others, instance.joint, robot) if shape.per_other else ""
    return between or shape.unit_on(instance.joint)


def _value(use: EffectUse, effect: Effect, shape: Shape, unit: str, between: str = "") -> sympy.Expr:
    """The value in ``unit``, which may be written in the unit ``between`` two joints as well, if there is one."""
    quantity = use.values.get(shape.name)
    if quantity is None:
        if shape.default is None:
            problem = f"effect {effect.id} lacks its value {shape.name}"
            raise InputError(use.place, problem, f"{shape.meaning} [{unit}]")
        return shape.default
    if quantity.unit not in (unit, between or unit):
        given = f"is given in {quantity.unit}" if quantity.unit not in ("", "1") else "has no unit"
        expected = "a number without a unit" if unit == "1" else f"a value in {unit}"
        expected += f" or in {between}" if between else ""
        raise InputError(quantity.place, f"{shape.name} {given}", expected)
    _check_bounds(quantity.place, shape, unit, quantity.value)
    return quantity.value


def _check_others(use: EffectUse, effect: Effect, robot: Robot, joint: Joint) -> None:
    """What must be the number of another moving joint is one."""
    others = [other.number for other in robot.moving if other is not joint]
    for shape in effect.shapes:
        given = use.values.get(shape.name)
        if shape.joint and given is not None and given.value not in others:
            expected = f"another moving joint, one of {', '.join(map(str, others))}" if others else "a second joint"
            raise InputError(given.place, f"{shape.name} of joint {joint.number} is {given.value}", expected)


def _check_bounds(place: Place, shape: Shape, unit: str, value: sympy.Expr) -> None:
    if value == shape.default:
        return
    check_size(place, shape.name, value, any_small=shape.lower is None and not shape.nonzero)
    if shape.lower is not None and not float(value) > shape.lower:
        raise InputError(place, f"{shape.name} is {value}", f"more than {shape.lower:g} {unit}")
    if shape.nonzero and value == 0:
        raise InputError(place, f"{shape.name} is 0", "a number other than zero")
    if shape.upper is not None and not float(value) < shape.upper:
        raise InputError(place, f"{shape.name} is {value}", f"less than {shape.upper:g} {unit}")
