"""Torques of the model without what noise of the positions makes of them.

Accelerations of recorded positions hold noise that grows with the frequency, and so does the model's torque. A column
that is made of its changes is regressed on that noise too, and its coefficient comes out too small. Of each frequency
the recorded torque, whose noise is another one, tells how much of the model's is there: the part H = Re S_mr / S_mm of
the spectra of both (Wiener's filter). With H in its place a coefficient is right on the average, however rows are
weighed.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import csd, welch

from identification.arrays import Array

#: Seconds of the stretches over which spectra are averaged, and how many of them there are at least.
_STRETCH, _LEAST = 2.0, 8


def confirmed(modelled: Array, recorded: Array, period: float, late: float = 0.0) -> Array:
    """Torques of the model (n x N) with every frequency as far as the recorded ones (n x N) have it too, which are
    ``late`` [s] and as all samples ``period`` [s] apart.
    """
    samples = modelled.shape[-1]
    stretch = min(round(_STRETCH / period), samples // _LEAST)
    if stretch < 2:
        return modelled
    # Of differences: what is slow is large, and leaks.
    m, r = (np.diff(x, axis=-1) for x in (modelled, recorded))
    f, common = csd(m, r, 1 / period, nperseg=stretch, axis=-1)
    _, own = welch(m, 1 / period, nperseg=stretch, axis=-1)
    common = common * np.exp(2j * np.pi * f * late)
    part = np.clip(common.real / np.maximum(own, np.finfo(float).tiny), 0.0, 1.0)
    # Mirrored, so that nothing jumps from the end to the beginning.
    whole = np.concatenate([modelled, modelled[..., ::-1]], axis=-1)
    at = np.fft.rfftfreq(2 * samples, period)
    kept = np.array([np.interp(at, f, one) for one in part])
    kept[:, 0] = 1.0
    return np.asarray(np.fft.irfft(np.fft.rfft(whole, axis=-1) * kept, 2 * samples, axis=-1)[..., :samples])
