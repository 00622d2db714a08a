"""What the estimates owe to the filters: the identification repeated with other cut-offs and decimations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from generator.errors import InputError
from identification.inverse_model import Identification, identify
from identification.recipe import Recipe, possible_factor


@dataclass(frozen=True)
class Variation:
    """One change of a filter: what ``setting`` became ``value``, and the parameter that moved most.

    ``change`` is in standard deviations of the estimate with the recipe's own filters.
    """

    setting: str
    value: float
    parameter: str
    change: float


def sensitivity(found: Identification, data: Sequence[str | Path]) -> tuple[list[Variation], list[str]]:
    """Half and twice the Butterworth's cut-off, half and twice the decimation's factor, on the first run's rate.

    Also why some of them could not be tried: runs may be too short for them.
    """
    filters = found.train[0].sampled.filters
    recipes: list[tuple[str, float, Recipe]] = []
    for part in (0.5, 2.0):
        cutoff = min(part * filters.cutoff, 0.45 * filters.rate)
        recipes.append(("cutoff", cutoff, found.recipe.changed(cutoff=cutoff, factor=filters.factor)))
    for part in (0.5, 2.0):
        factor = possible_factor(part * filters.factor)
        recipes.append(("factor", float(factor), found.recipe.changed(cutoff=filters.cutoff, factor=factor)))
    tried, notes = [], []
    for setting, value, recipe in recipes:
        if value == getattr(filters, setting):
            notes.append(f"{setting} {value:g} is at its limit: one that goes further could not be tried")
            continue
        try:
            tried += _variation(found, data, setting, value, recipe)
        except InputError as error:
            notes.append(f"{setting} {value:g} could not be tried: {error}")
    return tried, notes


def _variation(
    found: Identification, data: Sequence[str | Path], setting: str, value: float, recipe: Recipe
) -> list[Variation]:
    """None where no parameter is compared."""
    options = replace(found.options, recipe=recipe, draws=0)
    other = identify(found.robot, data, options=options, regressors=found.regressors).full.solution
    own = found.full.solution
    changes = {
        name: abs(other.values[name] - own.values[name]) / own.std(name)
        for name in found.full.sought
        if name not in own.hidden and name not in other.hidden and own.std(name) > 0
    }
    most = max(changes, key=changes.__getitem__, default=None)
    return [] if most is None else [Variation(setting, value, most, changes[most])]
