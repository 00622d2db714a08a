"""The law of an effect as equations, its fixed values written by name and its observables by theirs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import sympy

from generator.effects.effect import Site
from generator.effects.library import Instance
from generator.review.formula import Equation, Name, formula
from generator.robot.sections.drives import element_name


def torque(instance: Instance, index: str) -> list[Equation]:
    """The torque on each joint that the effect acts on; ``index`` is the joint's number or a letter that stands for it.

    An effect on the motor side of an elastic joint (parameters suffixed m) reads the motor's coordinate q_m, the
    elasticity itself the elongation q_e. The motor's row of N is named element by element: N22 and N21, or N2
    where it turns with its own joint alone.
    """
    site = _by_name(instance)
    site = replace(site, ratios={other: _ratio(site, other, index) for other in site.ratios})
    totals: dict[int, sympy.Expr] = {}
    for parameter, column in zip(instance.effect.parameters, instance.effect.columns(site), strict=True):
        symbol = sympy.Symbol(indexed(f"{parameter.stem}{instance.suffix}", index), real=True)
        for number, per_unit in column.items():
            totals[number] = totals.get(number, sympy.Integer(0)) + symbol * per_unit
    side, symbols = _side(instance, index), _symbols(instance, site, index)
    here = instance.joint.number
    return [
        Equation(Name(indexed("tau", side) if number == here else f"tau{number}"), formula(total.subs(symbols)))
        for number, total in totals.items()
    ]


def _ratio(site: Site, other: int, index: str) -> sympy.Symbol:
    """The element of N by which the motor of the site's joint turns with joint ``other``."""
    name = indexed("N", index) if len(site.ratios) == 1 else element_name(site.joint.number, other)
    return sympy.Symbol(name, real=True)


def rates(instance: Instance, index: str) -> list[Equation]:
    """The time derivatives of the effect's states, named with a dash."""
    if instance.effect.rates is None:
        return []
    site = _by_name(instance)
    symbols = _symbols(instance, site, index)
    pairs = zip(instance.effect.states, instance.effect.rates(site), strict=True)
    return [Equation(Name(f"{indexed(state.stem, index)}'"), formula(rate.subs(symbols))) for state, rate in pairs]


def observables(instance: Instance) -> list[Equation]:
    """What else the effect tells, each with those before it: length, force of the length, torque of the force."""
    if instance.effect.observables is None:
        return []
    site = _by_name(instance)
    number = str(instance.joint.number)
    known: dict[sympy.Expr, sympy.Expr] = {
        sympy.Symbol(p.stem, real=True): sympy.Symbol(indexed(p.stem, number), real=True)
        for p in instance.effect.parameters
    }
    equations = []
    for name, (expression, _, _) in instance.effect.observables(site).items():
        equations.append(Equation(Name(name), formula(expression.subs(known, simultaneous=True))))
        known = {
            expression: sympy.Symbol(name, real=True),
            expression.subs(site.q, 0): sympy.Function(name)(sympy.Integer(0)),
        } | known
    return equations


def _side(instance: Instance, index: str) -> str:
    """What stands below a coordinate: the joint, or its motor."""
    return f"m,{index}" if instance.suffix == "m" or "qe" in instance.effect.needs else index


def _symbols(instance: Instance, site: Site, index: str) -> dict[sympy.Symbol, sympy.Symbol]:
    """The symbols that the effect's expressions hold, and how they are written."""
    side = _side(instance, index)
    renamed = {
        site.q: indexed("q", side),
        site.qd: indexed("qd", side),
        site.qdd: indexed("qdd", side),
        site.elongation: f"q_e,{index}",
        site.load: indexed("load", index),
        site.warmth: indexed("warmth", index),
        **{site.state(state.stem): indexed(state.stem, index) for state in instance.effect.states},
    }
    return {old: sympy.Symbol(new, real=True) for old, new in renamed.items()}


def numbers(instance: Instance) -> dict[str, sympy.Expr]:
    """Values that stand in the law as numbers: zeros, and pure numbers such as an exponent."""
    pure = {shape.name for shape in instance.effect.shapes if shape.unit == "1"}
    return {name: value for name, value in instance.site.values.items() if name in pure or value == 0}


def alike(instances: Iterable[Instance]) -> list[list[Instance]]:
    """Instances in groups whose law is the same; a motor that several joints turn has a law of its own."""
    groups: dict[tuple[object, ...], list[Instance]] = {}
    for instance in instances:
        coupled = instance.joint.number if len(instance.site.ratios) > 1 else 0
        groups.setdefault((instance.effect.id, coupled, *sorted(numbers(instance).items())), []).append(instance)
    return list(groups.values())


def _by_name(instance: Instance) -> Site:
    """The effect's site with its values as symbols, but for those that are ``numbers``."""
    values = {name: sympy.Symbol(name, real=True) for name in instance.site.values}
    return replace(instance.site, values=values | numbers(instance))


def indexed(stem: str, index: str) -> str:
    """A name with a subscript, also where the stem ends in a digit or the subscript is a letter."""
    return f"{stem}{index}" if index.isdigit() else f"{stem}_{index}"
