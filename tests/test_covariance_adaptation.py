"""The search by covariance matrix adaptation."""

from __future__ import annotations

import numpy as np

from identification.covariance_adaptation import strategy


def asked(draw: np.random.Generator | np.random.RandomState) -> np.ndarray:
    """All points of a short search for the least sum of squares."""
    search = strategy(np.ones(4), 0.3, draw, popsize=8)
    points = []
    for _ in range(5):
        points.append(np.array(search.ask()))
        search.tell(list(points[-1]), (points[-1] ** 2).sum(axis=1).tolist())
    return np.concatenate(points)


def test_the_draw_alone_decides_the_search() -> None:
    for kind in (np.random.default_rng, np.random.RandomState):
        np.random.seed(3)
        first = asked(kind(0))
        after = np.random.random()
        np.random.seed(3)
        assert np.random.random() == after, "the search drew from NumPy's own state, or seeded it"
        assert (asked(kind(0)) == first).all()
        assert (asked(kind(1)) != first).all()
