"""What an identification of stiffness leaves behind: results.json and a robot file with the values in it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from math import inf
from pathlib import Path
from typing import Any

from generator.robot.description import ParameterSet, Robot
from generator.version import VERSION
from generator.writing import replace
from identification import outcome
from identification.force_steps import ForceSteps
from identification.link_encoders import LinkEncoders
from identification.locked_output import LockedOutput
from identification.outcome import Value
from identification.residuals import Residuals
from identification.results import RESULTS, written
from identification.robot_file import with_parameter_set

#: Stiffness by one of the methods; ``values`` of each are all that it found, by name.
Found = LockedOutput | ForceSteps | LinkEncoders

#: Name of the parameter set in the robot file.
SET = "identified_stiffness"
_STD = "of coloured residuals, their correlation as found"


def document(found: Found) -> dict[str, Any]:
    """The content of results.json, see docs/identification.md."""
    match found:
        case LockedOutput():
            return _of_locked(found)
        case ForceSteps():
            return _of_steps(found)
        case LinkEncoders():
            return _of_link_encoders(found)


def _of_locked(found: LockedOutput) -> dict[str, Any]:
    number = found.joint.number
    values = {name: dataclasses.replace(one, essential=name in found.essential) for name, one in found.values.items()}
    norms = {
        "train": outcome.norms({number: found.residual}, Residuals({0: found.residual}).total),
        "test": None,
    }
    kept = {"train": outcome.norms({number: found.essential_residual}, found.essential_residual), "test": None}
    return {
        **_head(found.robot),
        "method": {
            "name": "stiffness by locked output",
            "std": _STD,
            "balancer_torque": list(found.removed),
            "refused_above_relative_std_percent": 100 * outcome.LIMIT,
        },
        "data": {"train": [outcome.run(run, filters) for run, filters in found.runs]},
        "condition": found.condition,
        "parameters": outcome.parameters(values),
        "residual": norms,
        "essential": {"parameters": outcome.parameters(found.essential), "residual": kept},
        "notes": [*found.notes, *refusals(values)],
    }


def _of_steps(found: ForceSteps) -> dict[str, Any]:
    numbers = found.robot.numbers
    each = [{numbers[k]: one for k, one in some.items()} for some in (found.residuals, found.motor_residuals)]
    joints, motors = (outcome.norms(one, Residuals(one).total) if one else None for one in each)
    return {
        **_head(found.robot),
        "method": {
            "name": "stiffness by force steps",
            "wrench": list(found.components),
            "std": _STD,
            "refused_above_relative_std_percent": 100 * outcome.LIMIT,
        },
        "data": {"train": [outcome.run(one.run, one.filters) for one in found.poses]},
        "condition": None,
        "parameters": outcome.parameters(found.values),
        "residual": {"train": joints, "test": None, "motors": motors},
        "notes": [*found.notes, *refusals(found.values)],
    }


def _of_link_encoders(found: LinkEncoders) -> dict[str, Any]:
    numbers = found.robot.numbers
    each = {numbers[k]: one for k, one in found.residuals.items()}
    return {
        **_head(found.robot),
        "method": {
            "name": "latency and stiffness by link-side encoders",
            "std": _STD,
            "refused_above_relative_std_percent": 100 * outcome.LIMIT,
        },
        "data": {"train": [outcome.run(run, filters) for run, filters in found.runs]},
        "condition": max((rows.condition for rows in found.rows.values() if len(rows.torque)), default=inf),
        "parameters": outcome.parameters(found.values),
        "taken_for_elasticity": outcome.parameters(found.mistaken),
        "residual": {"train": outcome.norms(each, Residuals(each).total), "test": None},
        "notes": [*found.notes, *mistakes(found), *refusals(found.values)],
    }


def mistakes(found: LinkEncoders) -> list[str]:
    """One line for each stiffness that the latency would have been taken for."""
    return [
        f"were latency elasticity, {name} would be {one.value:.4g} {one.unit}, relative std {one.relative_std:.3g} %"
        for name, one in found.mistaken.items()
        if one.value is not None
    ]


def refusals(values: Mapping[str, Value]) -> list[str]:
    """One line for each value that cannot be told."""
    return [f"{name} cannot be told: {one.refused}" for name, one in values.items() if one.refused]


def save(found: Found, robot_file: Path, folder: Path, beside: Mapping[str, bytes] | None = None) -> list[str]:
    """Writes results.json, ROBOT.yaml and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    results, robot = document(found), found.robot
    text = with_parameter_set(robot_file.read_text(encoding="utf-8-sig"), _set(found, results))
    files = {RESULTS: written(results).encode(), f"{robot.name}.yaml": text.encode(), **(beside or {})}
    replace(folder, files)
    return sorted(files)


def _set(found: Found, results: Mapping[str, Any]) -> ParameterSet:
    runs = ", ".join(Path(one["file"]).name for one in results["data"]["train"])
    source = f"{results['method']['name']} from {runs}"
    elastic = {f"k{number}" for number in found.robot.flexible}
    own = {name: one for name, one in found.values.items() if name in elastic}
    others = {name: one for name, one in found.values.items() if name not in elastic}
    kept, further = outcome.values_of_set(own), outcome.values_of_set(others)
    return ParameterSet(SET, "stiffness of the drive trains", source, kept, further)


def _head(robot: Robot) -> dict[str, Any]:
    return {"robot": robot.name, "robot_sha256": robot.digest, "version": VERSION}
