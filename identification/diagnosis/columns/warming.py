"""How fast drives get warm where the robot's file does not say: time constants that runs can tell."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.runs.scene import Scene

#: Time constants that are tried, in parts of the longest recording, and of what is the longest since a cold start; none
#: that no motor's winding has [s].
_SHORTEST, _LONGEST, _QUICK = 0.2, 5.0, 10.0
#: How many are held against another warmth.
_TIMES = 60


def warm_up_times(scenes: Sequence[Scene]) -> ShapeRange:
    """The time constant T [s] of a warmth 1 - exp(-t/T) since a cold start."""
    runs = [scene.sampled.run for scene in scenes]
    recorded = max(float(run.elapsed[-1]) for run in runs)
    warming = max(float(run.warming[-1]) for run in runs)
    shortest = max(_SHORTEST * recorded, _QUICK)
    return ShapeRange("warm_up_time", "s", shortest, max(_LONGEST * warming, 2 * shortest))


def following(k: int, scenes: Sequence[Scene], warmths: Sequence[Array]) -> float:
    """The time constant T [s] by which the drive of coordinate ``k`` gets warm most as ``warmths`` (N each) say."""

    def off(T: float) -> float:
        pairs = zip(scenes, warmths, strict=True)
        return float(sum(np.sum((scene.warmth(k, T) - other) ** 2) for scene, other in pairs))

    time = warm_up_times(scenes)
    tried: list[float] = np.geomspace(time.low, time.high, _TIMES).tolist()
    return min(tried, key=off)
