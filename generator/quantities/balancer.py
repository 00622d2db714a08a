"""Length, force and torque of the robot's balancers (report eq. 19 to 37)."""

from collections.abc import Mapping

import numpy as np
import sympy

from generator.effects.library import Instance
from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.lowering import lower
from generator.symbolic.model import Model
from generator.symbolic.vectors import Array


def observed(model: Model) -> list[Instance]:
    """The balancers whose parameters are known by themselves: one grouped with the bodies has no force of its own."""
    known = model.parameter_nodes
    return [one for one in model.effects if one.effect.observables and all(name in known for name in one.names)]


def _grouped(model: Model) -> str:
    """Which parameters of balancers are grouped with others, for want of which there is nothing to tell."""
    names = {name for one in model.effects if one.effect.observables for name in one.names}
    gone = [
        f"{one.name} is grouped into {' and '.join(one.into)}" for one in model.grouping.eliminated if one.name in names
    ]
    return ", ".join(gone)


def _observables(instance: Instance) -> Mapping[str, tuple[sympy.Expr, str, str]]:
    assert instance.effect.observables is not None
    return instance.effect.observables(instance.site)


def _signals(model: Model) -> tuple[Signal, ...]:
    instances = observed(model)
    several = sum(one.effect.observables is not None for one in model.effects) > 1
    result = []
    for instance in instances:
        suffix = f"_{instance.joint.number}" if several else ""
        for name, (_, unit, meaning) in _observables(instance).items():
            result.append(signals.scalar(name + suffix, unit, f"{meaning}, joint {instance.joint.number}"))
    return tuple(result)


def _build(model: Model) -> tuple[Array, ...]:
    result = []
    for instance in observed(model):
        values = model.lengths | model.variables(model.q)
        for parameter, name in zip(instance.effect.parameters, instance.names, strict=True):
            values[sympy.Symbol(parameter.stem, real=True)] = model.parameter_nodes[name]
        for expression, _, _ in _observables(instance).values():
            result.append(np.array(lower(model.program, expression, values), dtype=object))
    return tuple(result)


QUANTITY = Quantity(
    name="balancer",
    summary="Length, force and torque of the gravity balancer.",
    details="Report eq. 19 to 37; the torque is the balancer's part of the inverse dynamic model.",
    inputs=signals.together(signals.q),
    outputs=_signals,
    build=_build,
    applies=lambda model: bool(observed(model)),
    absence=_grouped,
)
