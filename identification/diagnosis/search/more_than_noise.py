"""Whether what was found leaves more than noise of the runs that are fitted."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.search.weighing import Weighing


def more_than_noise(weighing: Weighing, chosen: Sequence[Variant], coordinates: Iterable[int], part: float) -> bool:
    """Whether of any of the ``coordinates`` more power is left beside what was ``chosen`` than the noise's and a
    ``part`` of it.
    """
    weights = weighing.fitted_to(weighing.train, chosen)
    left = [weighing.bank.left_over(k, weights, weighing.train) for k in coordinates]
    return any(power > (1 + part) * rows for power, rows in left)
