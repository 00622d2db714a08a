"""The runs that test, played through the code of the old and the new model."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join, table
from generator.words import unit
from identification.report.chart import ESTIMATED, MEASURED, RESIDUAL, axis, chart
from identification.report.choice import choice
from identification.report.diagnose.subject import Subject
from identification.report.fit_chart import fit_chart
from identification.report.numbers import NONE, number, percent
from identification.report.series import numbers, points_each

TITLE = "Before and after on the runs that test"
ORDER = 80

_KNOWN = "These runs were fitted too: how the models do on new motion is not shown."


def render(subject: Subject) -> Markup | None:
    if not subject.tested:
        return None
    new = "Runs that nothing was fitted to or chosen by." if subject.found.roles.untouched else _KNOWN
    text = (
        f"{new} The model after is the new robot file's, regenerated; its parameters come"
        " from the fitted runs alone. The noise is what was measured on the other runs, at these rows' rate."
    )
    seen = [joint for joint in subject.numbers if joint in subject.tried]
    panels = {f"{joint}": choice("run", "Run", _panels(subject, joint)) for joint in seen}
    runs = choice("joint", "Joint", panels, subject.leading) if panels else None
    return join(element("p", text), _bars(subject), _table(subject), runs)


def _bars(subject: Subject) -> Markup:
    names = [f"joint {number}" for number in subject.tried]
    kinds = (
        ("before", RESIDUAL, [one.before.relative_to_mean for one in subject.tried.values()]),
        ("after", ESTIMATED, [one.after.relative_to_mean for one in subject.tried.values()]),
        ("noise", MEASURED, [one.relative_floor for one in subject.tried.values()]),
    )
    data = [{"type": "bar", "name": n, "x": names, "y": numbers(y), "marker": {"color": c}} for n, c, y in kinds]
    layout = {"xaxis": axis(""), "yaxis": axis("residual of the spread", "%"), "bargap": 0.3}
    return chart(data, layout, "Residual of the runs that test before and after, beside the noise", height=260)


def _table(subject: Subject) -> Markup:
    rows: list[list[Content]] = []
    for joint, one in subject.tried.items():
        symbol = f"\u202f{unit(subject.torque_units[joint])}"
        closed = NONE if one.closed is None else percent(100 * min(one.closed, 1.0))
        sizes = [[number(value, 4), symbol] for value in (one.before.rms, one.after.rms, one.floor)]
        rows.append(
            [str(joint), *sizes, percent(one.before.relative_to_mean), percent(one.after.relative_to_mean), closed]
        )
    heads = ("joint", "before, rms", "after", "noise", "before, of the spread", "after", "gap closed")
    return table(heads, rows, class_="numbers")


def _panels(subject: Subject, joint: int) -> dict[str, Markup]:
    k = subject.numbers.index(joint)
    count = points_each(5 * len(subject.numbers) * len(subject.tested))
    panels = {}
    for name, before, after in subject.tested:
        rows = before.kept[k] & after.kept[k]
        models = {"model after": after.model[k, rows], "model before": before.model[k, rows]}
        described = f"Torque of joint {joint} in {name}, measured and by the models before and after"
        label = f"torque of joint {joint}"
        measured, symbol = after.measured[k, rows], subject.torque_units[joint]
        panels[name] = fit_chart(after.t[rows], measured, models, label, symbol, described, count, all_shown=True)
    return panels
