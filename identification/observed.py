"""Runs turned into rows, kept while they are few, computed anew while they are many."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from identification.factors import Factor, factors
from identification.observation import Regressors
from identification.sampling import Rows, Sampled, rows_of

#: Bytes of rows of one run that are kept.
_KEPT = 1 << 27


class Observed:
    """The rows of one run and their factors."""

    def __init__(self, sampled: Sampled, regressors: Regressors) -> None:
        self.sampled = sampled
        self._regressors = regressors
        self._cache: list[Rows] | None = None

    def rows(self) -> Iterator[Rows]:
        """All rows, in parts, joint by joint."""
        if self._cache is not None:
            yield from self._cache
            return
        cache: list[Rows] | None = []
        size = 0
        for part in rows_of(self.sampled, self._regressors):
            size += part.W.nbytes
            if cache is not None:
                cache.append(part)
            if size > _KEPT:
                cache = None
            yield part
        self._cache = cache

    @cached_property
    def factors(self) -> tuple[Factor, ...]:
        """One triangular factor a joint."""
        return factors(self.rows())
