"""Accelerations where friction goes with the load of a drive.

With L the load and r the inertia of its rotor, which the transmission does not carry, a drive supplies
y = L + s |L - r qdd|, s what the friction makes of a unit load; the load moves the robot, M qdd = L + b. With |s| < 1
and the sign of L - r qdd known, the friction is no more than a share t = 1/(1 + s sign) of y, and less of M:
(M - r (1 - t)) qdd = t y + b. That sign is the one of y - r qdd. Without r it is known beforehand. With one such drive
it is that of the accelerations without friction by load, as r is at most the inertia that the joint feels. With several
those accelerations tell a first guess of the signs, and its accelerations the signs: only loads next to nothing can
then have the wrong one.
"""

from __future__ import annotations

import numpy as np

from generator.symbolic.direct import solve
from generator.symbolic.vectors import Array


def accelerations(M: Array, y: Array, b: Array, slopes: Array, rotors: Array) -> Array:
    """qdd (n) of M (n x n), of what the drives supply, of the rest b, and of each drive's s and r (n each)."""
    program = y[0].program
    loaded = [k for k, s in enumerate(slopes) if s is not program.zero]
    turning = [k for k in loaded if rotors[k] is not program.zero]
    qdd = solve(M, y + b) if turning else y
    for _ in range(min(len(loaded), 2) if turning else 1):
        less, load = M.copy(), y.copy()
        for k in loaded:
            share = 1 / (1 + slopes[k] * program.function("sign", y[k] - rotors[k] * qdd[k]))
            less[k, k] = M[k, k] - rotors[k] * (1 - share)
            load[k] = share * y[k]
        qdd = solve(less, load + b)
    return np.asarray(qdd)
