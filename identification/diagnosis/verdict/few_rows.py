"""Joints of which the runs have too few rows for what is known to act there: they do not tell noise from the model."""

from __future__ import annotations

from generator.review.words import listed
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.noise.may_act import counts, enough
from identification.diagnosis.search.loop import Search

#: Size of an effect, in parts of the noise's rms, from which it is named on such a joint.
_LEAST = 0.75


def few_rows(bank: Bank) -> dict[int, tuple[int, int]]:
    """Rows in all runs and base parameters that act, by coordinates of which the rows are too few."""
    result = {}
    for k in range(bank.dof):
        rows, model = counts(bank, k)
        if rows and not enough(rows, model):
            result[k] = rows, model
    return result


def notes(bank: Bank) -> list[str]:
    """What is to be told of such joints."""
    moving = bank.robot.moving
    said = [f"{rows} for {model} on joint {moving[k].number}" for k, (rows, model) in few_rows(bank).items()]
    if not said:
        return []
    return [
        f"rows are too few for the base parameters that act there, {listed(said)}: noise holds part of the model, and "
        "only what is about as large as noise is named"
    ]


def without_small(found: Search) -> Search:
    """The search without the choices that are small beside the noise of such joints."""
    few = few_rows(found.bank)
    kept = [
        one for one in found.choices if one.evidence.size >= _LEAST or set(few).isdisjoint(one.evidence.variant.joints)
    ]
    return found if len(kept) == len(found.choices) else found.keeping(kept)
