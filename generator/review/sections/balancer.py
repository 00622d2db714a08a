"""What the balancers do over the range of their joints: length, force and torque as curves."""

from __future__ import annotations

import math as mathematics
from collections.abc import Sequence

import numpy as np

from generator.effects.library import Instance
from generator.review.markup import Markup, element, join
from generator.review.plot import Curve, Marker, plot
from generator.review.words import unit
from generator.robot.description import PRISMATIC, Joint
from generator.symbolic.function import Function, Output
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model

TITLE = "Balancer"
ORDER = 90

_SAMPLES = 241


def render(model: Model) -> Markup | None:
    function = model.functions.get("balancer")
    observed = [instance for instance in model.effects if instance.effect.observables]
    if function is None or not observed:
        return None
    per_effect = len(function.outputs) // len(observed)
    parts = []
    for k, instance in enumerate(observed):
        parts.append(_balancer(model, function, instance, function.outputs[k * per_effect : (k + 1) * per_effect]))
    return join(parts)


def _balancer(model: Model, function: Function, instance: Instance, outputs: Sequence[Output]) -> Markup:
    joint = instance.joint
    lower, upper = _range(joint)
    positions = np.linspace(lower, upper, _SAMPLES)
    q = np.zeros((_SAMPLES, model.dof))
    q[:, [other.number for other in model.robot.moving].index(joint.number)] = positions
    sets = _sets(model, instance)
    results = {name: evaluate(function, {"q": q, "parameters": values}) for name, values in sets.items()}
    degrees = joint.sigma != PRISMATIC
    shown = [float(mathematics.degrees(p)) if degrees else float(p) for p in positions]
    across = f"q{joint.number} [{'deg' if degrees else 'm'}]"
    first = next(iter(results.values()))
    markers = [Marker(at, "dead centre") for at in _turning_points(shown, first[outputs[0].signal.name])]
    plots = []
    for output in outputs:
        name, symbol = output.signal.name, output.signal.units[0]
        curves = [Curve(label, [float(v) for v in result[name]]) for label, result in results.items()]
        if all(np.array_equal(curve.values, curves[0].values) for curve in curves):
            curves = [Curve(name, curves[0].values)]
        picture = plot(f"{name} of the balancer", across, f"{name} [{unit(symbol)}]", shown, curves, markers)
        caption = f"{output.signal.meaning[:1].upper()}{output.signal.meaning[1:]}."
        plots.append(element("figure", picture, element("figcaption", caption)))
    keys = [[element("i", class_=f"key line curve-{k % 6}"), f" {label} "] for k, label in enumerate(sets)]
    return join(
        element("p", f"The {instance.effect.title} on joint {joint.number}, over its range; ", _valued(sets, instance)),
        element("div", plots, class_="plots"),
        element("p", keys, class_="legend"),
    )


def _range(joint: Joint) -> tuple[float, float]:
    return (
        -mathematics.pi if joint.lower is None else float(joint.lower),
        mathematics.pi if joint.upper is None else float(joint.upper),
    )


def _sets(model: Model, instance: Instance) -> dict[str, np.ndarray[tuple[int], np.dtype[np.float64]]]:
    """Parameter vectors of the sets that value the balancer; with none, its parameters at one."""
    index = {parameter.name: k for k, parameter in enumerate(model.parameters)}
    found = {}
    for name, parameter_set in model.robot.parameter_sets.items():
        if all(needed in parameter_set.values for needed in instance.names):
            found[name] = model.default_parameters()
            for needed in instance.names:
                found[name][index[needed]] = parameter_set.values[needed].value
    if not found:
        found["unit parameters"] = model.default_parameters()
        for needed in instance.names:
            found["unit parameters"][index[needed]] = 1.0
    return found


def _valued(sets: dict[str, np.ndarray[tuple[int], np.dtype[np.float64]]], instance: Instance) -> str:
    names = " and ".join(instance.names)
    return (
        f"{names} set to 1 in the absence of values."
        if "unit parameters" in sets
        else f"{names} from the parameter sets."
    )


def _turning_points(x: Sequence[float], length: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
    """Where the length turns, by a parabola through three samples: there the lever arm is nothing."""
    found = []
    for k in range(1, len(x) - 1):
        before, here, after = float(length[k - 1]), float(length[k]), float(length[k + 1])
        if (here - before) * (after - here) < 0:
            found.append(x[k] + (x[k + 1] - x[k]) * 0.5 * (before - after) / (before - 2 * here + after))
    return found
