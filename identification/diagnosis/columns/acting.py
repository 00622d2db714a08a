"""What a search has found, as the next one sees it: torques that act beside the model's, and values near the truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from generator.effects.library import library
from generator.robot.parameters import INERTIAL_STEMS
from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import BODY, EFFECT, LOAD, SHAPE, VALUE, Coefficient, Hypothesis
from identification.diagnosis.columns.payload_body import PARAMETERS, states, within
from identification.diagnosis.runs.scene import Scene
from identification.observation import Jump

#: Part of a value by which two searches may differ about it.
_NEAR = 0.01


@dataclass(frozen=True)
class Acting:
    """Variants that were found, and their coefficients one after the other."""

    variants: tuple[Variant, ...] = ()
    values: tuple[float, ...] = ()

    @classmethod
    def found(cls, bank: Bank, variants: Sequence[Variant], solution: Array) -> Acting:
        """By the values of a bank's base columns and of those of ``variants`` (p + k)."""
        return cls(tuple(variants), tuple(solution[len(bank.base) :].tolist()))

    @property
    def coefficients(self) -> dict[str, float]:
        """By name."""
        names = [coefficient.name for one in self.variants for coefficient in one.coefficients]
        return dict(zip(names, self.values, strict=True))

    def shape(self, effect: str, joint: int) -> Mapping[str, float]:
        """That of an effect on a joint by number, empty where it was not found."""
        return next((one.shape for one in self.variants if one.key == (effect, joint)), {})

    @property
    def jumps(self) -> tuple[Jump, ...]:
        """Where a joint's torque jumps with a speed that is not its own."""
        return tuple(jump for one in self.variants for jump in one.hypothesis.jumps)

    @property
    def again(self) -> bool:
        """Whether columns depend on what was found: on the model's torque, or on the load of a transmission."""
        on_load = len(self.variants) > 1 and any(one.hypothesis.variable == "load" for one in self.variants)
        return on_load or any(one.hypothesis.kind not in (EFFECT, SHAPE, VALUE) for one in self.variants)

    def near(self, before: Acting) -> bool:
        """Whether another search, in whose columns ``before`` acts, would find the same."""
        old, new = before.coefficients, self.coefficients
        torques = [{v.key for v in one._torques} for one in (before, self)]
        signals = [c.name for one in self.variants if one not in self._torques for c in one.coefficients]
        return torques[0] == torques[1] and all(
            abs(new[name] - old.get(name, 0.0)) <= _NEAR * abs(new[name]) for name in signals
        )

    def torque(self, scene: Scene) -> Array:
        """Torques (n x N) [N m, N] along a scene of what is a torque of its own, whatever the model's."""
        return self._sum(scene, lambda *_: True)

    def load(self, scene: Scene) -> Array:
        """What of them loads the drives (n x N) [N m, N]: bodies, inertias of rotors, effects on the links, offsets."""
        return self._sum(scene, _loads)

    def body(self, scene: Scene) -> Array:
        """Inertial parameters (10) [SI], in the tool's frame, of the payload that was found along a scene."""
        values, result = self.coefficients, dict.fromkeys(INERTIAL_STEMS, 0.0)
        for one in self.variants:
            there = one.hypothesis.kind == BODY or states(scene.sampled.run.payload, one.shape)
            if there and one.hypothesis.kind in (BODY, LOAD):
                for c in one.coefficients:
                    for stem in PARAMETERS[within(c.name)]:
                        result[stem] += values[c.name]
        return np.array([*result.values()])

    @property
    def _torques(self) -> tuple[Variant, ...]:
        return tuple(one for one in self.variants if one.hypothesis.kind in (EFFECT, BODY, LOAD, SHAPE, VALUE))

    def _sum(self, scene: Scene, counts: Callable[[Hypothesis, Coefficient], bool]) -> Array:
        result = np.zeros_like(scene.motion.q)
        values = self.coefficients
        for one in self._torques:
            pairs = zip(one.used, one.coefficients, strict=True)
            counted = [(i, values[each.name]) for i, each in pairs if counts(one.hypothesis, each)]
            # Columns cost time: those of which nothing counts are not made.
            columns = one.hypothesis.columns(scene, one.shape) if counted else ()
            for i, value in counted:
                result += value * columns[i]
        return result


def _loads(one: Hypothesis, coefficient: Coefficient) -> bool:
    """Whether a drive carries it: of a rotor its inertia alone."""
    return one.kind in (BODY, LOAD) or library()[one.effect].loads or coefficient.unit in ("kg m2", "kg")
