"""Groupings against the numerical rank of the reference's regressor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from random import Random

import numpy as np

from generator.reference.arithmetic import decimals
from tests.subject import Subject, Vector


def rank(W: Vector) -> int:
    """Number of independent columns, each first scaled to length one; the singular values must leave a gap."""
    size = np.linalg.norm(W, axis=0)
    shown = W[:, size > 1e-9 * max(size.max(initial=0.0), 1.0)]
    if not shown.size:
        return 0
    values = np.linalg.svd(shown / np.linalg.norm(shown, axis=0), compute_uv=False)
    independent = int((values > 1e-9 * values[0]).sum())
    assert independent == len(values) or values[independent] < 1e-12 * values[0], "the rank is not clear"
    return independent


def states(arm: Subject, columns: int) -> Iterator[tuple[Vector, Vector, Vector]]:
    """As many random states as show every column, and some."""
    for seed in range(100, 110 + 2 * columns // arm.dof):
        yield arm.state(seed)


def observed(arm: Subject, names: Sequence[str]) -> Vector:
    """The reference's regressor of the named standard parameters over random states."""
    random = Random(1)
    rows = []
    for state in states(arm, len(names)):
        beside = [[random.uniform(-1, 1) for _ in range(n)] for n in (len(arm.model.effect_states), arm.dof)]
        robot = replace(arm.rigid, states=tuple(decimals(beside[0])), warmth=decimals(beside[1]))
        rows.append(robot.regressor(names, *map(decimals, state)))
    return np.concatenate(rows).astype(float)


def check_grouping(arm: Subject) -> None:
    """Rank, columns and groupings against the reference's standard regressor."""
    W = observed(arm, arm.standard)
    column = dict(zip(arm.standard, W.T, strict=True))
    base = np.stack([column[head] for head in arm.heads], axis=1)
    assert rank(W) == rank(base) == len(arm.heads) == len(arm.model.base_parameters)

    tau = W @ [arm.values[name] for name in arm.standard]
    assert np.abs(base @ list(arm.base_values.values()) - tau).max() <= 1e-10 * np.abs(tau).max()

    eliminated = {one.name: one.into for one in arm.model.grouping.eliminated}
    assert sorted([*eliminated, *arm.heads]) == sorted(arm.standard)
    for name, into in eliminated.items():
        uses = tuple(one.name for one in arm.model.grouping.base if any(t == name for _, t in one.terms))
        assert into == uses
        assert bool(into) == (np.abs(column[name]).max() > 1e-9), name
