"""Another torque offset than the one that is known of a joint: hoses, sensors and what rubs change from day to day.

Where nothing is known beforehand a fit takes it up. A parameter set tells standard deviations as parts of the values:
of an offset, which may be next to nothing, that is no measure of how far it moves, and springs or balancers would stand
for the difference.
"""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects import offset
from identification.diagnosis.columns.effect_columns import EffectColumns
from identification.diagnosis.columns.hypothesis import VALUE, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint that has an offset in the robot's file and moves: the coefficient is what it is beyond that."""
    if not scenes:
        return []
    robot, effect = scenes[0].robot, offset.EFFECT
    (parameter,) = effect.parameters
    there = {number for use in robot.effects if use.effect == effect.id for number in use.joints}
    return [
        Hypothesis(
            effect.id,
            f"{effect.title} beyond the known one",
            joint.number,
            (Coefficient(f"{parameter.stem}{joint.number}", parameter.unit(joint)),),
            EffectColumns(effect, joint, k, robot),
            kind=VALUE,
            joints=(joint.number,),
            variable="torque",
            of_motion=True,
        )
        for k, joint in enumerate(robot.moving)
        if joint.number in there and any(scene.moves(k) for scene in scenes)
    ]
