"""How runs are filtered before anything is identified: a recipe, with defaults that follow the rules of practice.

Rules (Gautier 1997): the Butterworth filter passes five times the highest frequency of the motion's dynamics, the
decimation twice that frequency.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from dataclasses import fields as of_class
from pathlib import Path

import numpy as np

from generator.errors import InputError, Place
from generator.resources import data_folder
from generator.robot import fields
from generator.robot.description import PRISMATIC, REVOLUTE, Robot
from generator.robot.document import Entry
from generator.robot.readers import document
from identification.arrays import Array
from identification.filtering import stages
from identification.formula import Formula, formulas

#: Cut-off of the Butterworth filter and new sampling rate, in frequencies of the dynamics. MATLAB's decimation by r
#: passes 0.4 of the new rate, which makes twice the dynamics.
_CUTOFF, _RATE = 5.0, 5.0
#: Highest cut-off of a filter, in parts of the sampling rate.
_HIGHEST = 0.45
#: Least frequency [Hz] of a recipe, below that of any robot's motion, and highest order of its filter.
_LEAST, _HIGHEST_ORDER = 1e-3, 20
#: Periods of the cut-off that the filter's ends are given.
_ENDS = 5.0
#: Speeds below which revolute [rad/s] and prismatic joints [m/s] stand still.
STANDSTILL = {REVOLUTE: 0.03, PRISMATIC: 0.005}
JOINT, NONE = "joint", "none"
PARAMETERS, SAMPLES = "parameters", "samples"


@dataclass(frozen=True)
class Recipe:
    """Settings of the filters and of the least squares; None where they follow from others.

    ``dynamics`` [Hz] is the highest frequency of the motion's dynamics. ``cutoff`` [Hz] and ``order`` are those of the
    Butterworth filter, ``factor`` is that of the decimation. ``dropped_first`` and ``dropped_last`` samples are left
    out before it. Where a joint is slower than ``standstill`` [rad/s, m/s] its rows are left out; None is 0.03 rad/s or
    0.005 m/s. ``weights`` is "joint" or "none". The residual's variance divides by rows minus estimated ``parameters``,
    or, as MATLAB's std, by rows minus one (``freedom`` = "samples"). ``columns`` are formulas for files with names of
    their own.
    """

    dynamics: float = 2.0
    cutoff: float | None = None
    order: int = 4
    factor: int | None = None
    dropped_first: int | None = None
    dropped_last: int | None = None
    standstill: float | None = None
    weights: str = JOINT
    freedom: str = PARAMETERS
    columns: Mapping[str, Formula] = field(default_factory=dict)

    def changed(self, **values: object) -> Recipe:
        """The recipe with the ``values`` that are not None in place of its own."""
        return replace(self, **{name: value for name, value in values.items() if value is not None})  # type: ignore[arg-type]

    @property
    def wanted_cutoff(self) -> float:
        """Cut-off of the Butterworth filter [Hz] at rates that do not limit it."""
        return self.cutoff or _CUTOFF * self.dynamics

    @property
    def slowest(self) -> float:
        """Sampling rate [Hz] below which a run does not hold the motion's dynamics."""
        return min(self.dynamics, self.cutoff or self.dynamics) / _HIGHEST

    def standstills(self, robot: Robot) -> Array:
        """Speeds (n) [rad/s, m/s] below which the joints' rows are left out."""
        return np.array(
            [STANDSTILL[joint.sigma] if self.standstill is None else self.standstill for joint in robot.moving]
        )

    def at(self, rate: float) -> Filters:
        """The filters for runs sampled at ``rate`` [Hz]."""
        cutoff = min(self.wanted_cutoff, _HIGHEST * rate)
        factor = self.factor or possible_factor(rate / (_RATE * self.dynamics))
        ends = round(_ENDS * rate / cutoff)
        first = ends if self.dropped_first is None else self.dropped_first
        last = ends if self.dropped_last is None else self.dropped_last
        return Filters(rate, cutoff, self.order, factor, first, last)


