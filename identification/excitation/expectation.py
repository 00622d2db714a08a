"""What will be known of the parameters after a motion: the least squares of identify, before a robot moves."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from generator.errors import Place
from identification import recipes
from identification.dataset import Run
from identification.excitation.noise import Noise
from identification.factors import factors
from identification.least_squares import Problem, Solution
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.sampling import rows_of, sampled


def expected(
    motion: Motion, rate: float, regressors: Regressors, recipe: Recipe, values: Mapping[str, float], noise: Noise
) -> Solution:
    """Standard deviations that identification from a run of a ``motion`` is expected to have.

    Filters, decimation and rows near standstill are those of ``recipe`` at ``rate`` [Hz]; ``values`` are the
    parameters [SI] that the deviations are related to.
    """
    place, still = Place("designed"), np.zeros_like(motion.q)
    run = Run("designed", place, 0.0, 1 / rate, motion.q, still, warmth=motion.warmth)
    one = sampled(run, recipe, regressors)
    found = factors(rows_of(one, regressors))
    sigma = noise.deviations(one.filters.factor)
    weighted = recipe.weights == recipes.JOINT
    problem = Problem(found, regressors.names, {}, weighted, recipe.freedom == recipes.SAMPLES)
    return problem.foreseen(values, {factor.joint: float(s) for factor, s in zip(found, sigma, strict=True)})
