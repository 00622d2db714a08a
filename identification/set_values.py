"""Identified values as a parameter set holds them, also where no run shows a parameter by itself.

Where runs show two parameters only as a sum, neither has a value of its own, but a set without both would not make the
torques that it was identified from. So the set has values that serve the sum, with standard deviations that tell
nothing; a parameter that shows in no sum has no place in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping

from generator.robot.description import ParameterValue

#: Relative standard deviation [%] of a value that the runs do not show by itself.
_UNKNOWN = 1e5
#: Note on a value that was not identified.
_GIVEN = "given, not identified"


def told(one: ParameterValue) -> bool:
    """Whether a value of a set is one by itself, and does not only serve a sum."""
    return one.relative_std is None or one.relative_std < _UNKNOWN


def _identified(value: float, std: float, unit: str) -> ParameterValue | None:
    """A value [``unit``] with its standard deviation, infinite where it is hidden; None where it shows in no sum."""
    if not value:
        return None if math.isinf(std) else ParameterValue(value, unit)
    return ParameterValue(value, unit, min(100 * std / abs(value), _UNKNOWN))


def identified_values(
    units: Mapping[str, str], values: Mapping[str, float], std: Callable[[str], float], given: Mapping[str, float]
) -> dict[str, ParameterValue]:
    """Values and standard deviations of parameters as a set holds them, by the ``units`` of those that may be in it."""
    written = {
        name: ParameterValue(given[name], unit, note=_GIVEN)
        if name in given
        else _identified(values[name], std(name), unit)
        for name, unit in units.items()
    }
    return {name: one for name, one in written.items() if one is not None}


def consistent_values(
    units: Mapping[str, str], values: Mapping[str, float], unknown: Collection[str]
) -> dict[str, ParameterValue]:
    """Values of consistent parameters as a set holds them, by the ``units`` of all; the data do not show those that are
    ``unknown`` by themselves.
    """
    written = {
        name: _identified(values[name], math.inf, unit) if name in unknown else ParameterValue(values[name], unit)
        for name, unit in units.items()
    }
    return {name: one for name, one in written.items() if one is not None}


def shown_together(hidden: Iterable[str], values: Mapping[str, float]) -> list[str]:
    """The note on ``hidden`` parameters of which a set has values; none where it has none."""
    together = [name for name in hidden if values[name]]
    if not together:
        return []
    return [
        f"the runs do not show {' '.join(together)} one by one: values in the set serve the torques of such motion "
        "together, and no other"
    ]
