"""How evenly the motions show the parameters, and what they show least."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Content, Markup, element, join, table
from identification.factors import triangular
from identification.report.chart import ESTIMATED, axis, chart, log_axis
from identification.report.identify.subject import Subject
from identification.report.numbers import number, plain
from identification.report.series import numbers

TITLE = "Condition of the observation matrix"
ORDER = 80

#: How many combinations are told, and the least part of a parameter in one.
_TOLD, _PART = 3, 0.2


def render(subject: Subject) -> Markup | None:
    solution = subject.found.full.solution
    s, V, names = directions(subject)
    if not s.any():
        return None
    text = [
        "cond(W) is ", number(solution.condition, 6), ", with columns of unit length ",
        number(solution.scaled_condition, 4), "; 1 would be ideal. ",
        "The second does not depend on the units: an error of the torques of 1 % can, in the worst case, move the"
        f" parameters by {plain(solution.scaled_condition, 2)} % of their common length. Its singular values are below;"
        " a small one is a combination of parameters that the runs hardly show, and other motions would.",
    ]  # fmt: skip
    bars = [{
        "type": "bar", "x": list(range(1, len(s) + 1)), "y": numbers(s / s[0]),
        "marker": {"color": ESTIMATED}, "hovertemplate": "%{y:.3g}<extra></extra>",
    }]  # fmt: skip
    layout = {
        "xaxis": axis("number"),
        "yaxis": log_axis("singular value, in the largest", "", (s / s[0]).tolist()),
        "bargap": 0.25,
    }
    weakest: list[list[Content]] = [
        [plain(float(s[k] / s[0]), 2), _combination(V[k], names)] for k in range(len(s) - 1, -1, -1)[:_TOLD]
    ]
    heads = ("shown least", "combination, each parameter in units of 1 / its column's length")
    return join(
        element("p", text),
        chart(bars, layout, "Singular values of the scaled observation matrix", height=240),
        table(heads, weakest, class_="remarks"),
    )


def directions(subject: Subject) -> tuple[np.ndarray[tuple[int], np.dtype[np.float64]], list[list[float]], list[str]]:
    """Singular values of W with columns of unit length, and the right singular vectors, a row each."""
    problem = subject.found.problem
    R = triangular(np.concatenate([one.on(problem.names)[:, :-1] for one in problem.factors]))
    size = np.linalg.norm(R, axis=0)
    live = np.flatnonzero(size > 0)
    _, s, Vt = np.linalg.svd(R[:, live] / size[live], full_matrices=False)
    return s, Vt.tolist(), [problem.names[k] for k in live]


def _combination(v: list[float], names: list[str]) -> Content:
    order = sorted(range(len(v)), key=lambda k: -abs(v[k]))
    sign = 1 if v[order[0]] > 0 else -1
    told = [k for k in order if abs(v[k]) > _PART] or order[:1]
    pieces: list[Content] = []
    for k in told:
        value = sign * v[k]
        pieces += [" + " if value > 0 else " − ", plain(abs(value), 2), "\u202f", element("code", names[k])]
    return pieces[1:]
