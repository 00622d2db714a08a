"""What an identification of drive gains leaves behind: results.json and a robot file with the gains in it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from generator.robot.description import ParameterSet
from generator.version import VERSION
from generator.writing import replace
from identification import outcome
from identification.drive_gains import DriveGains
from identification.outcome import Value
from identification.results import RESULTS, written
from identification.robot_file import with_parameter_set
from identification.sidecar import UNITS

#: Name of the parameter set in the robot file.
SET = "identified_with_gains"


def gains(found: DriveGains) -> dict[str, Value]:
    """g_tau and kt of every motor, by name."""
    result: dict[str, Value] = {}
    joints = list(enumerate(found.robot.moving))
    for m, joint in joints:
        result[f"g_tau{joint.number}"] = _told(found, m, found.gain, joint.gain_unit)
    for m, joint in joints:
        result[f"kt{joint.number}"] = _told(found, m, found.constants.__getitem__, "N m/A")
    return result


def _told(found: DriveGains, motor: int, of: Callable[[int], tuple[float, float]], unit: str) -> Value:
    """A gain with its standard deviation, or why the motor has none."""
    if motor in found.refused:
        return Value.unknown(unit, found.refused[motor])
    return Value(*of(motor), unit)


def parameters(found: DriveGains) -> dict[str, Value]:
    """The robot's and the payloads' parameters, by name."""
    units = {one.name: one.unit for one in found.regressors.model.base_parameters}
    for run in found.loaded:
        if run.run.payload is not None:
            units |= {name: UNITS[stem] for stem, name in run.run.payload.names().items()}
    return {
        name: Value(value, std, units[name]) if math.isfinite(std) else Value.unknown(units[name], outcome.HIDDEN)
        for name, (value, std) in found.parameters.items()
    }


def document(found: DriveGains) -> dict[str, Any]:
    """The content of results.json, see docs/identification.md."""
    numbers = found.robot.numbers
    per_joint = {numbers[m]: one for m, one in found.residuals.per_joint.items()}
    payloads = {one.run.payload.name: one.run.payload for one in found.loaded if one.run.payload is not None}
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "method": {
            "name": "drive gains by total least squares",
            "columns": "the model's of unit length, free of noise; the currents' in units of their noise",
            "std": "first-order perturbation; residuals coloured as found, motor by motor; the payload's std added",
            "refused_above_relative_std_percent": 100 * outcome.LIMIT,
        },
        "data": {
            kind: [outcome.run(one.run, one.filters) for one in runs]
            for kind, runs in (("empty", found.empty), ("loaded", found.loaded))
        },
        "condition": found.condition,
        "separation": found.separation,
        "gains_by_payload_percent": {f"kt{numbers[m]}": 100 * share for m, share in found.payload_share.items()},
        "parameters": outcome.parameters({**gains(found), **parameters(found)}),
        "payloads": {
            name: {
                payload.names()[stem]: {"value": value, "std": found.payload_std.get(stem, 0.0), "unit": UNITS[stem]}
                for stem, value in payload.known.items()
            }
            for name, payload in payloads.items()
        },
        "residual": {"train": outcome.norms(per_joint, found.residuals.total), "test": None, "side": "motor"},
        "notes": list(found.notes) + refusals(found),
    }


def refusals(found: DriveGains) -> list[str]:
    """One line for each gain that cannot be told."""
    numbers = found.robot.numbers
    return [f"g_tau{numbers[m]} is not observable: {why}" for m, why in sorted(found.refused.items())]


def save(found: DriveGains, robot_file: Path, folder: Path, beside: Mapping[str, bytes] | None = None) -> list[str]:
    """Writes results.json, ROBOT.yaml and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    text = with_parameter_set(robot_file.read_text(encoding="utf-8-sig"), _set(found))
    files = {RESULTS: written(document(found)).encode(), f"{found.robot.name}.yaml": text.encode(), **(beside or {})}
    replace(folder, files)
    return sorted(files)


def _set(found: DriveGains) -> ParameterSet:
    runs = ", ".join(Path(one.run.name).name for one in (*found.empty, *found.loaded))
    own = {one.name for one in found.regressors.model.base_parameters}
    base = {name: one for name, one in parameters(found).items() if name in own}
    others = gains(found) | {name: one for name, one in parameters(found).items() if name not in own}
    source = f"identified with a known payload and total least squares from {runs}"
    description = "parameters with drive gains, those of the payload beside"
    return ParameterSet(SET, description, source, outcome.values_of_set(base), outcome.values_of_set(others))
