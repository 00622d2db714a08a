"""How many base parameters a robot has, effect by effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from generator.effects.effect import Effect
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from generator.words import listed


@dataclass(frozen=True)
class Stage:
    """What has been counted so far: ``what`` was added, ``total`` base parameters are there now."""

    what: str
    total: int


def ladder(model: Model) -> list[Stage]:
    """Base parameters of the bodies alone, with motor inertias, with the rest of the drive trains, with all effects.

    Each is the rank of its columns of the regressor: every standard column is a sum of base columns, which are
    independent, so the coefficients of the groupings tell it exactly.
    """
    names = [parameter.name for parameter in model.standard_parameters]
    coefficients = np.array([[terms.get(name, 0.0) for name in names] for terms in model.grouping.numeric().values()])
    included = {f"{stem}{joint.number}" for joint in model.robot.bodies for stem in INERTIAL_STEMS}
    stages = [Stage("inertial parameters of the bodies", _rank(coefficients, names, included))]
    for effects in _groups(model):
        included |= {name for instance in model.effects if instance.effect in effects for name in instance.names}
        titles = listed(effect.title for effect in effects)
        stages.append(Stage(f"with {titles}", _rank(coefficients, names, included)))
    return stages


def _groups(model: Model) -> list[list[Effect]]:
    """The robot's effects: inertia of the drive trains, the rest of these, all others; empty groups left out."""
    effects = list({instance.effect.id: instance.effect for instance in model.effects}.values())
    inertia = [effect for effect in effects if effect.drive_train and "qdd" in effect.needs]
    drive = [effect for effect in effects if effect.drive_train and effect not in inertia]
    others = [effect for effect in effects if not effect.drive_train]
    return [group for group in (inertia, drive, others) if group]


def _rank(coefficients: np.ndarray[tuple[int, int], np.dtype[np.float64]], names: list[str], included: set[str]) -> int:
    chosen = [name in included for name in names]
    # The base columns are independent, so that all standard parameters together have one column each.
    return len(coefficients) if all(chosen) else int(np.linalg.matrix_rank(coefficients[:, chosen]))
