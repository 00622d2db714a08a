"""What every identification writes about its runs, its parameters and what they leave unexplained."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from generator.robot.description import ParameterValue
from identification.dataset import Run
from identification.recipes import Filters
from identification.residuals import Residual, Residuals

#: Relative standard deviation from which a gain, a torque constant or a stiffness is refused.
LIMIT = 0.1
#: Why a parameter has no value that shows only together with others, or not at all.
HIDDEN = "no motion in the data shows it alone"


@dataclass(frozen=True)
class Value:
    """A parameter [``unit``] with its standard deviation; None and infinite where the data do not show it.

    ``essential`` tells whether the essential model keeps it, ``refused`` why it has no value, ``given`` whether it was
    given instead of estimated.
    """

    value: float | None
    std: float
    unit: str
    essential: bool = True
    refused: str = ""
    given: bool = False

    @classmethod
    def unknown(cls, unit: str, why: str) -> Value:
        """One that the data do not show, and ``why``."""
        return cls(None, math.inf, unit, refused=why)

    @property
    def relative_std(self) -> float:
        """In % of the value; infinite without one, zero of one that was given."""
        if self.given:
            return 0.0
        if self.value is None or not math.isfinite(self.std):
            return math.inf
        return 100 * self.std / abs(self.value) if self.value else math.inf


def parameters(values: Mapping[str, Value]) -> dict[str, Any]:
    """The key ``parameters`` of results.json."""
    return {
        name: {
            "value": one.value,
            "std": one.std,
            "relative_std_percent": one.relative_std,
            "essential": one.essential and one.value is not None and not one.given,
            "fixed": one.given,
            "identifiable": one.value is not None,
            "unit": one.unit,
            **({"refused": one.refused} if one.refused else {}),
        }
        for name, one in values.items()
    }


def run(one: Run, filters: Filters) -> dict[str, Any]:
    """A run under the key ``data``."""
    return {
        "file": one.name,
        "sha256": one.sha256,
        "samples": one.samples,
        "rate": one.rate,
        "cutoff": filters.cutoff,
        "order": filters.order,
        "factor": filters.factor,
        "dropped": [filters.first, filters.last],
        "payload": None if one.payload is None else one.payload.name,
    }


def norms(per_joint: Mapping[int, Residual], total: Residual) -> dict[str, Any]:
    """Residuals by the joint's number and in total."""
    each = [{"joint": number, **_norm(one)} for number, one in sorted(per_joint.items())]
    return {"per_joint": each, "total": _norm(total)}


def norms_by_number(of: Residuals, numbers: Sequence[int]) -> dict[str, Any]:
    """``norms`` of residuals by coordinate, whose joints have ``numbers``."""
    return norms({numbers[k]: one for k, one in of.per_joint.items()}, of.total)


def values_of_set(values: Mapping[str, Value]) -> dict[str, ParameterValue]:
    """As a parameter set of a robot file holds them, without those that are not known."""
    return {
        name: ParameterValue(one.value, one.unit, one.relative_std if math.isfinite(one.relative_std) else None)
        for name, one in values.items()
        if one.value is not None
    }


def table(values: Mapping[str, Value]) -> list[str]:
    """Lines for the terminal."""
    width = max(map(len, [*values, "parameter"]))
    lines = [f"{'parameter'.ljust(width)} {'value':>12} {'std':>10} {'std %':>9}  unit"]
    for name, one in values.items():
        shown = "unknown" if one.value is None else f"{one.value:.6g}"
        given = "  given" if one.given else ""
        lines.append(f"{name.ljust(width)} {shown:>12} {one.std:>10.4g} {one.relative_std:>9.4g}  {one.unit}{given}")
    return lines


def _norm(one: Residual) -> dict[str, Any]:
    return {
        "rows": one.rows,
        "norm": one.norm,
        "relative_percent": one.relative if one.rows else None,
        "relative_to_mean_percent": one.relative_to_mean if one.rows else None,
    }
