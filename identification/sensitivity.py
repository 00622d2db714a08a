"""What the estimates owe to the filters: the identification repeated with other cut-offs and decimations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path

from generator.errors import InputError
from identification.inverse_model import Identification, identify
from identification.recipes import Filters, Recipe, possible_factor

#: Parts of its own value that each setting is tried at.
_PARTS = (0.5, 2.0)


@dataclass(frozen=True)
class Variation:
    """One change of a filter: what ``setting`` became, ``value`` in the first run, and the parameter that moved most.

    ``change`` is in standard deviations of the estimate with the recipe's own filters.
    """

    setting: str
    value: float
    parameter: str
    change: float


@dataclass(frozen=True)
class _Varied(Recipe):
    """``own`` recipe with ``part`` of the ``setting``, cut-off or factor, that it gives a run: rates may differ."""

    own: Recipe = field(default_factory=Recipe)
    setting: str = "cutoff"
    part: float = 1.0

    @classmethod
    def of(cls, own: Recipe, setting: str, part: float) -> _Varied:
        return cls(**vars(own), own=own, setting=setting, part=part)

    def at(self, rate: float) -> Filters:
        before = self.own.at(rate)
        if self.setting == "cutoff":
            return self.own.changed(cutoff=self.part * before.cutoff).at(rate)
        return self.own.changed(factor=possible_factor(self.part * before.factor)).at(rate)


def sensitivity(found: Identification, data: Sequence[str | Path]) -> tuple[list[Variation], list[str]]:
    """Half and twice the Butterworth's cut-off, half and twice the decimation's factor, of each run's own.

    Also why some of them could not be tried: runs may be too short for them.
    """
    filters = [one.sampled.filters for one in found.train]
    tried, notes = [], []
    for setting, part in product(("cutoff", "factor"), _PARTS):
        recipe = _Varied.of(found.recipe, setting, part)
        values, own = [getattr(recipe.at(one.rate), setting) for one in filters], [getattr(f, setting) for f in filters]
        if values == own:
            notes.append(f"{setting} {values[0]:g} is at its limit: one that goes further could not be tried")
            continue
        try:
            tried += _variation(found, data, setting, float(values[0]), recipe)
        except InputError as error:
            notes.append(f"{setting} {values[0]:g} could not be tried: {error}")
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
