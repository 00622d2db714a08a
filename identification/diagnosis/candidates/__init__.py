"""What may be missing, one kind a module, found by being in this folder.

A module has ``hypotheses(scenes)``: what it offers for the robot of the scenes (the runs that are fitted), without what
the robot's file has already.
"""

from __future__ import annotations

from collections.abc import Sequence

from generator.discovery import modules
from identification.diagnosis import candidates
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.runs.scene import Scene


def hypotheses(scenes: Sequence[Scene]) -> tuple[Hypothesis, ...]:
    """All of all modules, in the order of their names."""
    found = [one for module in modules(candidates) for one in module.hypotheses(scenes)]
    return tuple(found)
