"""Standard deviations under coloured residuals: whole stretches of time are drawn, not rows.

Residuals of a robot are friction and compliance that the model lacks; neighbouring rows share them, and so do the
joints at one time. The covariance is that of estimates from runs put together of randomly drawn blocks, each with the
rows of all joints.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from identification.arrays import Array
from identification.least_squares import Problem, Solution
from identification.observed import Observed
from identification.rank import nonzero
from identification.sampling import Rows

#: Blocks that the runs are cut into at least, and their usual length [s].
_BLOCKS, _LENGTH = 20, 1.0


@dataclass
class _Block:
    """Normal equations of one stretch of time, in whitened parameters: ``G`` (r x r), ``g`` (r)."""

    G: Array
    g: Array


def bootstrapped(
    problem: Problem,
    solution: Solution,
    runs: Sequence[Observed],
    draws: int,
    rows: Callable[[Observed], Iterable[Rows]] = Observed.rows,
    seed: int = 1,
) -> Solution:
    """The solution with the covariance of ``draws`` estimates from blocks drawn with replacement of the runs' ``rows``.

    Blocks are a second long, shorter where the runs would have fewer than twenty. Hidden parameters stay so; what the
    rows show of their sums is drawn with the others. Where nothing is sought the solution stays as it is.
    """
    if not problem.names:
        return solution
    scales = problem.scales(solution.sigma)
    whitening = _whitening(problem, scales)
    blocks = list(_blocks(solution, scales, runs, rows, whitening).values())
    count = len(blocks)
    G = np.array([one.G for one in blocks])
    g = np.array([one.g for one in blocks])
    random = np.random.default_rng(seed)
    steps = np.empty((draws, whitening.shape[1]))
    for k in range(draws):
        times = np.bincount(random.integers(count, size=count), minlength=count).astype(float)
        steps[k] = np.linalg.lstsq(np.tensordot(times, G, 1), times @ g, rcond=1e-12)[0]
    return replace(solution, covariance=whitening @ np.atleast_2d(np.cov(steps, rowvar=False)) @ whitening.T)


def _whitening(problem: Problem, scales: Mapping[int, float]) -> Array:
    """T (p x r) with unit normal equations in the r steps that the rows show of the parameters, chi = T step."""
    stacked = [one.on(problem.names)[:, :-1] / scales[one.joint] for one in problem.factors]
    R = np.concatenate(stacked)
    size = np.linalg.norm(R, axis=0)
    scale = np.where(size > 0, size, 1.0)
    _, s, Vt = np.linalg.svd(R / scale, full_matrices=False)
    rank = int(nonzero(s).sum())
    return np.asarray(Vt[:rank].T / s[:rank] / scale[:, None])


def _blocks(
    solution: Solution,
    scales: Mapping[int, float],
    runs: Sequence[Observed],
    rows: Callable[[Observed], Iterable[Rows]],
    whitening: Array,
) -> dict[tuple[int, int], _Block]:
    """By run and number, all blocks of all runs."""
    duration = sum(run.sampled.motion.samples * run.sampled.run.period for run in runs)
    length = min(_LENGTH, duration / _BLOCKS)
    place = {name: k for k, name in enumerate(solution.names)}
    rank = whitening.shape[1]
    result: dict[tuple[int, int], _Block] = {}
    for index, run in enumerate(runs):
        for part in rows(run):
            error = part.errors(solution.values)
            mine = [k for k, name in enumerate(part.names) if name in place]
            Q = part.W[:, mine] @ whitening[[place[part.names[k]] for k in mine]] / scales[part.joint]
            numbers = ((part.t - run.sampled.run.start) / length).astype(int)
            for number in np.unique(numbers):
                inside = numbers == number
                block = result.setdefault((index, int(number)), _Block(np.zeros((rank, rank)), np.zeros(rank)))
                block.G += Q[inside].T @ Q[inside]
                block.g += Q[inside].T @ (error[inside] / scales[part.joint])
    return result
