"""``manifest.json``: what a generation holds, for programs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib.metadata import version
from typing import Any

from generator.review.groupings import symbolic
from generator.review.plain import plain
from generator.robot.parameters import Parameter
from generator.symbolic.function import Function, Signal
from generator.symbolic.model import Model
from generator.version import VERSION

#: Changes with the meaning or the form of the manifest, not with the generator.
FORMAT = 1


def manifest(model: Model, files: Sequence[str]) -> dict[str, Any]:
    """The manifest of a model with its functions; ``files`` are the generated files' paths.

    Lists are in the order of the generated code where it has one, else sorted. Nothing in it depends on when or where
    the files were made.
    """
    robot = model.robot
    return {
        "format": FORMAT,
        "generator": f"counterpoise {VERSION}",
        "versions": {"counterpoise": VERSION, **{name: version(name) for name in ("casadi", "sympy")}},
        "robot": {"name": robot.name, "description": robot.description, "source": robot.source, "sha256": robot.digest},
        "joints": [{"joint": joint.number, "sigma": joint.sigma} for joint in robot.moving],
        "effects": _effects(model),
        "effect_states": [state.name for state in model.effect_states],
        "flexible": list(robot.flexible),
        "signals": {name: [float(value) for value in values] for name, values in vars(robot.signals).items() if values},
        "base_parameters": [parameter.name for parameter in model.base_parameters],
        "parameters": _parameters(model.parameters),
        "built_in": {name: float(value) for name, value in model.constants.items()},
        "standard_parameters": _parameters(model.standard_parameters),
        "parameter_sets": sorted(robot.parameter_sets),
        "groupings": model.grouping.numeric(),
        "groupings_symbolic": {
            base.name: base.head if base.alone else plain(symbolic(base).right) for base in model.grouping.base
        },
        "functions": {name: _function(function) for name, function in sorted(model.functions.items())},
        "files": sorted(files),
    }


def _effects(model: Model) -> list[dict[str, Any]]:
    """The effects in the order of the robot's library, each with its joints and their parameters."""
    found: dict[str, dict[str, Any]] = {}
    for instance in model.effects:
        entry = found.setdefault(
            instance.effect.id,
            {"effect": instance.effect.id, "title": instance.effect.title, "joints": [], "parameters": []},
        )
        entry["joints"].append(instance.joint.number)
        entry["parameters"] += instance.names
    return list(found.values())


def _parameters(parameters: Iterable[Parameter]) -> list[dict[str, Any]]:
    return [{"name": p.name, "unit": p.unit, "joint": p.joint, "meaning": p.meaning} for p in parameters]


def _function(function: Function) -> dict[str, Any]:
    return {
        "summary": function.summary,
        "inputs": [_signal(signal) for signal in function.inputs],
        "outputs": [_signal(output.signal) for output in function.outputs],
        "uses_parameters": function.uses_parameters,
        "operations": function.count.as_dict(),
        "prepare_operations": function.prepare_count.as_dict(),
    }


def _signal(signal: Signal) -> dict[str, Any]:
    return {
        "name": signal.name,
        "shape": list(signal.shape),
        "units": list(signal.units),
        "meaning": signal.meaning,
    }
