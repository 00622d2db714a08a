"""Signals before and after the filters."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.arrays import Array
from identification.filtering import derivative
from identification.report.chart import ESTIMATED, MEASURED, Trace, axis, chart, line
from identification.report.choice import choice
from identification.report.identify.subject import ShownRun, Subject
from identification.report.series import Numbers, points_each, resolved, thinned

TITLE = "Before and after filtering"
ORDER = 100

#: What is shown of the raw signals, in ranges of the filtered ones.
_ROOM = 1.0


def render(subject: Subject) -> Markup:
    run = next(run for run in subject.runs if not run.held_out)
    one = run.observed.sampled.filters
    text = (
        f"{run.name}, recorded at {one.rate:g} Hz. Positions pass a Butterworth filter of order {one.order} at"
        f" {one.cutoff:g} Hz, forward and backward; torques and all columns of the observation matrix are decimated by"
        f" {one.factor}. Speeds and accelerations before filtering are plain differences; where they leave"
        " the picture a double click shows all of them."
    )
    panels = {f"{number}": _panel(subject, run, k, number) for k, number in enumerate(subject.numbers)}
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(subject: Subject, run: ShownRun, joint: int, number: int) -> Markup:
    sampled = run.observed.sampled
    inner = sampled.filters.inner(sampled.run.samples)
    raw = derivative(sampled.run.q[joint], sampled.run.period)
    rows, t, place = run.torques[joint], sampled.times, subject.position_units[number]
    speed, acceleration = sampled.motion.qd[joint], sampled.motion.qdd[joint]
    signals = [
        (f"torque of joint {number}", subject.torque_units[number], sampled.tau[joint], (rows.t, rows.measured)),
        (f"qd{number}", f"{place}/s", raw[inner], (t, speed)),
        (f"qdd{number}", f"{place}/s2", derivative(raw, sampled.run.period)[inner], (t, acceleration)),
    ]
    data: list[Trace] = []
    layout: dict[str, object] = {"xaxis": axis("time", "s", anchor="y3")}
    count = points_each(6 * len(subject.numbers))
    for k, (name, unit, before, after) in enumerate(signals):
        at = "" if k == 0 else str(k + 1)
        common: Trace = {"yaxis": f"y{at}", "showlegend": k == 0}
        data.append(line(*thinned(t, before, count), "recorded", MEASURED, legendgroup="b", **common))
        data.append(line(*thinned(*after, count), "filtered", ESTIMATED, legendgroup="a", **common))
        top = 1 - 0.345 * k
        layout[f"yaxis{at}"] = axis(name, unit, domain=[top - 0.3, top], **_range(after[1], before))
    return chart(
        data, layout, f"Torque, speed and acceleration of joint {number} before and after filtering", height=560
    )


def _range(filtered: Array, raw: Array) -> dict[str, Numbers]:
    """What keeps the filtered signal readable where the raw one is far larger."""
    if not len(filtered):
        return {}
    low, high = float(np.min(filtered)), float(np.max(filtered))
    room = _ROOM * (high - low)
    if not room or (raw.min() > low - room and raw.max() < high + room):
        return {}
    return {"range": resolved(np.array([low - room, high + room]), 4)}