@dataclass(frozen=True)
class Filters:
    """Numbers for one sampling ``rate`` [Hz]: Butterworth ``cutoff`` [Hz] and ``order``, decimation ``factor``, and
    the samples left out at both ends between the two.
    """

    rate: float
    cutoff: float
    order: int
    factor: int
    first: int
    last: int

    @property
    def fewest(self) -> int:
        """Samples that a run needs at least."""
        needed, before = max(30, 10 * self.factor), 1
        for stage in stages(self.factor):
            needed = max(needed, before * stage.fewest)
            before *= stage.factor
        return self.first + self.last + needed

    def inner(self, samples: int) -> slice:
        """The samples of a run that its filter's ends leave."""
        return slice(self.first, samples - self.last)


def possible_factor(ratio: float) -> int:
    """The factor nearest to ``ratio`` that decimation in stages can have."""
    nearest = max(1, round(ratio))
    candidates = sorted(range(max(1, nearest // 2), 2 * nearest + 1), key=lambda r: (abs(r - ratio), r))
    return next(r for r in candidates if _has_stages(r))


def _has_stages(factor: int) -> bool:
    try:
        stages(factor)
    except ValueError:
        return False
    return True


def recipe_of(robot: str, given: Path | None = None) -> Recipe:
    """The recipe of a ``given`` file, else that in ``recipes/`` which is called as the robot is, else the defaults."""
    path = given or data_folder("recipes") / f"{robot}.yaml"
    return read(path) if given is not None or path.is_file() else Recipe()


def read(path: Path) -> Recipe:
    """The recipe that a YAML file says; raises InputError, with line and column, for what no recipe has."""
    root = document(path, "a recipe")
    names = [one.name for one in of_class(Recipe)]
    keys = fields.table(root, "the recipe", (), ("description", *names))
    values: dict[str, object] = {"columns": formulas(keys.get("columns"))}
    values |= {name: _positive(keys[name], name) for name in ("dynamics", "cutoff") if name in keys}
    if "standstill" in keys:
        values["standstill"] = _number(keys["standstill"], "standstill")
    for name, least in (("order", 1), ("factor", 1), ("dropped_first", 0), ("dropped_last", 0)):
        if name in keys:
            values[name] = _whole(keys[name], name, least)
    for name in ("dynamics", "cutoff", "order"):
        if name in keys:
            check_filter(name, float(values[name]), keys[name].value.place)  # type: ignore[arg-type]
    if "factor" in keys:
        check_stages(fields.integer(keys["factor"].value, "factor"), keys["factor"].value.place)
    for name, known in (("weights", (JOINT, NONE)), ("freedom", (PARAMETERS, SAMPLES))):
        if name in keys:
            values[name] = fields.word(keys[name].value, name, known)
    return Recipe().changed(**values)


def check_filter(name: str, value: float, place: Place) -> None:
    """Raises InputError for a frequency ``dynamics`` or ``cutoff`` [Hz] and an ``order`` that no filter has."""
    if name == "order" and value > _HIGHEST_ORDER:
        raise InputError(place, f"{name} is {value:g}", f"a whole number up to {_HIGHEST_ORDER}")
    if name != "order" and value < _LEAST:
        raise InputError(place, f"{name} is {value:g}", f"a frequency from {_LEAST:g} Hz on")


def check_stages(factor: int, place: Place) -> None:
    """Raises InputError where decimation has no stages for a ``factor``."""
    if not _has_stages(factor):
        raise InputError(place, f"factor is {factor}", "a product of numbers up to 13")


def _whole(entry: Entry, name: str, least: int) -> int:
    value = fields.integer(entry.value, name)
    if value < least:
        raise InputError(entry.value.place, f"{name} is {value}", f"a whole number from {least} on")
    return value


def _number(entry: Entry, name: str) -> float:
    value = float(fields.number(entry.value, name))
    if value < 0:
        raise InputError(entry.value.place, f"{name} is {value:g}", "a number that is not negative")
    return value


def _positive(entry: Entry, name: str) -> float:
    value = _number(entry, name)
    if not value:
        raise InputError(entry.value.place, f"{name} is 0", "a number above 0")
    return value
