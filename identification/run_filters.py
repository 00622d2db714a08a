"""The filters of one run, where it is long and fast enough for them, and what is to be told of both."""

from __future__ import annotations

from generator.errors import InputError
from generator.words import plural
from identification.dataset import Run
from identification.recipes import Filters, Recipe


def filters_of(run: Run, recipe: Recipe) -> Filters:
    """The recipe's filters at the run's rate.

    Raises InputError for a run that is sampled too slowly to hold the motion's dynamics, and for one with too few rows.
    """
    fast_enough(run, recipe)
    filters = recipe.at(run.rate)
    if run.samples < filters.fewest:
        problem = f"{plural(run.samples, 'row')} ({run.duration:.3g} s at {run.rate:.6g} Hz)"
        raise InputError(run.place, problem, f"at least {filters.fewest} for the filters")
    return filters


def fast_enough(run: Run, recipe: Recipe) -> None:
    """Raises InputError for a run that is sampled too slowly to hold the motion's dynamics."""
    if run.rate < recipe.slowest:
        problem = f"one sample in {run.period:.4g} s ({run.rate:.4g} Hz)"
        raise InputError(run.place, problem, f"at least {recipe.slowest:.3g} Hz; are the times in s?")


def notes_of(run: Run, recipe: Recipe) -> list[str]:
    """What is to be told of the run, and of a cut-off that its rate lowers."""
    cutoff = recipe.at(run.rate).cutoff
    if cutoff == recipe.wanted_cutoff:
        return [*run.notes]
    limit = f"the highest at {run.rate:.6g} Hz, not {recipe.wanted_cutoff:g} Hz"
    return [*run.notes, f"{run.name}: the cut-off is {cutoff:.6g} Hz, {limit}"]
