"""Any vector of numbers as a motion within limits, so that the search for the best one has no constraints.

For each joint, coefficients make the shape of its Fourier series, whose size is what the tightest limit on position,
speed and acceleration allows; one number more makes it smaller, and one places its centre in the room that it leaves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.excitation.limits import Limits
from identification.fourier_series import FourierSeries, from_rest
from identification.observation import Motion

#: Instants in a period of the highest harmonic at which the search and the final motion are looked at.
SEARCHED, CHECKED = 40, 400
#: Part kept free for what lies between the instants: 1 - cos(pi / 400) = 3.1e-5 of an amplitude.
BETWEEN = 1e-4
#: The first size of a motion in the search: logistic(3) = 0.95.
_SIZE = 3.0


@dataclass(frozen=True)
class Shapes:
    """Motions of n joints with so many ``harmonics`` of a ``frequency`` [Hz] within ``limits``."""

    limits: Limits
    frequency: float
    harmonics: int

    @property
    def joints(self) -> int:
        """n."""
        return len(self.limits.lower)

    @property
    def per_joint(self) -> int:
        """Numbers that make one joint's series."""
        return 2 * self.harmonics + 2

    def instants(self, count: int) -> Array:
        """Times [s] of a period (``count`` L), ``count`` in a period of the highest harmonic, number L."""
        total = count * self.harmonics
        return np.asarray((np.arange(total) + 0.5) / (total * self.frequency), dtype=float)

    def drawn(self, count: int, draw: np.random.Generator) -> Array:
        """So many random vectors (count x numbers)."""
        x = draw.normal(size=(count, self.joints, self.per_joint))
        x[..., -2] = _SIZE
        x[..., -1] /= 2
        result: Array = x.reshape(count, -1)
        return result

    def motions(self, x: Array) -> Motion:
        """Of vectors (B x numbers): signals (n x B T) at the instants of a period, one motion after the other."""
        count = len(x)
        placed = self._series(x, SEARCHED).motion(self.instants(SEARCHED))
        parts = [one.reshape(count, self.joints, -1) for one in placed.signals]
        return Motion(*(np.moveaxis(one, 1, 0).reshape(self.joints, -1) for one in parts))

    def series(self, x: Array) -> FourierSeries:
        """Of one vector (numbers); within the limits of motion at all times."""
        return self._series(x[None], CHECKED).resized(1 - BETWEEN)

    def _series(self, x: Array, count: int) -> FourierSeries:
        """The series of all vectors, joint by joint (B n of them)."""
        joints = x.reshape(-1, self.per_joint)
        orders = np.arange(1.0, self.harmonics + 1)
        a, b = from_rest(joints[:, : self.harmonics] / orders, joints[:, self.harmonics : -2] / orders)
        still = np.zeros(len(joints))
        q, qd, qdd = FourierSeries(self.frequency, still, a, b).motion(self.instants(count)).signals
        lower, upper, speed, acceleration = (
            np.tile(one, len(x))
            for one in (self.limits.lower, self.limits.upper, self.limits.speed, self.limits.acceleration)
        )
        least, most = q.min(axis=1), q.max(axis=1)
        largest = np.min(
            [(upper - lower) / (most - least), speed / np.abs(qd).max(axis=1), acceleration / np.abs(qdd).max(axis=1)],
            axis=0,
        )
        size = largest / (1 + np.exp(-joints[:, -2]))
        free = upper - lower - size * (most - least)
        centre = lower - size * least + free * (1 + np.tanh(joints[:, -1])) / 2
        return FourierSeries(self.frequency, centre, size[:, None] * a, size[:, None] * b)
