"""Covariance matrix adaptation (CMA-ES), a search that needs no derivatives, by the package cma.

Hansen, The CMA evolution strategy: a tutorial, arXiv 1604.00772.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from identification.arrays import Array


def strategy(start: Array, step: float, draw: np.random.Generator | np.random.RandomState, **options: object) -> Any:
    """cma's strategy from ``start`` (n) on with a first ``step`` in every direction; silent, with ``options`` of its.

    All that it draws is drawn from ``draw``, so that the same state of it gives the same search.
    """
    with warnings.catch_warnings():
        # It misses matplotlib, which only its own plots need.
        warnings.simplefilter("ignore")
        from cma import CMAEvolutionStrategy

    # By a seed of its own it would set that of all NumPy, and by zero the clock's.
    own = {"verbose": -9, "seed": np.nan, "randn": lambda *size: draw.normal(size=size)}
    return CMAEvolutionStrategy(start, step, own | options)
