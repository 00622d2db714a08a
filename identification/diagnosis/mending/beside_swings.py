"""Base parameters beside the swings of elastic drive trains, of which a fit of the rigid model makes other ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from generator.robot.description import ParameterSet
from generator.symbolic.model import Model
from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.search.loop import Search

#: Kinds of what changes no base parameter that the searched model has as well.
_APART = {EFFECT, ELASTIC}


def beside_swings(found: Search, model: Model, rigid: ParameterSet, additions: Sequence[Addition]) -> ParameterSet:
    """The set ``rigid`` of ``model`` with those base parameters in it that the searched model has alike, as all runs
    tell them beside all that was found; as it is where what was added holds no elastic drive train, or changes them.
    """
    kinds = {one.kind for one in additions}
    if ELASTIC not in kinds or not kinds <= _APART:
        return rigid
    solution, covariance = found.weighing.fitted(found.variants, True)
    values, bank = found.bank.values(solution), found.bank
    std = dict(zip(bank.base, np.sqrt(np.maximum(covariance.diagonal(), 0.0)).tolist(), strict=False))
    searched, own = bank.scenes[0].regressors.model.grouping.numeric(), model.grouping.numeric()
    told = {
        name: replace(one, value=values[name], relative_std=100 * std[name] / abs(values[name]))
        for name, one in rigid.values.items()
        if searched.get(name) == own.get(name) and values.get(name)
    }
    return replace(rigid, values={**rigid.values, **told})
