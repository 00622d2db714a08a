"""Another payload than the runs' sidecars state: what all that state one carry beyond it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BEYOND, LOAD, Coefficient, Hypothesis
from identification.diagnosis.columns.payload_body import COEFFICIENTS, PARAMETERS, beyond, columns
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for all runs together, where one states a payload: a mass that all have wrong alike."""
    carried = [scene.sampled.run.payload for scene in scenes]
    stated = [one.known for one in carried if one is not None]
    if not stated:
        return []
    return [
        Hypothesis(
            "stated_payload",
            f"payload{BEYOND}",
            0,
            tuple(_beyond(one, stated) for one in COEFFICIENTS),
            _columns,
            kind=LOAD,
            joints=scenes[0].robot.numbers,
            variable="q",
            would_show="known inertial parameters (--prior), or runs without the payload: in a free fit the parameters "
            "of the last bodies take up what all runs carry",
            separating={"torque_gain": "a payload that was weighed"},
        )
    ]


def _beyond(one: Coefficient, stated: Sequence[Mapping[str, float]]) -> Coefficient:
    """What is found of a coefficient leaves no run with less than nothing of it."""
    lower = one.lower if one.lower is None else -min(known[stem] for known in stated for stem in PARAMETERS[one.name])
    return replace(one, name=beyond(one.name), lower=lower)


def _columns(scene: Scene, shape: Mapping[str, float]) -> Array:
    found = columns(scene)
    return found if scene.sampled.run.payload is not None else np.zeros_like(found)
