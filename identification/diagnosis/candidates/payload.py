"""A body in the tool's frame that the model does not have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BODY, PRIOR, Hypothesis
from identification.diagnosis.columns.payload_body import COEFFICIENTS, columns
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for the robot; none where all runs state a payload, to which ``stated_payload`` adds."""
    if all(scene.sampled.run.payload is not None for scene in scenes):
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
            would_show=f"{PRIOR}: where they are free, the parameters of the last bodies take it up; "
            "of runs with and without a payload, counterpoise identify finds what the sidecars call unknown",
            separating={
                "spring_balancer": "a run with another payload: a balancer does not change with it",
                "gas_balancer": "a run with another payload: a balancer does not change with it",
                "torque_gain": "a run with another, known payload",
                "position_offset": "a run with another, known payload",
            },
        )
    ]


def _columns(scene: Scene, shape: Mapping[str, float]) -> Array:
    return columns(scene)
