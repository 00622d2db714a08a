"""Orders of a joint's turn at which the residual repeats."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.diagnosis.runs.scene import Scene

#: Lowest order: slower ones are shared with everything that depends on the position.
LOWEST = 5
#: Peaks that are returned, and the least distance to the neighbours that a peak is compared with.
_PEAKS, _NEIGHBOURS = 4, 10
#: Waves along the way below which a ripple is no other than any torque of the position.
_WAVES = 2.0
#: Neighbours, and orders within which only one peak counts, in widths of a peak.
_AROUND, _APART = 2.5, 0.5
#: Samples of a run that are looked at.
_SAMPLES = 8000


def likely_orders(scenes: Sequence[Scene], k: int, last: int) -> tuple[float, ...]:
    """The whole orders up to ``last`` with the clearest peaks in the residual of coordinate k over its position.

    Along a short way neighbouring orders look alike: a peak is as wide as the way is short.
    """
    longest = max(float(np.ptp(scene.motion.q[k])) for scene in scenes)
    if not longest:
        return ()
    orders = np.arange(LOWEST, last + 1)
    power = np.zeros(len(orders))
    wide = 2 * np.pi / longest
    near, apart = int(max(_NEIGHBOURS, _AROUND * wide)), int(max(2, _APART * wide))
    for scene in scenes:
        step = max(1, scene.motion.samples // _SAMPLES)
        q = scene.motion.q[k, ::step]
        e = (scene.tau[k] - scene.model_torque[k])[::step]
        # Over the way and not over time: where the joint nearly stands friction leaves most.
        way = np.abs(scene.motion.qd[k, ::step])
        if not way.any():
            continue
        e = (e - np.average(e, weights=way)) * way
        turn = np.exp(1j * q)
        phase = turn**LOWEST
        for i in range(len(orders)):
            power[i] += abs(phase @ e) ** 2
            phase = phase * turn
    around = np.array([np.median(power[max(0, i - near) : i + near + 1]) for i in range(len(power))])
    peak = power / np.maximum(around, 1e-300)
    top = [i for i in np.argsort(-peak) if peak[i] == peak[max(0, i - apart) : i + apart + 1].max()]
    top = [i for i in top if orders[i] > _WAVES * wide]
    return tuple(sorted(float(orders[i]) for i in top[:_PEAKS]))
