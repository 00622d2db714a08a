"""How fast drives get warm where the robot's file does not say: time constants that runs can tell."""

from __future__ import annotations

from collections.abc import Sequence

from identification.diagnosis.hypothesis import ShapeRange
from identification.diagnosis.scene import Scene

#: Time constants that are tried, in durations of the longest run; none that no motor's winding has [s].
_SHORTEST, _LONGEST, _QUICK = 0.2, 5.0, 10.0


def warm_up_times(scenes: Sequence[Scene]) -> ShapeRange:
    """The time constant T [s] of a warmth 1 - exp(-t/T) since the recordings began."""
    duration = max(float(scene.sampled.run.elapsed[-1]) for scene in scenes)
    shortest = max(_SHORTEST * duration, _QUICK)
    return ShapeRange("warm_up_time", "s", shortest, max(_LONGEST * duration, 2 * shortest))
