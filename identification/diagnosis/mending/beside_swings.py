"""Elastic drive trains beside the rigid model: the base parameters that they leave, of which a fit of the rigid model
makes other ones, and how far each of them swings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from generator.robot.description import ParameterSet
from generator.symbolic.model import Model
from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.runs.stated_elasticity import BOUNCING, TOGETHER, damped, names
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.finding import Finding

#: Part of their torques that runs show of the file's elastic drive trains if these swing at all.
_SWINGING = 0.5
#: Kinds of what changes no base parameter that the searched model has as well.
_APART = {EFFECT, ELASTIC}


def beside_swings(found: Search, model: Model, rigid: ParameterSet, additions: Sequence[Addition]) -> ParameterSet:
    """The set ``rigid`` of ``model`` with those base parameters in it that the searched model has alike, as all runs
    tell them beside all that was found; as it is where no drive train is elastic, or what was added changes them.
    """
    kinds = {one.kind for one in additions}
    if not (ELASTIC in kinds or _shown(found)) or not kinds <= _APART:
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


def without_findings(found: Search) -> dict[str, float]:
    """Base parameters of the searched model [SI], and what the file's elastic drive trains have, as all runs tell them
    without anything that was found; nothing where none of these swings.
    """
    return found.bank.values(found.weighing.fitted((), True)[0]) if _shown(found) else {}


def swinging(found: Search, findings: Sequence[Finding] = ()) -> dict[str, float]:
    """What the elastic drive trains of the file, where they swing, and of ``findings`` have, by the names of
    ``stated_elasticity``.
    """
    own = {name: found.values[name] for name in names(found.bank.robot)} if _shown(found) else {}
    for one in findings:
        if one.hypothesis.kind == ELASTIC:
            (number,) = one.joints
            own |= damped(number, one.shape["damping"])
            own[f"{BOUNCING}{number}" if one.hypothesis.effect == "backlash" else TOGETHER] = 1.0
    return own


def _shown(found: Search) -> bool:
    """Whether the runs show the swings of the file's elastic drive trains: others may be of a rigid robot."""
    of_trains = [name for name in names(found.bank.robot) if name == TOGETHER or name.startswith(BOUNCING)]
    return any(found.values[name] > _SWINGING for name in of_trains)
