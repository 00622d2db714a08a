"""Covariance matrix adaptation, a search that does not need to begin near the minimum, then Gauss-Newton to its end."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from identification.arrays import Array
from identification.covariance_adaptation import strategy
from identification.output_error.methods import gauss_newton
from identification.output_error.search import Minimum, Search

SUMMARY = "covariance matrix adaptation, then Gauss-Newton"

#: Generations, where neither they nor seconds are given.
_GENERATIONS = 100


def minimise(search: Search, start: Array) -> Minimum:
    """The minimum found from ``start`` (b) on; its first step is the settings' spread, in standard deviations."""
    settings, criterion = search.settings, search.criterion
    errors = criterion.errors(criterion.begin(start))
    # Where the simulation diverges from the start its errors are no scale.
    if search.weighted and np.isfinite(criterion.sum(errors)):
        criterion = criterion.weighted(errors)
    end = time.monotonic() + (settings.seconds or np.inf)
    most = settings.iterations or (_GENERATIONS if settings.seconds is None else 10**9)
    draw = np.random.RandomState(np.random.MT19937(np.random.SeedSequence(settings.seed)))
    evolution = strategy(np.zeros(len(start)), settings.spread, draw, maxiter=most)
    best, least, generations = start, criterion.value(criterion.begin(start)), 0
    while not evolution.stop() and time.monotonic() < end:
        asked = evolution.ask()
        values = []
        for one in asked:
            chi = start + search.std * one
            value = criterion.value(criterion.begin(chi)) if search.positivity.holds(chi) else np.inf
            values.append(value)
            if value < least:
                best, least = chi, value
        generations += 1
        # What is not allowed is worst; the strategy orders values and does not take infinite ones.
        worst = max([one for one in values if np.isfinite(one)], default=0.0)
        evolution.tell(asked, [one if np.isfinite(one) else 2 * worst + 1 for one in values])
    polish = replace(search, settings=replace(settings, iterations=None, seconds=None))
    found = gauss_newton.minimise(polish, best)
    simulations = found.simulations + int(evolution.countevals) + 1
    return replace(found, simulations=simulations, iterations=found.iterations + generations)
