"""Another value than the one that is known of a joint: of its torque offset, and of its rotor's inertia.

Where nothing is known beforehand a fit takes it up. A parameter set tells standard deviations as parts of the values.
Of an offset, which may be next to nothing, that is no measure of how far it moves: hoses, sensors and what rubs change
from day to day. A rotor's inertia differs by far more than is stated where motor or gear are other ones than the set's.
Springs, balancers or coupled rotors would stand for the difference.
"""

from __future__ import annotations

from collections.abc import Sequence

from generator.effects import offset, rotor_inertia
from generator.effects.effect import Effect
from generator.effects.library import names_of_effects
from generator.robot.description import Joint
from identification.diagnosis.columns.effect_columns import EffectColumns
from identification.diagnosis.columns.hypothesis import VALUE, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene

#: Effects of one coefficient, and what it shows in.
_EFFECTS = ((offset.EFFECT, "torque"), (rotor_inertia.EFFECT, "qdd"))


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One a joint that has such an effect in the robot's file and moves: the coefficient is what it is beyond that."""
    if not scenes:
        return []
    return [
        _beyond(effect, variable, joint, k, scenes[0])
        for effect, variable in _EFFECTS
        for k, joint in enumerate(scenes[0].robot.moving)
        if scenes[0].robot.has(effect.id, joint.number)
        if any(scene.moves(k) for scene in scenes)
    ]


def _beyond(effect: Effect, variable: str, joint: Joint, k: int, scene: Scene) -> Hypothesis:
    (parameter,) = effect.parameters
    return Hypothesis(
        effect.id,
        f"{effect.title} beyond the known one",
        joint.number,
        (Coefficient(f"{parameter.stem}{joint.number}", parameter.unit(joint)),),
        EffectColumns(effect, joint, k, scene.robot),
        kind=VALUE,
        joints=(joint.number,),
        variable=variable,
        grouped=_is_grouped(scene, f"{parameter.stem}{joint.number}"),
        of_motion=True,
    )


def _is_grouped(scene: Scene, name: str) -> bool:
    """Whether a base parameter of another name holds a parameter, or one together with those of bodies."""
    numeric = scene.regressors.model.grouping.numeric()
    return name not in numeric or not names_of_effects(scene.robot).issuperset(numeric[name])
