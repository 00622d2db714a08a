"""What an identification leaves behind: results.json and a robot file with the identified parameters in it."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from generator.robot.description import ParameterSet, ParameterValue
from generator.version import VERSION
from generator.writing import replace
from identification import outcome
from identification.consistent_fit import ConsistentFit
from identification.inverse_model import Estimate, Identification
from identification.robot_file import with_parameter_set
from identification.sensitivity import Variation
from identification.set_values import consistent_values, identified_values
from identification.sidecar import UNITS

#: Names of the files, and of the parameter sets in the robot file.
RESULTS = "results.json"
FULL, ESSENTIAL, CONSISTENT = "identified", "identified_essential", "identified_consistent"

#: Infinity as a JSON number: readers make it infinite again, in Python and in a browser.
_INFINITE = "1e999"
_MARK = "\0infinite"


def document(
    found: Identification, consistent: ConsistentFit | None = None, variations: Sequence[Variation] = ()
) -> dict[str, Any]:
    """The content of results.json, see docs/identification.md.

    Angles in rad, torques in N m. Where the data do not show a parameter its std is infinite and its value None.
    """
    solution = found.full.solution
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "method": _method(found),
        "data": {
            kind: [outcome.run(one.sampled.run, one.sampled.filters) for one in runs]
            for kind, runs in (("train", found.train), ("test", found.test))
        },
        "condition": solution.condition,
        "condition_scaled": solution.scaled_condition,
        "rank": solution.rank,
        "parameters": _parameters(found, found.full),
        "residual": _residual(found, found.full),
        "essential": {
            "ratio": found.options.ratio,
            "growth": found.options.growth,
            "condition": found.essential.solution.condition,
            "parameters": _parameters(found, found.essential),
            "residual": _residual(found, found.essential),
        },
        "consistent": None if consistent is None else _consistent(found, consistent),
        "payloads": _payload_values(found),
        "sensitivity": [asdict(one) for one in variations],
        "notes": list(found.notes),
    }


def written(text: Mapping[str, Any]) -> str:
    """The JSON text of a document; infinite numbers are written as ``1e999``, which JSON allows."""
    return json.dumps(_marked(text), indent=1, ensure_ascii=False).replace(json.dumps(_MARK), _INFINITE) + "\n"


def save(
    found: Identification,
    robot_file: Path,
    folder: Path,
    consistent: ConsistentFit | None = None,
    variations: Sequence[Variation] = (),
    beside: Mapping[str, bytes] | None = None,
) -> list[str]:
    """Writes results.json, ROBOT.yaml and the files ``beside`` into ``folder``; returns their names.

    Raises InputError where the folder cannot be written.
    """
    text = robot_file.read_text(encoding="utf-8-sig")
    for one in parameter_sets(found, consistent):
        text = with_parameter_set(text, one)
    files = {
        RESULTS: written(document(found, consistent, variations)).encode(),
        f"{found.robot.name}.yaml": text.encode(),
        **(beside or {}),
    }
    replace(folder, files)
    return sorted(files)


def parameter_sets(found: Identification, consistent: ConsistentFit | None = None) -> tuple[ParameterSet, ...]:
    """What was identified as a robot file holds it: all base parameters, essential ones, consistent standard ones."""
    runs = ", ".join(Path(one.sampled.run.name).name for one in found.train)
    source = f"identified with the inverse dynamic model and least squares from {runs}"
    units = found.units
    given = found.options.fixed
    sets = [
        ParameterSet(
            FULL, "all base parameters that the data show, alone or in sums", source, _set(found.full, units, given)
        ),
        ParameterSet(ESSENTIAL, "essential parameters alone", source, _set(found.essential, units, given)),
    ]
    if consistent is not None:
        standard = {parameter.name: parameter.unit for parameter in found.regressors.model.standard_parameters}
        values = consistent_values(standard, consistent.standard, consistent.open.unknown)
        sets.append(ParameterSet(CONSISTENT, "standard parameters of bodies that can be", source, values))
    return tuple(sets)


def older_sets(found: Identification, consistent: ConsistentFit | None = None) -> list[str]:
    """A note on a set that the robot file has of another identification and keeps: it may have been the prior."""
    if consistent is not None or CONSISTENT not in found.robot.parameter_sets:
        return []
    return [f"the set {CONSISTENT} in the robot file is of an earlier identification"]


def _set(estimate: Estimate, units: Mapping[str, str], given: Mapping[str, float]) -> dict[str, ParameterValue]:
    """Values of the estimated parameters of the robot and of those that were ``given``."""
    solution = estimate.solution
    told = {name: unit for name, unit in units.items() if name in given or name in estimate.sought}
    return identified_values(told, solution.values, solution.std, given)


def _method(found: Identification) -> dict[str, Any]:
    recipe, options = found.recipe, found.options
    return {
        "name": "IDIM-LS",
        "least_squares": "weighted by joint" if found.problem.weighted else "ordinary",
        "robust": options.robust,
        "residual_variance": "rows minus one" if found.problem.by_samples else "rows minus parameters",
        "std": _std_of(options.draws),
        "standstill": recipe.standstills(found.robot).tolist(),
        "fixed": {name: found.problem.fixed[name] for name in sorted(options.fixed)},
    }


def _std_of(draws: int) -> str:
    if draws:
        return f"block bootstrap of {draws} draws; of the essential model that of independent residuals"
    return "of independent residuals (report eq. 42-45); optimistic where residuals are coloured"


def _parameters(found: Identification, estimate: Estimate) -> dict[str, Any]:
    solution = estimate.solution
    units = found.units
    return {
        name: {
            "value": None if name in solution.hidden else solution.values[name],
            "std": solution.std(name),
            "relative_std_percent": solution.relative_std(name),
            "essential": name in found.essential_names,
            "fixed": name in found.options.fixed,
            "identifiable": name not in solution.hidden,
            "unit": unit,
        }
        for name, unit in units.items()
        if name in solution.values and (estimate is found.full or name in estimate.sought)
    }


def _payload_values(found: Identification) -> dict[str, Any]:
    """The payloads' parameters by name."""
    solution = found.full.solution
    result: dict[str, Any] = {}
    for one in found.train:
        payload = one.sampled.run.payload
        if payload is None:
            continue
        result[payload.name] = {}
        for stem, name in payload.names().items():
            given = stem in payload.known or name in found.options.fixed
            # What is not estimated, and not given, is part of the last body's parameters.
            told = given or (name in found.full.sought and name not in solution.hidden)
            result[payload.name][name] = {
                "value": solution.values[name] if told else None,
                "std": solution.std(name) if told else math.inf,
                "relative_std_percent": solution.relative_std(name) if told else math.inf,
                "known": stem in payload.known,
                "unit": UNITS[stem],
            }
    return result


