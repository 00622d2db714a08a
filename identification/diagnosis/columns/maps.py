"""Torques that follow from a joint's motion by no law of the library: columns that any of them is nearly a sum of.

They name nothing. Along a motion that does not repeat they keep what the model lacks out of the noise.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.reversals import since_reversal
from identification.diagnosis.runs.scene import Scene

#: Places along a joint's range, and along its speeds, between which a torque is even.
_PLACES, _SPEEDS = 24, 8
#: Times [s] within which a torque fades after a reversal.
_FADING = (0.1, 0.4)


def maps(runs: Sequence[Prepared], scenes: Sequence[Scene]) -> list[list[Array]]:
    """By joint and run, rows (m x rows) of what may act on it, the same m in all runs; zero in one that repeats, and
    none where all do.

    The torque at places of the range, forward and backward, and at speeds; what other joints' speeds drag, and drag
    against the joint's own motion; and what fades after a reversal.
    """
    if all(run.period for run in runs):
        return []
    return [_of(runs, scenes, k) for k in range(len(scenes[0].motion.q))]


def groups(joints: Sequence[int], k: int) -> dict[str, slice]:
    """The rows of joint k's maps that are of one kind, by what the torque then follows, in words."""
    sizes = {
        "its place": 2 * _PLACES,
        "its speed": _SPEEDS,
        **{f"the speed of joint {number}": 2 for i, number in enumerate(joints) if i != k},
        "the time since it turned round": len(_FADING),
    }
    ends = np.cumsum([*sizes.values()]).tolist()
    return {what: slice(end - size, end) for (what, size), end in zip(sizes.items(), ends, strict=True)}


def _of(runs: Sequence[Prepared], scenes: Sequence[Scene], k: int) -> list[Array]:
    span = span_of([scene.motion.q[k] for scene in scenes])
    fastest = max(float(np.abs(scene.motion.qd[k]).max()) for scene in scenes)
    every = [run.decimated(_columns(scene, k, span, fastest)) for run, scene in zip(runs, scenes, strict=True)]
    return [np.zeros_like(rows) if run.period else rows for run, rows in zip(runs, every, strict=True)]


def span_of(signals: Sequence[Array]) -> tuple[float, float]:
    """The least and the largest value of all ``signals`` (N each)."""
    return min(float(x.min()) for x in signals), max(float(x.max()) for x in signals)


def _columns(scene: Scene, k: int, span: tuple[float, float], fastest: float) -> Array:
    """Columns (m x N) at the recorded rate, kind by kind as ``groups`` has them."""
    q, qd = scene.motion.q[k], scene.motion.qd
    sign = np.sign(qd[k])
    place = _tents(q, span, _PLACES)
    speed = _tents(qd[k], (-fastest, fastest), _SPEEDS)
    drag = [row for other in np.delete(qd, k, axis=0) for row in (other, sign * np.abs(other))]
    fading = [sign * np.exp(-since_reversal(scene, k) / time) for time in _FADING]
    return np.concatenate([place, sign * place, speed, [*drag, *fading]])


def _tents(x: Array, span: tuple[float, float], count: int) -> Array:
    """Functions (count x N) of x that are 1 at one of even places between two ends and fall to 0 at the next ones."""
    lower, upper = span
    at = (x - lower) / max(upper - lower, 1e-12) * (count - 1)
    return np.asarray(np.maximum(1 - np.abs(at - np.arange(count)[:, None]), 0.0))
