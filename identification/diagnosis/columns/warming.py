"""How fast drives get warm where the robot's file does not say: time constants that runs can tell."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, log

import numpy as np

from identification.arrays import Array
from identification.corrections import NEVER, warming_up
from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.runs.scene import Scene

#: Time constants that are tried, in parts of the longest recording, and of what is the longest since a cold start; none
#: that no motor's winding has [s]; how many times the shortest the longest is at least.
_SHORTEST, _LONGEST, _QUICK, _WIDE = 0.2, 5.0, 10.0, 2.0
#: How many are tried at least, how far apart at most by their logarithm, and what is too long for the robot file [s].
_COUNT, _APART, _NEVER = 5, 0.85, NEVER / 2
#: How many are held against another warmth.
_TIMES = 60


def warm_up_times(scenes: Sequence[Scene]) -> ShapeRange:
    """The time constant T [s] of a warmth 1 - exp(-t/T) since a cold start."""
    runs = [scene.sampled.run for scene in scenes]
    recorded = max(float(run.elapsed[-1]) for run in runs)
    warming = max(float(run.warming[-1]) for run in runs)
    shortest = min(max(_SHORTEST * recorded, _QUICK), _NEVER / _WIDE)
    longest = min(max(_LONGEST * warming, _WIDE * shortest), _NEVER)
    count = max(_COUNT, ceil(log(longest / shortest) / _APART) + 1)
    return ShapeRange("warm_up_time", "s", shortest, longest, count)


def following(scenes: Sequence[Scene], warmths: Sequence[Array]) -> float:
    """The time constant T [s] by which a drive gets warm in the recordings most as ``warmths`` (N each) say."""

    def off(T: float) -> float:
        pairs = zip(scenes, warmths, strict=True)
        return float(sum(np.sum((warming_up(scene.t, T) - other) ** 2) for scene, other in pairs))

    time = warm_up_times(scenes)
    tried: list[float] = np.geomspace(time.low, time.high, _TIMES).tolist()
    return min(tried, key=off)
