"""A body in the tool's frame that the model does not have: its mass, first moments, and the inertia of a round body.

Ten inertial parameters are more than a run tells of a payload. What its weight and its swing show first are M, MX, MY
and MZ; of its inertia about the tool's origin one number is left, the same about all axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from generator.symbolic.bodies import INERTIAL
from identification.diagnosis.hypothesis import BODY, Coefficient, Hypothesis
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for the robot; coefficients as in the generator's input ``payload``, I in the place of XX, YY, ZZ."""
    if not scenes:
        return []
    return [
        Hypothesis(
            "payload",
            "payload",
            0,
            (
                Coefficient("M", "kg", 0.0),
                Coefficient("MX", "kg m"),
                Coefficient("MY", "kg m"),
                Coefficient("MZ", "kg m"),
                Coefficient("I", "kg m2", 0.0),
            ),
            _columns,
            kind=BODY,
            joints=tuple(joint.number for joint in scenes[0].robot.moving),
            variable="q",
            would_show="known inertial parameters (--prior), or a run with and one without the payload: in a free fit "
            "the parameters of the last bodies take it up",
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
    round_body = by_name["XX"] + by_name["YY"] + by_name["ZZ"]
    return np.stack([by_name["M"], by_name["MX"], by_name["MY"], by_name["MZ"], round_body])
