"""What output error leaves behind: results.json and a robot file with the values in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from generator.robot.description import ParameterSet
from generator.version import VERSION
from generator.writing import replace
from identification import outcome
from identification.outcome import Value
from identification.output_error.methods import methods
from identification.output_error.multi_start import OutputError
from identification.results import RESULTS, written
from identification.robot_file import with_parameter_set
from identification.set_values import identified_values

#: Name of the parameter set in the robot file.
SET = "identified_output_error"


def parameters(found: OutputError) -> dict[str, Value]:
    """The sought parameters by name, and those that were given, in the model's order."""
    best = found.best
    return {
        one.name: Value(
            None if one.name in best.hidden else best.values[one.name],
            best.std(one.name),
            one.unit,
            given=one.name in found.settings.fixed,
        )
        for one in found.first.regressors.model.base_parameters
    }


def document(found: OutputError) -> dict[str, Any]:
    """The content of results.json, see docs/output_error.md."""
    best, settings = found.best, found.settings
    numbers = found.robot.numbers
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "method": {
            "name": "output error",
            "minimisation": methods()[settings.method].SUMMARY,
            "segment": settings.segment,
            "weights": settings.recipe.weights,
            "std": "torque noise through the sensitivities, its correlation as found",
            "iterations": best.iterations,
            "simulations": best.simulations,
            "settled": best.settled,
            "seed": settings.seed,
            "spread": settings.spread,
        },
        "data": {
            kind: [outcome.run(one.run, one.filters) for one in runs]
            for kind, runs in (("train", found.train), ("test", found.test))
        },
        "condition": best.condition,
        "parameters": outcome.parameters(parameters(found)),
        "residual": {
            "train": outcome.norms_by_number(best.train, numbers),
            "test": None if best.test is None else outcome.norms_by_number(best.test, numbers),
        },
        "starts": {"chosen": found.chosen, "scores": dict(found.scores)},
        "inertia": {
            "smallest": float(best.eigenvalues.min()),
            "margin": best.margin,
            "limited": best.limited,
            "eigenvalues": np.round(best.eigenvalues, 6).tolist(),
            "q": np.round(best.poses, 6).tolist(),
        },
        "notes": list(found.notes),
    }


def save(found: OutputError, robot_file: Path, folder: Path, beside: Mapping[str, bytes] | None = None) -> list[str]:
    """Writes results.json, ROBOT.yaml and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    runs = ", ".join(Path(one.run.name).name for one in found.train)
    best, units = found.best, {one.name: one.unit for one in found.first.regressors.model.base_parameters}
    values = identified_values(units, best.values, best.std, found.settings.fixed)
    one = ParameterSet(SET, "base parameters by output error in open loop", f"output error from {runs}", values)
    text = with_parameter_set(robot_file.read_text(encoding="utf-8-sig"), one)
    files = {RESULTS: written(document(found)).encode(), f"{found.robot.name}.yaml": text.encode(), **(beside or {})}
    replace(folder, files)
    return sorted(files)


def summary(found: OutputError) -> list[str]:
    """Lines for the terminal."""
    best = found.best
    lines = [f"note: {note}" for note in found.notes]
    lines += outcome.table(parameters(found))
    finite = [score for score in found.scores.values() if math.isfinite(score)]
    if len(found.scores) > 1:
        same = sum(score - min(finite) <= 1e-3 * max(1.0, abs(min(finite))) for score in finite)
        lines.append(f"starts           {len(found.scores)}, {same} of them end at the best minimum")
    lines.append(f"segments         {best.segments}, {best.simulations} simulations, {best.iterations} iterations")
    lines.append(f"smallest eigenvalue of M(q) {best.eigenvalues.min():.4g}, at least {best.margin:.4g}")
    for kind, of in (("train", best.train), ("test", best.test)):
        if of is not None:
            each, total = of.by_joint(".2g"), of.total
            lines.append(
                f"positions, {kind}: ||e|| {total.norm:.4g}, ||e||/||q|| {total.relative:.3g} %, "
                f"||e||/||q - mean|| {total.relative_to_mean:.3g} % ({each})"
            )
    return lines
