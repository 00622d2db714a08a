"""What may be missing: an effect on a joint, as columns of torque per unit of its parameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from generator.words import numbered
from identification.arrays import Array
from identification.diagnosis.runs.scene import Scene
from identification.observation import Jump
from identification.outcome import Value

#: Usual steps from an end of its range within which a shape value is at it.
_AT_END = 0.01
#: What a finding becomes in the robot file.
EFFECT, SIGNAL, BODY, BASE, DRIVE, ELASTIC = "effect", "signal", "body", "base", "drive", "elastic"
#: What it becomes in the parameters alone: another value of one that the file has, which only what is known shows.
VALUE = "value"
#: What it becomes in the runs' sidecars alone: another payload than they state.
LOAD = "load"
#: What it becomes in an effect that the file has: other shape values.
SHAPE = "shape"
#: What it becomes in the geometry: another length.
LENGTH = "length"

#: How a correction is called that the file has another one of already.
BEYOND = " beyond the stated one"
#: What shows an effect that a free fit takes up, as experiments ask for it; and what is left to ask for where they are
#: known already.
PRIOR, CLOSER = "known inertial parameters (--prior)", "inertial parameters that are known more closely"
#: What an effect shows over that changes where a joint turns round.
SINCE_REVERSAL = "time since reversal"

#: An effect and the number of its joint, 0 for the whole robot.
Key = tuple[str, int]


def asked_for(experiment: str, free: bool) -> str:
    """An experiment as it is asked for, in words, of a ``free`` fit or of one with known parameters."""
    return experiment if free else experiment.replace(PRIOR, CLOSER)


@dataclass(frozen=True)
class Coefficient:
    """A parameter that the columns multiply: its name in the robot's parameters or in the correction, its unit [SI],
    and closed physical bounds, None where free. Without one that is ``essential`` the effect would be another one; one
    that ``refines`` is taken only where it explains beyond chance. ``variable`` is what it shows over where that is
    not what its effect shows over. A free fit that makes it larger than ``believed`` may make it of
    what is common.
    """

    name: str
    unit: str
    lower: float | None = None
    upper: float | None = None
    essential: bool = False
    refines: bool = False
    variable: str = ""
    believed: float = math.inf


@dataclass(frozen=True)
class ShapeRange:
    """A shape value between ``low`` and ``high`` [``unit``], tried at ``count`` points (geometric steps if ``log``).

    ``points`` are tried instead where they are given, even over the logarithm if ``log``; with a ``step`` (of the
    logarithm if ``log``) the search goes on anywhere in the range. ``whole`` tells that nothing lies between
    them, ``exact`` that what fits better there is another effect, ``scale`` that any value will do, others counting in
    units of it, and ``vanishing`` that at its low end the effect is another one without it; so it is where
    ``vanishes`` says so of all shape values.
    """

    name: str
    unit: str
    low: float
    high: float
    count: int = 5
    log: bool = True
    points: tuple[float, ...] = ()
    step: float = 0.0
    whole: bool = False
    exact: bool = False
    scale: bool = False
    vanishing: bool = False
    vanishes: Callable[[Mapping[str, float]], bool] = field(default=lambda _: False, compare=False)

    def grid(self) -> list[float]:
        """The points that are tried first."""
        if self.points:
            return list(self.points)
        space = np.geomspace if self.log else np.linspace
        return [float(x) for x in space(self.low, self.high, self.count)]

    @property
    def free(self) -> bool:
        """Whether values between the tried ones are searched."""
        return not self.whole and (self.step > 0 or len(self.grid()) > 2)

    @property
    def spacing(self) -> float:
        """Usual step of the search, of the logarithm if ``log``."""
        return self.step or float(np.median(np.diff(np.sort(self._even(self.grid())))))

    def ends_at(self, value: float) -> bool:
        """Whether a value is at an end of the range."""
        return any(abs(self.steps(end, value)) < _AT_END for end in (self.low, self.high))

    def moved(self, value: float, steps: float) -> float:
        """A value moved by steps: anywhere in the range where it has a ``step``, else to one step of the grid beyond
        its ends at most.
        """
        if self.step:
            ends = self._even([self.low, self.high])
        else:
            ends = np.sort(self._even(self.grid()))[[0, -1]] + self.spacing * np.array([-1.0, 1.0])
        even = float(np.clip(self._even(value) + steps * self.spacing, *ends))
        return float(np.exp(even)) if self.log else even

    def steps(self, start: float, end: float) -> float:
        """How many usual steps lie between two values."""
        return float(self._even(end) - self._even(start)) / self.spacing

    def _even(self, values: ArrayLike) -> Array:
        """On the scale on which the grid is even."""
        return np.asarray(np.log(values) if self.log else values, dtype=float)


@dataclass(frozen=True)
class Hypothesis:
    """An effect on ``joint`` (number; 0 for the whole robot) with k coefficients that enter linearly.

    What it is: ``effect`` is an id of the generator's library, or of a correction of the robot file, and ``kind`` tells
    where a finding is written. It is named on ``joints``, and shows over ``variable``. ``usual`` is false of a balancer
    on a joint on which robots have none, ``stated`` true of what the robot's file itself speaks for, ``grouped`` of a
    value that no motion tells from one of a body.

    Its torque: ``columns(scene, shape)`` returns k x n x N torques [N m, N] per unit of each coefficient at the
    recorded rate: what the *measured* torque holds more than the model's says. ``jumps`` are where it jumps with a
    speed that is not the joint's own. ``of_model`` are the columns, of an effect that scales all of a drive's torque,
    for the part of it that the model has without what was found beside it. ``of_beginning`` is what the columns of an
    effect with a state hold of how that began, which no record tells. Columns that are ``recorded`` hold the noise
    of the record, and so cannot tell how much of it there is; those ``of_motion`` are the same whatever the model's
    values.

    Its shape: ``shapes`` are searched, from ``starts`` if there are any instead of all combinations of their grids;
    ``given`` are values that are known, in ``units`` (1 where not told); both are values of the effect in the robot
    file. ``tries`` is how many shapes it was chosen from, where those are more than the search begins with.

    What else tells it: ``measured`` are coefficients by name that the runs tell without any torque: there is nothing to
    search, and the columns are zero. ``preset`` are those that the runs tell by another fit than that of the columns,
    which are right for that value alone, and ``beyond`` the names of other hypotheses' coefficients without which it is
    nothing. ``agrees`` says whether coefficients in use and a shape, which tell the same twice, may be of one thing;
    ``twice`` tells of a coefficient by name which shape value, to which power, is the same by another way.

    Where it is not told: ``would_show`` says what data would show the effect where these cannot, ``separating`` maps
    ids of effects that are easily mistaken for this one to the experiment that tells them apart.
    """

    effect: str
    title: str
    joint: int
    coefficients: tuple[Coefficient, ...]
    columns: Callable[[Scene, Mapping[str, float]], Array]
    kind: str = EFFECT
    joints: tuple[int, ...] = ()
    variable: str = ""
    usual: bool = True
    stated: bool = False
    grouped: bool = False
    jumps: tuple[Jump, ...] = ()
    of_model: Callable[[Scene, Mapping[str, float]], Array] | None = None
    of_beginning: Callable[[Scene, Mapping[str, float]], Array] | None = None
    recorded: bool = False
    of_motion: bool = False
    shapes: tuple[ShapeRange, ...] = ()
    starts: tuple[Mapping[str, float], ...] = ()
    given: Mapping[str, float] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    tries: int = 0
    measured: Mapping[str, Value] = field(default_factory=dict)
    preset: Mapping[str, Value] = field(default_factory=dict)
    beyond: tuple[str, ...] = ()
    agrees: Callable[[Array, Mapping[str, float]], bool] | None = None
    twice: Mapping[str, tuple[str, int]] = field(default_factory=dict)
    would_show: str = ""
    separating: Mapping[str, str] = field(default_factory=dict)

    @property
    def free(self) -> int:
        """How many of the shapes' values are fitted to the runs."""
        return sum(one.free for one in self.shapes)

    @property
    def of_parameter(self) -> bool:
        """Whether its coefficients are other values of base parameters, by the same names."""
        return self.kind == VALUE and not self.grouped

    @property
    def key(self) -> Key:
        """What it is and where, whatever its shape."""
        return self.effect, self.joint

    @property
    def numbers(self) -> tuple[int, ...]:
        """The joints that it is named on; 0 for the whole robot."""
        return self.joints or (self.joint,)

    @property
    def named(self) -> str:
        """``Stribeck friction on joint 3``; what sits on no joint by its title alone."""
        return f"{self.title} on {numbered('joint', self.numbers)}" if self.joint else self.title

    def preset_value(self, name: str) -> float | None:
        """The value of a coefficient that is preset; None of another."""
        return self.preset[name].value if name in self.preset else None

    @property
    def variants(self) -> list[dict[str, float]]:
        """All combinations of the shapes' first grids, or ``starts``; one empty dictionary where there are none."""
        if self.starts:
            return [{**self.given, **one} for one in self.starts]
        result: list[dict[str, float]] = [dict(self.given)]
        for shape in self.shapes:
            result = [{**one, shape.name: x} for one in result for x in shape.grid()]
        return result


def reshaped(name: str) -> str:
    """How a coefficient of the file is called that has another shape."""
    return f"{name}_reshaped"
