"""The old model beside the new one on the runs that test: with swings where the new one has them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from identification.diagnosis.mending import before
from identification.diagnosis.mending.before import Before
from identification.diagnosis.runs.played import Played


def run(model: float) -> Played:
    t = 0.02 * np.arange(10)
    return Played(t, t[None], np.full((1, 10), model), np.ones((1, 10), dtype=bool))


def test_each_run_is_played_once_with_swings_and_once_without(monkeypatch: pytest.MonkeyPatch) -> None:
    made = []

    def play(one: float, player: Any, values: dict[str, float]) -> Played:
        made.append((one, *values.items()))
        return run(one * sum(values.values()))

    monkeypatch.setattr(before, "play", play)
    runs: Any = [1.0, 2.0]
    unsaid: Any = None
    old = Before(runs, unsaid, {"ZZ1": 5.0}, {"ZZ1": 7.0, "elasticity": 1.0})
    new = [run(0.5), run(0.6)]
    for swings, model in ((False, 5.0), (True, 8.0), (False, 5.0)):
        was, now = old.and_after(new, swings)
        assert [float(one.model[0, 0]) for one in was] == [model, 2 * model]
        assert [float(one.model[0, 0]) for one in now] == [0.5, 0.6]
    assert len(made) == 4
