"""Finite Fourier series of all joints (Swevers et al. 1997): periodic motions with exact derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.observation import Motion


@dataclass(frozen=True)
class FourierSeries:
    """q_k(t) = centre_k + sum over l of a_kl sin(l w t) + b_kl cos(l w t), w = 2 pi ``frequency`` [Hz].

    ``centre`` (n), ``a`` and ``b`` (n x L) in rad, m.
    """

    frequency: float
    centre: Array
    a: Array
    b: Array

    def motion(self, times: Array) -> Motion:
        """Positions, speeds and accelerations (n x N) at ``times`` (N) [s]."""
        orders = np.arange(1.0, self.a.shape[1] + 1)
        rate = 2 * np.pi * self.frequency * orders
        sine, cosine = np.sin(np.outer(rate, times)), np.cos(np.outer(rate, times))
        return Motion(
            self.centre[:, None] + self.a @ sine + self.b @ cosine,
            (rate * self.a) @ cosine - (rate * self.b) @ sine,
            -(rate**2 * self.a) @ sine - (rate**2 * self.b) @ cosine,
        )

    def resized(self, factor: float) -> FourierSeries:
        """The series with its motion about the centre ``factor`` times as large."""
        return FourierSeries(self.frequency, self.centre, factor * self.a, factor * self.b)


def without(x: Array, direction: Array) -> Array:
    """``x`` without its part along ``direction``."""
    result: Array = x - np.multiply.outer(x @ direction, direction) / (direction @ direction)
    return result


def from_rest(a: Array, b: Array) -> tuple[Array, Array]:
    """Coefficients (.. x L) without what makes speed and acceleration at t = 0: sum a_l l = 0, sum b_l l^2 = 0."""
    orders = np.arange(1.0, a.shape[-1] + 1)
    return without(a, orders), without(b, orders**2)
