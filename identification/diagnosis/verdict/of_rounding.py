"""What rounding of positions and efforts makes of residuals: noise that periods of a motion have in common."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from identification.diagnosis.search.loop import Search


def of_rounding(found: Search, k: int, runs: Sequence[int]) -> float:
    """Its mean square in the white rows of coordinate k of those of ``runs``, by number, that repeat."""
    bank = found.bank
    rows = [bank.whitened(r, k, found.rounded[r][k][None])[0] for r in runs if bank.runs[r].times]
    return float(np.mean(np.concatenate(rows) ** 2)) if any(map(len, rows)) else 0.0
