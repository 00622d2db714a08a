"""Ripples and friction of two variables, looked for in what a fit leaves along a run that does not repeat."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.verdict.crossed import crossed
from identification.diagnosis.verdict.ripples import ripples

Array = NDArray[np.float64]

#: Rows a second, and the least speed [rad/s] of rows that count.
RATE, SLOW = 50.0, 0.05


def found(q: Array, left: Array) -> Any:
    """A search that ``left`` a residual (N) of white noise and more on joint 1 along a run of positions q (n x N)."""
    qd = np.gradient(q, 1 / RATE, axis=1)
    kept = np.abs(qd) > SLOW
    residual = np.stack([left, *np.zeros((len(q) - 1, len(left)))])
    bank = SimpleNamespace(
        dof=len(q),
        alone=(0,),
        robot=SimpleNamespace(numbers=range(1, len(q) + 1)),
        runs=[SimpleNamespace(rate=RATE, kept=kept, decimated=lambda x: x)],
        scenes=[SimpleNamespace(motion=SimpleNamespace(q=q, qd=qd))],
        residual=lambda r, k, weights, white=True: residual[k][kept[k]] if white else residual[k],
        whitened=lambda r, k, rows: rows[:, kept[k]],
        counts=lambda k: (int(kept[k].sum()), 1),
    )
    return SimpleNamespace(bank=bank)


def noise(count: int) -> Array:
    return 0.3 * np.random.default_rng(2).normal(size=count)


def moves(pause: float, speed: float, turns: int) -> Array:
    """Positions (N) of strokes of 1 rad up and down at a ``speed`` [rad/s] that differs a little, with pauses [s]."""
    q = []
    for turn in range(turns):
        stroke = np.linspace(0.0, 1.0, round(RATE / (speed * (1 + 0.02 * turn))))
        stroke = stroke if turn % 2 == 0 else stroke[::-1]
        q += [stroke, np.full(round(pause * RATE), stroke[-1])]
    return np.concatenate(q)


@pytest.mark.parametrize("pause", [0.0, 5.0, 20.0])
def test_pauses_make_no_ripple_finer(pause: float) -> None:
    q = moves(pause, 0.5, 10)
    told = ripples(found(q[None], noise(len(q)) + np.sin(2 * np.pi * q / 0.125)), {})
    assert told[0].length == pytest.approx(0.125, rel=0.02)
    assert not told[0].finer


def test_a_ripple_that_a_finer_one_looks_like_is_told_as_such() -> None:
    q = np.arange(1000) * 0.5 / RATE
    told = ripples(found(q[None], noise(len(q)) + np.sin(2 * np.pi * 63 * q)), {})
    assert told[0].finer
    assert told[0].or_finer == " or finer"


def test_a_joint_that_is_held_is_no_place() -> None:
    """It gives way a little under what it holds, which follows the other joint's place."""
    t = np.arange(3000) / RATE
    q = np.sin(0.7 * t) + 0.4 * np.sin(1.9 * t)
    held = 0.7 + 1e-5 * np.cos(q)
    left = noise(len(t)) + 0.3 * np.gradient(q, 1 / RATE) * q
    assert crossed(found(np.stack([q, held]), left), {})[0].follows == "its speed by its place"


def test_friction_by_the_place_of_another_joint_is_told() -> None:
    t = np.arange(3000) / RATE
    q, other = np.sin(0.7 * t) + 0.4 * np.sin(1.9 * t), np.sin(1.1 * t)
    left = noise(len(t)) + 0.3 * np.sign(np.gradient(q)) * other
    told = crossed(found(np.stack([q, other]), left), {})
    assert told[0].follows == "its direction by the place of joint 2"
    assert 0 not in crossed(found(np.stack([q, other]), noise(len(t))), {})
