"""What a search has found, as the next one sees it: torques that act beside the model's, and values near the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from identification.diagnosis.bank import Variant
from identification.diagnosis.hypothesis import BODY, EFFECT
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]

#: Part of a value by which two searches may differ about it.
_NEAR = 0.01


@dataclass(frozen=True)
class Acting:
    """Variants that were found, and their coefficients one after the other."""

    variants: tuple[Variant, ...] = ()
    values: tuple[float, ...] = ()

    @property
    def coefficients(self) -> dict[str, float]:
        """By name."""
        names = [coefficient.name for one in self.variants for coefficient in one.coefficients]
        return dict(zip(names, self.values, strict=True))

    @property
    def effects(self) -> tuple[Variant, ...]:
        """Those that are torques of their own, whatever the model's."""
        return tuple(one for one in self.variants if one.hypothesis.kind in (EFFECT, BODY))

    @property
    def again(self) -> bool:
        """Whether columns depend on what was found: on the model's torque, or on the load of a transmission."""
        on_load = len(self.variants) > 1 and any(one.hypothesis.variable == "load" for one in self.variants)
        return on_load or any(one.hypothesis.kind != EFFECT for one in self.variants)

    def near(self, before: Acting) -> bool:
        """Whether another search, in whose columns ``before`` acts, would find the same."""
        old, new = before.coefficients, self.coefficients
        shapes = [{(v.hypothesis.effect, v.hypothesis.joint) for v in one.effects} for one in (before, self)]
        signals = [c.name for one in self.variants if one not in self.effects for c in one.coefficients]
        return shapes[0] == shapes[1] and all(
            abs(new[name] - old.get(name, 0.0)) <= _NEAR * abs(new[name]) for name in signals
        )

    def torque(self, scene: Scene) -> Array:
        """Torques (n x N) of the effects along a scene."""
        result = np.zeros_like(scene.motion.q)
        values = self.coefficients
        for one in self.effects:
            columns = one.hypothesis.columns(scene, one.shape)
            for i, coefficient in zip(one.used, one.coefficients, strict=True):
                result += values[coefficient.name] * columns[i]
        return result
