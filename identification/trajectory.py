"""What a simulated robot is asked to do: a reference of every joint, and what the surroundings do to its links."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from generator.robot.description import PRISMATIC, Robot
from identification.arrays import Array

Value: TypeAlias = float | str

#: Half the range of a joint without limits, revolute [rad] and prismatic [m], and what is kept free at a limit.
_REACH = (np.pi / 2, 0.5)
_MARGIN = 0.05


class Unplanned(Exception):
    """A trajectory that a robot or its settings do not allow: the ``problem``, and what was ``expected``."""

    def __init__(self, problem: str, expected: str) -> None:
        super().__init__(f"{problem}, expected {expected}")
        self.problem, self.expected = problem, expected


@dataclass(frozen=True)
class Setting:
    """A setting of a trajectory: its ``default``, what it means with its unit, and what it may be.

    A number is more than ``above``, less than ``below``, and ``whole`` if it counts; a word is one of ``choices``, or
    the name of a ``file``.
    """

    default: Value
    meaning: str
    above: float = 0.0
    below: float = np.inf
    whole: bool = False
    choices: tuple[str, ...] = ()
    file: bool = False

    def allows(self, value: Value) -> bool:
        """Whether the setting may have a value."""
        if self.file:
            return isinstance(value, str)
        if self.choices or isinstance(value, str):
            return value in self.choices
        return self.above < value < self.below and not (self.whole and value % 1)

    @property
    def range(self) -> str:
        """What the setting may be, in words."""
        if self.file:
            return f"the name of {self.meaning}"
        if self.choices:
            return f"one of {', '.join(self.choices)}"
        ends = f"above {self.above:g}" + (f" and below {self.below:g}" if self.below < np.inf else "")
        return f"a {'whole ' if self.whole else ''}number {ends}, {self.meaning}"


@dataclass(frozen=True)
class Task:
    """What a trajectory is made for: ``samples`` of a ``period`` [s] about or from ``pose`` (n) [rad, m].

    ``model`` is the robot's compiled model (see ``identification.simulation.machine``), ``values`` are those of its
    parameters by name [SI]. ``draw`` is the source of all that is random, ``settings`` are values by name.
    """

    robot: Robot
    model: Any
    values: Mapping[str, float]
    flexible: bool
    pose: Array
    period: float
    samples: int
    draw: np.random.Generator
    settings: Mapping[str, Value]

    def number(self, name: str) -> float:
        """A setting that is a number."""
        return float(self.settings[name])

    @property
    def compliances(self) -> Array:
        """What the drive trains yield (n) [rad/(N m), m/N], zero where they are rigid."""
        stiffness = [self.values.get(f"k{joint.number}", 0.0) for joint in self.robot.moving]
        return np.array([1 / k if self.flexible and k > 0 else 0.0 for k in stiffness])

    @property
    def times(self) -> Array:
        """Times of the samples (N) [s]."""
        numbers: Array = np.arange(self.samples, dtype=float)
        return self.period * numbers

    @property
    def room(self) -> tuple[Array, Array]:
        """Lowest and highest positions (n each) [rad, m] that a trajectory may use."""
        return room(self.robot)


@dataclass(frozen=True)
class Stop:
    """A rigid stop that the tool's origin touches at the start and is pressed on along ``axis``, frictionless.

    ``axis`` (3) is a direction in the tool frame at the start; ``stiffness`` [N/m] and ``damping`` [N s/m] are the
    stop's own.
    """

    axis: tuple[float, float, float]
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Reference:
    """Positions and speeds (samples x n) wanted of the joints [rad, m; rad/s, m/s], at rest in the first sample.

    ``locked`` are the coordinates of links that are held where they are at the start. ``stop`` is what the tool is
    pressed on, if anything; where there is none, ``measured`` tells whether the wrench that holds the links is logged.
    """

    q: Array
    qd: Array
    locked: tuple[int, ...] = ()
    stop: Stop | None = None
    measured: bool = False


@dataclass(frozen=True)
class Trajectory:
    """A kind of trajectory by its ``name``; ``flexible`` ones need elastic drive trains.

    ``plan`` makes the reference; it raises Unplanned where the robot or a setting does not allow it. ``length`` [s] is
    what values of all its settings take where that is not for the run to say; it raises the same.
    """

    name: str
    title: str
    settings: Mapping[str, Setting]
    plan: Callable[[Task], Reference]
    flexible: bool = False
    length: Callable[[Mapping[str, Value]], float] | None = None


def ends_of(robot: Robot, coordinate: int) -> tuple[float, float]:
    """The limits of a moving joint (counted from 0) [rad, m], or a range of its own where the file has none."""
    joint = robot.moving[coordinate]
    if joint.lower is not None and joint.upper is not None:
        return float(joint.lower), float(joint.upper)
    reach = _REACH[joint.sigma == PRISMATIC]
    return -reach, reach


def room(robot: Robot) -> tuple[Array, Array]:
    """Lowest and highest positions (n each) [rad, m] that a motion may use: a little is kept free at the limits."""
    ends = np.array([ends_of(robot, k) for k in range(len(robot.moving))])
    free = _MARGIN * (ends[:, 1] - ends[:, 0])
    return ends[:, 0] + free, ends[:, 1] - free
