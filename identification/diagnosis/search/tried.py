"""What it costs that many shapes of a hypothesis were tried, and whether the best of them is within what was tried."""

from __future__ import annotations

from scipy.stats import chi2

from identification.diagnosis.columns.bank import Variant

#: Times its low end below which what vanishes there has vanished.
_VANISHED = 1.1
#: Least points of a grid that has ends, and how far below and above them, in parts of the first and the last, is one.
_FEWEST, _LOW, _HIGH = 4, 0.7, 1.4


def chance(drop: float, variant: Variant) -> float:
    """How likely noise makes the best of all shapes that were tried explain as much."""
    return min(1.0, variant.tries * float(chi2.sf(drop, max(len(variant.columns), 1))))


def at_end(variant: Variant) -> bool:
    """Whether a shape is at or beyond the end of what was tried: then it is another effect."""
    for shape in variant.hypothesis.shapes:
        if (shape.vanishing and variant.shape[shape.name] <= shape.low * _VANISHED) or shape.vanishes(variant.shape):
            return True
        points = shape.grid()
        if shape.whole or shape.step or len(points) < _FEWEST or not shape.log:
            continue
        value = variant.shape[shape.name]
        if value <= min(points) * _LOW or value >= max(points) * _HIGH:
            return True
    return False
