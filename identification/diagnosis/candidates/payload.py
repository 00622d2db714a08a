"""A body in the tool's frame that the model does not have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from generator.symbolic.bodies import INERTIAL
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BODY, Hypothesis
from identification.diagnosis.columns.payload_body import COEFFICIENTS, PARAMETERS
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for the robot."""
    if not scenes:
        return []
    return [
        Hypothesis(
            "payload",
            "payload",
            0,
            COEFFICIENTS,
            _columns,
            kind=BODY,
            joints=scenes[0].robot.numbers,
            variable="q",
            would_show="known inertial parameters (--prior): in a free fit the parameters of the last bodies take it "
            "up; of runs with and without a payload, counterpoise identify finds what the sidecars call unknown",
            separating={
                "spring_balancer": "a run with another payload: a balancer does not change with it",
                "gas_balancer": "a run with another payload: a balancer does not change with it",
                "torque_gain": "a run with another, known payload",
                "position_offset": "a run with another, known payload",
            },
        )
    ]


def _columns(scene: Scene, shape: Mapping[str, float]) -> Array:
    per_joint = np.stack(scene.regressors.payload(scene.motion), axis=1)
    by_name = dict(zip(INERTIAL, per_joint, strict=True))
    return np.stack([np.sum([by_name[name] for name in names], axis=0) for names in PARAMETERS.values()])
