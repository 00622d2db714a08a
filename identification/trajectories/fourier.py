"""Random finite Fourier series: periodic, from rest to rest, within limits."""

from __future__ import annotations

import numpy as np

from identification.fourier_series import FourierSeries, from_rest
from identification.trajectory import Reference, Setting, Task, Trajectory, Unplanned

#: Instants of a period of the highest harmonic at which a series is looked at.
_LOOKED_AT = 400
#: Largest phase of the highest harmonic in a sample [rad].
_PHASE = 0.5


def _plan(task: Task) -> Reference:
    """Series as large as the tightest of a joint's limits allows."""
    frequency = task.number("frequency")
    orders = np.arange(1.0, round(task.number("harmonics")) + 1)
    if 2 * np.pi * frequency * orders[-1] * task.period > _PHASE:
        raise Unplanned("the highest harmonic is too fast for the controller", "a lower frequency")
    lower, upper = task.room
    n = len(task.pose)
    room = np.minimum(upper - task.pose, task.pose - lower)
    if (room <= 0).any():
        number = task.robot.moving[int(np.argmin(room))].number
        raise Unplanned(f"joint {number} is too near to its limit", "--pose with room on both sides")
    drawn = task.draw.normal(size=(n, 2, len(orders))) / orders
    a, b = from_rest(drawn[:, 0], drawn[:, 1])
    looked_at = np.linspace(0, 1 / frequency, _LOOKED_AT * len(orders))
    peaks = FourierSeries(frequency, np.zeros(n), a, b).motion(looked_at)
    limits = (room, task.number("speed"), task.number("acceleration"))
    scale = np.min([limit / np.abs(one).max(axis=1) for limit, one in zip(limits, peaks.signals, strict=True)], axis=0)
    motion = FourierSeries(frequency, task.pose, scale[:, None] * a, scale[:, None] * b).motion(task.times)
    return Reference(motion.q.T, motion.qd.T)


TRAJECTORY = Trajectory(
    name="fourier",
    title="Fourier series about the pose, from rest to rest",
    settings={
        "frequency": Setting(0.1, "lowest frequency [Hz]"),
        "harmonics": Setting(5.0, "number of its multiples", above=1, below=100, whole=True),
        "speed": Setting(1.0, "largest speed of a joint [rad/s, m/s]"),
        "acceleration": Setting(2.0, "largest acceleration of a joint [rad/s2, m/s2]"),
    },
    plan=_plan,
)
