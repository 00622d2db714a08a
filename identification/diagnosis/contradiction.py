"""Values that were known beforehand and that the runs contradict: no effect is missing there, another value holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from generator.review.decimals import scientific
from generator.review.words import listed
from identification.diagnosis.loop import Search
from identification.diagnosis.normal import Prior, inverse

#: Standard deviations of what was known beyond which a value is another one, and how many are told by name.
_FAR, _NAMED = 5.0, 6


@dataclass(frozen=True)
class Contradicted:
    """A base parameter that the runs say is ``found``, where ``known`` +- ``std`` was stated [SI]."""

    name: str
    found: float
    known: float
    std: float

    @property
    def text(self) -> str:
        """``Fv1 14.1, not 7 +- 0.35``."""
        return f"{self.name} {scientific(self.found, 3)}, not {scientific(self.known, 3)} +- {scientific(self.std, 2)}"


def contradicted(found: Search, prior: Prior | None) -> tuple[Contradicted, ...]:
    """The base parameters that are farther from what was known than that and the runs leave uncertain, the farthest
    first.
    """
    if prior is None:
        return ()
    names = found.bank.base[: len(prior.mean)]
    before, after = np.diag(inverse(prior.precision)), np.diag(found.covariance)[: len(names)]
    values = np.array([found.values[name] for name in names])
    far = np.abs(values - prior.mean) / np.sqrt(np.where(prior.known, before + after, np.inf))
    return tuple(
        Contradicted(names[i], float(values[i]), float(prior.mean[i]), float(np.sqrt(before[i])))
        for i in np.argsort(-far).tolist()
        if far[i] > _FAR
    )


def note(ones: Sequence[Contradicted]) -> list[str]:
    """What is to be told of them."""
    if not ones:
        return []
    told = [one.text for one in ones[:_NAMED]]
    more = len(ones) - len(told)
    rest = [f"{more} more"] if more else []
    return [f"the runs contradict values that are known: {listed([*told, *rest])}; the new set has those of the runs"]
