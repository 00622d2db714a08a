"""Correlations of the errors of parameters: which of them the data can only tell together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from generator.review.markup import Content, Markup, element, join, table
from identification.arrays import Array
from identification.report.chart import axis, chart
from identification.report.numbers import plain

#: Correlation from which a pair is listed, and how many pairs are.
_STRONG, _LISTED = 0.9, 12


def correlation(names: Sequence[str], hidden: Sequence[str], covariance: Array) -> Markup | None:
    """A map and the strongest pairs of parameters by their ``covariance`` (p x p); None for less than two of them.

    Those that are ``hidden`` are left out.
    """
    kept = [k for k, name in enumerate(names) if name not in hidden and covariance[k, k] > 0]
    if len(kept) < 2:
        return None
    names = [names[k] for k in kept]
    covariance = covariance[np.ix_(kept, kept)]
    std = np.sqrt(np.diag(covariance))
    rho = covariance / np.outer(std, std)
    heat = {
        "type": "heatmap", "x": names, "y": names, "z": np.round(rho, 3).tolist(), "zmin": -1, "zmax": 1,
        "colorscale": [[0, "--z"], [0.5, "--paper"], [1, "--x"]], "colorbar": {"thickness": 12, "outlinewidth": 0},
        "hovertemplate": "%{y}, %{x}: %{z}<extra></extra>",
    }  # fmt: skip
    small = {"size": 9 if len(names) > 30 else 11}
    layout = {
        "xaxis": axis("", tickangle=-90, tickfont=small, showgrid=False, dtick=1),
        "yaxis": axis("", autorange="reversed", tickfont=small, showgrid=False, dtick=1),
    }
    text = (
        "Correlation of the errors of two parameters: near 1 or −1 the data know their sum or difference well and each"
        " alone poorly."
    )
    height = max(320, min(900, 120 + 13 * len(names)))
    return join(
        element("p", text), chart([heat], layout, "Correlations of the parameters", height=height), _pairs(names, rho)
    )


def _pairs(names: Sequence[str], rho: Array) -> Markup:
    upper = np.triu_indices(len(names), 1)
    order = np.argsort(-np.abs(rho[upper]), kind="stable")
    rows: list[list[Content]] = [
        [element("code", names[i]), element("code", names[j]), plain(float(rho[i, j]), 3)]
        for i, j in ((int(upper[0][k]), int(upper[1][k])) for k in order[:_LISTED])
        if abs(rho[i, j]) >= _STRONG
    ]
    if not rows:
        return element("p", f"No two parameters are correlated by more than {_STRONG:g}.")
    return table(("strongest", "with", "correlation"), rows, class_="numbers")
