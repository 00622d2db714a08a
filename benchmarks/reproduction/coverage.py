"""How often the true value lies within two standard deviations, over many draws of the noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from benchmarks.reproduction.experiment import Estimate, Found


def coverage(founds: Sequence[Found]) -> dict[str, Any]:
    """By model: ``inside`` of ``count`` estimates, and the same of each parameter, with the mean of its deviations
    (``bias``) and their standard deviation (``spread``), in stated standard deviations.
    """
    return {model: _of_model([one.models[model] for one in founds]) for model in founds[0].models}


def share(counted: Mapping[str, Any]) -> float:
    """The part inside [%]."""
    return 100 * float(counted["inside"]) / float(counted["count"])


def worst(counted: Mapping[str, Any]) -> str:
    """The parameter that is least often inside, among those that most draws show."""
    parameters: Mapping[str, Any] = counted["parameters"]
    most = max(one["count"] for one in parameters.values())
    return min((name for name, one in parameters.items() if one["count"] == most), key=lambda n: share(parameters[n]))


def _of_model(draws: Sequence[Sequence[Estimate]]) -> dict[str, Any]:
    by_name: dict[str, list[Estimate]] = {}
    for estimates in draws:
        for one in estimates:
            by_name.setdefault(one.name, []).append(one)
    parameters = {name: _counted(estimates) for name, estimates in by_name.items()}
    total = {key: sum(one[key] for one in parameters.values()) for key in ("inside", "count")}
    return {**total, "parameters": parameters}


def _counted(estimates: Sequence[Estimate]) -> dict[str, Any]:
    deviations = np.array([one.deviations for one in estimates])
    return {
        "inside": sum(one.inside for one in estimates),
        "count": len(estimates),
        "bias": round(float(deviations.mean()), 3),
        "spread": round(float(deviations.std()), 3),
    }