def _residual(found: Identification, estimate: Estimate) -> dict[str, Any]:
    numbers = found.robot.numbers
    return {
        "train": outcome.norms_by_number(estimate.train, numbers),
        "test": None if estimate.test is None else outcome.norms_by_number(estimate.test, numbers),
    }


def _consistent(found: Identification, fit: ConsistentFit) -> dict[str, Any]:
    model = found.regressors.model
    numbers = found.robot.numbers
    unknown = fit.open.unknown
    hidden = {name for name, terms in model.grouping.numeric().items() if terms and unknown.issuperset(terms)}
    standard, base = (
        {p.name: {"value": None if p.name in out else of[p.name], "unit": p.unit} for p in parameters}
        for parameters, of, out in (
            (model.standard_parameters, fit.standard, unknown),
            (model.base_parameters, fit.base, hidden),
        )
    )
    return {
        "weight": fit.weight,
        "prior": fit.prior,
        "parameters": standard,
        "base_parameters": base,
        "residual": {
            "train": outcome.norms_by_number(fit.train, numbers),
            "test": None if fit.test is None else outcome.norms_by_number(fit.test, numbers),
        },
    }


def _marked(value: Any) -> Any:
    """Infinite numbers replaced by a text that no name contains; of what is no number JSON says nothing."""
    if isinstance(value, Mapping):
        return {key: _marked(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_marked(one) for one in value]
    if isinstance(value, float) and value == math.inf:
        return _MARK
    return None if isinstance(value, float) and not math.isfinite(value) else value
