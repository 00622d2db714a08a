"""What the balancers do over the range of their joints: length, force and torque as curves."""

from __future__ import annotations

import math as mathematics
from collections.abc import Sequence
from itertools import islice

import numpy as np

from generator.effects.library import Instance
from generator.quantities.balancer import observed
from generator.review.laws import observables
from generator.review.markup import Markup, element, join
from generator.review.plot import Curve, Marker, plot
from generator.robot.description import PRISMATIC
from generator.symbolic.function import Function, Output
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model
from generator.words import listed, unit

TITLE = "Balancer"
ORDER = 90

_SAMPLES = 241

Vector = np.ndarray[tuple[int], np.dtype[np.float64]]


def render(model: Model) -> Markup | None:
    function = model.functions.get("balancer")
    shown = observed(model)
    if function is None or not shown:
        return None
    outputs = iter(function.outputs)
    return join([_balancer(model, function, one, list(islice(outputs, len(observables(one))))) for one in shown])


def _balancer(model: Model, function: Function, instance: Instance, outputs: Sequence[Output]) -> Markup:
    joint = instance.joint
    lower, upper = joint.limits or (-mathematics.pi, mathematics.pi)
    positions = np.linspace(lower, upper, _SAMPLES)
    q = np.zeros((_SAMPLES, model.dof))
    q[:, [other.number for other in model.robot.moving].index(joint.number)] = positions
    sets = _sets(model, instance)
    with np.errstate(all="ignore"):  # a gas chamber may end within the range
        results = {name: evaluate(function, {"q": q, "parameters": values}) for name, values in sets.items()}
    degrees = joint.sigma != PRISMATIC
    shown = [float(mathematics.degrees(p)) if degrees else float(p) for p in positions]
    across = f"q{joint.number} [{'deg' if degrees else 'm'}]"
    first = next(iter(results.values()))
    lengths = [first[output.signal.name] for output in outputs if output.signal.name.startswith("length")]
    markers = [Marker(at, "dead centre") for length in lengths for at in _turning_points(shown, length)]
    plots = []
    for output in outputs:
        name, symbol = output.signal.name, output.signal.units[0]
        curves = [Curve(label, [float(v) for v in result[name]]) for label, result in results.items()]
        if all(np.array_equal(curve.values, curves[0].values, equal_nan=True) for curve in curves):
            curves = [Curve(name, curves[0].values)]
        picture = plot(f"{name} of the balancer", across, f"{name} [{unit(symbol)}]", shown, curves, markers)
        caption = f"{output.signal.meaning[:1].upper()}{output.signal.meaning[1:]}."
        plots.append(element("figure", picture, element("figcaption", caption)))
    keys = [[element("i", class_=f"key line curve-{k % 6}"), f" {label} "] for k, label in enumerate(sets)]
    return join(
        element("p", f"The {instance.effect.title} on joint {joint.number}, over its range."),
        element("div", plots, class_="plots"),
        element("p", keys, class_="legend"),
    )


def _sets(model: Model, instance: Instance) -> dict[str, Vector]:
    """Parameter vectors by the names of the sets that value the balancer alike; with none, its parameters at one.

    A model with its parameters built in has one empty vector.
    """
    if model.constants:
        return {"built in": model.default_parameters()}
    alike: dict[tuple[float, ...], list[str]] = {}
    for name, parameter_set in model.robot.parameter_sets.items():
        if all(needed in parameter_set.values for needed in instance.names):
            alike.setdefault(tuple(parameter_set.values[needed].value for needed in instance.names), []).append(name)
    if not alike:
        alike[(1.0,) * len(instance.names)] = [f"{listed(instance.names)} = 1"]
    index = {parameter.name: k for k, parameter in enumerate(model.parameters)}
    vectors = {}
    for values, names in alike.items():
        vector = model.default_parameters()
        vector[[index[needed] for needed in instance.names]] = values
        vectors[listed(names)] = vector
    return vectors


def _turning_points(x: Sequence[float], length: Vector) -> list[float]:
    """Where the length turns, by a parabola through three samples: there the lever arm is nothing."""
    found = []
    for k in range(1, len(x) - 1):
        before, here, after = float(length[k - 1]), float(length[k]), float(length[k + 1])
        if (here - before) * (after - here) < 0:
            found.append(x[k] + (x[k + 1] - x[k]) * 0.5 * (before - after) / (before - 2 * here + after))
    return found
