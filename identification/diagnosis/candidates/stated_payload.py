"""Another payload than the runs' sidecars state: what all that state the same mass carry beyond it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BEYOND, LOAD, PRIOR, Coefficient, Hypothesis
from identification.diagnosis.columns.payload_body import COEFFICIENTS, PARAMETERS, STATED_MASS, beyond, columns, states
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for each mass that runs state; a robot has one of them."""
    carried = [one.known for scene in scenes if (one := scene.sampled.run.payload) is not None]
    return [
        Hypothesis(
            "stated_payload",
            f"payload{BEYOND}",
            0,
            tuple(_beyond(one, [known for known in carried if known["M"] == mass]) for one in COEFFICIENTS),
            _columns,
            kind=LOAD,
            joints=scenes[0].robot.numbers,
            variable="q",
            given={STATED_MASS: mass},
            units={STATED_MASS: "kg"},
            would_show=f"{PRIOR}, or runs without the payload: where they are free, the parameters of the last "
            "bodies take up what all runs carry",
            separating={"torque_gain": "a payload that was weighed"},
        )
        for mass in dict.fromkeys(known["M"] for known in carried)
    ]


def _beyond(one: Coefficient, stated: Sequence[Mapping[str, float]]) -> Coefficient:
    """What is found of a coefficient leaves no run with less than nothing of it."""
    lower = one.lower if one.lower is None else -min(known[stem] for known in stated for stem in PARAMETERS[one.name])
    return replace(one, name=beyond(one.name), lower=lower)


def _columns(scene: Scene, shape: Mapping[str, float]) -> Array:
    return columns(scene) * states(scene.sampled.run.payload, shape)
