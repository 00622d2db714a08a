"""What a design leaves behind: a run file to be played, and excitation.json with what will be known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from generator.robot.description import Robot
from generator.version import VERSION
from generator.writing import replace
from identification.corrections import recorded_positions
from identification.excitation.design import Design
from identification.excitation.limits import Limits
from identification.excitation.noise import Noise
from identification.excitation.request import Request
from identification.least_squares import Solution
from identification.observation import Motion
from identification.recipes import Filters
from identification.results import written

#: Names of the files.
RUN, BESIDE, RESULTS = "trajectory.csv", "trajectory.yaml", "excitation.json"
#: Digits of a number of the run.
_DIGITS = 12


@dataclass(frozen=True)
class Excitation:
    """A designed ``motion`` as the ``request`` asks for it, and the deviations that are ``expected`` from it.

    ``units`` are those of the base parameters by name.
    """

    robot: Robot
    request: Request
    design: Design
    limits: Limits
    noise: Noise
    motion: Motion
    filters: Filters
    expected: Solution
    units: Mapping[str, str]

    @property
    def duration(self) -> float:
        """Of the run [s]."""
        return self.request.periods / self.design.series.frequency


def save(found: Excitation, folder: Path, beside: Mapping[str, bytes] | None = None) -> list[str]:
    """Writes the run, its sidecar, excitation.json and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    notes = "designed, not measured; qr and qd are wanted positions and speeds, at rest at both ends"
    if found.robot.signals.position_offset:
        notes += "; qr as the controller counts, without the position_offset of the robot file"
    sidecar = f"robot: {found.robot.name}\nnotes: {notes}\n"
    texts = {RUN: _run(found), BESIDE: sidecar, RESULTS: written(document(found))}
    files = {name: text.encode() for name, text in texts.items()} | dict(beside or {})
    replace(folder, files)
    return sorted(files)


def document(found: Excitation) -> dict[str, Any]:
    """The content of excitation.json, see docs/excite.md."""
    series, solution, request = found.design.series, found.expected, found.request
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "duration": found.duration,
        "rate": request.rate,
        "series": {
            "frequency": series.frequency,
            "centre": series.centre.tolist(),
            "sine": series.a.tolist(),
            "cosine": series.b.tolist(),
        },
        "search": {
            "criterion": request.criterion,
            "evaluations": request.evaluations,
            "seed": request.seed,
            "cost": found.design.cost,
            "cost_of_best_random_motion": found.design.first_cost,
        },
        "joints": _joints(found),
        "largest_load": found.design.load if found.limits.loads.size else None,
        "noise": {"sampled": found.noise.sampled.tolist(), "remaining": found.noise.remaining.tolist()},
        "filters": {
            "cutoff": found.filters.cutoff,
            "order": found.filters.order,
            "factor": found.filters.factor,
        },
        "expected": {
            name: {
                "value": solution.values[name],
                "std": solution.std(name),
                "relative_std_percent": solution.relative_std(name),
                "identifiable": name not in solution.hidden,
                "unit": unit,
            }
            for name, unit in found.units.items()
        },
        "parameters": request.parameters,
        "condition": solution.condition,
        "condition_scaled": solution.scaled_condition,
    }


def _joints(found: Excitation) -> list[dict[str, Any]]:
    """What each joint does, and what it may."""
    motion, limits = found.motion, found.limits
    return [
        {
            "joint": joint.number,
            "position": [float(motion.q[k].min()), float(motion.q[k].max())],
            "speed": float(np.abs(motion.qd[k]).max()),
            "acceleration": float(np.abs(motion.qdd[k]).max()),
            "position_limits": [float(limits.lower[k]), float(limits.upper[k])],
            "speed_limit": float(limits.speed[k]),
            "acceleration_limit": float(limits.acceleration[k]),
        }
        for k, joint in enumerate(found.robot.moving)
    ]


def _run(found: Excitation) -> str:
    numbers = found.robot.numbers
    names = ["t", *(f"{stem}{number}" for stem in ("qr", "qd") for number in numbers)]
    times = np.arange(found.motion.samples) / found.request.rate
    row = ",".join([f"%.{_DIGITS}g"] * len(names))
    counted = recorded_positions(found.motion.q, found.robot)
    values = np.column_stack([times, counted.T, found.motion.qd.T])
    return "\n".join([",".join(names), *(row % tuple(one) for one in values.tolist())]) + "\n"
