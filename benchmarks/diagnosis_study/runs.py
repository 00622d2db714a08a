"""How the robots of the study move: three runs to fit, one to validate, one to test."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from tests.plant.trajectories.fourier import fourier
from tests.plant.trajectories.point_to_point import point_to_point
from tests.plant.trajectories.sweeps import slow_reversals
from tests.plant.trajectory import Trajectory

#: Names of the run files, in the order in which a motion returns its trajectories.
NAMES = ("fit1", "fit2", "fit3", "validate", "test")
#: How many of them are fitted.
FITTED = 3


def _periodic(seed: int) -> list[Trajectory]:
    return [fourier(5 * seed + k, periods=3 if k < FITTED else 2, harmonics=8) for k in range(len(NAMES))]


def _mixed(seed: int) -> list[Trajectory]:
    periodic = _periodic(seed)
    return [periodic[0], slow_reversals(5 * seed + 1, periods=3), point_to_point(5 * seed + 2, 30.0), *periodic[3:]]


def _short(seed: int) -> list[Trajectory]:
    return [fourier(5 * seed + k, period=5.0, periods=3, harmonics=6) for k in range(len(NAMES))]


#: Motions by name, each a function of a seed: periodic excitation alone, or with slow reversals and point to point;
#: and one that is quick to play, for tests.
MOTIONS: Mapping[str, Callable[[int], list[Trajectory]]] = {"fourier": _periodic, "mixed": _mixed, "short": _short}
