"""Where model and measurement disagree: on which joint, over which variable, in which region of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from generator.words import listed, numbered
from identification.arrays import Array
from identification.diagnosis.columns.bank import columns_of
from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.beginnings import beginnings
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.follows_motion import following
from identification.diagnosis.verdict.lack_of_fit import Lack, lack_of_fit
from identification.diagnosis.verdict.of_rounding import of_rounding
from identification.diagnosis.verdict.views import View, strongest, views

#: Part of the residual's variance that a variable must order to be a signature.
_ORDERED = 0.05
#: Part of what the strongest variable orders that the variable of a finding must order.
_LEADS = 0.25
#: Part of a sample's period within which the samples do not tell when a torque jumped.
_HALF_SAMPLE = 0.5
#: Size of an event, in parts of the largest lack, from which it is told first.
_EVENT = 0.5
#: Part of the largest excess above which a bin is told, and how many stretches of such bins are.
_OUTSTANDING, _STRETCHES = 0.5, 3
#: Variables over which means show an effect: over time and since a reversal its sign changes with the motion, over the
#: motor's phase other orders cancel.
_SHOWN = ("q", "q by direction", "qd", "qdd", "load")


@dataclass(frozen=True)
class Where:
    """Where model and measurement disagree most: ``joint`` (number, 0 if nowhere), ``variable``, its region in words.

    ``shares`` are the parts of that joint's residual that each variable orders. ``lack`` is each joint's.
    """

    joint: int
    variable: str
    region: str
    shares: Mapping[str, float]
    lack: tuple[Lack, ...]
    views: Mapping[int, tuple[View, ...]]

    @property
    def words(self) -> str:
        """``at q 0.3 to 0.4 rad``: the variable that orders the residual, and the region of it; empty without one."""
        if not self.variable:
            return ""
        if self.region.startswith(self.variable):
            return f"at {self.region}"
        return f"over {self.variable}" + (f", {self.region}" if self.region else "")

    @property
    def event(self) -> str:
        """What happens on the joint for a moment, in words: when; empty where nothing does."""
        return next((one.event for one in self.lack if one.joint == self.joint), "")


def seen(found: Search, weights: Mapping[int, float]) -> Where:
    """What values of columns by number leave of each joint, without a verdict on where that is most."""
    bank = found.bank
    numbers = bank.robot.numbers
    everything = range(len(bank.runs))
    chosen = found.variants
    unknown = beginnings(found, weights)
    elastic = columns_of([one for one in chosen if one.hypothesis.kind == ELASTIC])
    stiff = {column: x for column, x in weights.items() if column not in elastic}
    lacks, shown = [], {}
    for k, number in enumerate(numbers):
        white = [bank.residual(r, k, weights) for r in everything]
        doubtful = [np.hypot(late(found, r, k), unknown[r][k]) for r in everything]
        if elastic:
            swings = [bank.residual(r, k, stiff) - e for r, e in enumerate(white)]
            doubtful = [np.hypot(one, swing) for one, swing in zip(doubtful, swings, strict=True)]
        lack = lack_of_fit(bank.runs, white, k, number, doubtful, of_rounding(found, k, everything))
        lacks.append(following(bank, white, found.maps, k, lack))
        raw = [bank.residual(r, k, weights, white=False) for r in everything]
        shown[number] = views(bank.runs, bank.scenes, raw, k, [one[k] for one in bank.colours])
    return Where(0, "", "", {}, tuple(lacks), shown)


def late(found: Search, r: int, k: int) -> Array:
    """What a joint's torque changes by in the time that samples do not tell, in the m white kept rows of a run (m)."""
    bank = found.bank
    run, scene = bank.runs[r], bank.scenes[r]
    change = run.decimated(_HALF_SAMPLE * scene.period * scene.derivative(scene.torque[k]))
    return np.asarray(bank.whitened(r, k, change[None])[0])


def located(seen: Where, among: Sequence[Lack]) -> Where:
    """With the joint of ``among`` that lacks most, of a large event before all else, and what orders its residual."""
    if not among:
        return seen
    worst = max(among, key=lambda one: one.size)
    # The fit spreads an event over joints on which nothing happens.
    events = [one for one in among if one.burst is not None and one.size > _EVENT * worst.size]
    worst = max(events, key=lambda one: one.size, default=worst)
    variable, shares = strongest(mine := seen.views[worst.joint])
    region = _region(mine, variable)
    if worst.burst is not None and shares.get(variable, 0.0) < _ORDERED:
        variable, region = "time", replace(seen, joint=worst.joint).event
    return replace(seen, joint=worst.joint, variable=variable, region=region, shares=shares)


def led(before: Where, first: Finding, after: Where) -> Where:
    """With the joint of the leading finding, which has been told from all others, and with its variable; of what sits
    on no joint that where most is missing.

    Another variable that orders far more of the residual stays where means over both would show it, unless the finding
    couples joints: none of one joint's orders what follows two. What seemed to happen for a moment is a part of the
    finding where ``after`` it nothing does.
    """
    lacks = {one.joint: one.part for one in before.lack}
    joint = first.hypothesis.joint or max(first.amplitude, key=lambda one: (lacks.get(one, 0.0), first.amplitude[one]))
    mine = before.views[joint]
    _, shares = strongest(mine)
    ordering, of_shown = strongest([one for one in mine if one.variable in _SHOWN])
    variable = first.variable or ordering
    coupling = first.hypothesis.kind == EFFECT and len(first.joints) > 1
    if not coupling and of_shown.get(variable, np.inf) < _LEADS * max(of_shown.values(), default=0.0):
        variable = ordering
    region = f"of {numbered('joint', first.joints)} together" if coupling else ""
    # Of what means over it hardly order, or do not show, no bin tells where it is.
    if not coupling and variable in _SHOWN and shares.get(variable, 0.0) >= _ORDERED:
        region = _region(mine, variable)
    happens = [one.joint for one in after.lack if one.burst is not None]
    lack = [one if one.joint != joint or joint in happens else replace(one, burst=None) for one in before.lack]
    return replace(before, joint=joint, variable=variable, region=region, shares=shares, lack=tuple(lack))


def _region(found: Sequence[View], variable: str) -> str:
    """The bins that stand out of the noise's band, in words."""
    parts = []
    for one in found:
        if one.variable != variable:
            continue
        out = np.abs(one.mean) - one.band
        if not len(out) or out.max() <= 0:
            continue
        way = {-1: " moving backward", 0: "", 1: " moving forward"}[one.direction]
        spans = [_span(one.centre[at]) for at in _outstanding(out)]
        parts.append(f"{variable} {listed(spans)} {one.unit}{way}")
    return "; ".join(parts)


def _outstanding(out: Array) -> list[NDArray[np.int64]]:
    """Stretches of neighbouring bins in which ``out`` is above half of its largest, by number; the three with most."""
    at = np.flatnonzero(out > _OUTSTANDING * out.max())
    stretches = np.split(at, np.flatnonzero(np.diff(at) > 1) + 1)
    most = sorted(stretches, key=lambda one: -out[one].max())[:_STRETCHES]
    return sorted(most, key=lambda one: int(one[0]))


def _span(centres: Array) -> str:
    return f"{centres[0]:.3g} to {centres[-1]:.3g}" if len(centres) > 1 else f"about {centres[0]:.3g}"
