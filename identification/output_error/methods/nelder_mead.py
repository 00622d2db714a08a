"""The simplex of Nelder and Mead, as the report uses it: Lagarias et al., SIAM Journal on Optimization 9, 1998.

All joints count alike, parameters are not bounded, the first simplex has each parameter 5 % larger in turn. First
states are as measured. Where M(q) is not positive definite along the trajectory, or the simulation diverges, the
criterion is infinite.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from scipy.optimize import minimize

from identification.arrays import Array
from identification.output_error.search import Minimum, Search

SUMMARY = "the report's simplex of Nelder and Mead"

#: Iterations of the report (section 6.2).
_ITERATIONS = 3_000_000


def minimise(search: Search, start: Array) -> Minimum:
    """The best vertex from ``start`` (b) on, after the settings' iterations (3e6) or seconds."""
    criterion = search.criterion
    end = time.monotonic() + (search.settings.seconds or np.inf)

    def value(chi: Array) -> float:
        return criterion.value(criterion.begin(chi)) if search.positivity.holds(chi) else np.inf

    def called(intermediate_result: Any) -> None:
        if time.monotonic() > end:
            raise StopIteration

    most = search.settings.iterations or _ITERATIONS
    found = minimize(
        value, start, method="Nelder-Mead", callback=called, options={"maxiter": most, "maxfev": 10 * most}
    )
    best = found.x if found.fun <= value(start) else start
    point = criterion.begin(np.asarray(best, dtype=float))
    return Minimum(point, criterion, int(found.nfev) + 1, int(found.nit), bool(found.success))
