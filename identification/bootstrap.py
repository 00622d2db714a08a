"""Standard deviations under coloured residuals: whole stretches of time are drawn, not rows.

Residuals of a robot are friction and compliance that the model lacks; neighbouring rows share them, and so do the
joints at one time. The covariance is that of estimates from runs put together of randomly drawn blocks, each with the
rows of all joints.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from identification.least_squares import Problem, Solution
from identification.observed import Observed

Array = NDArray[np.float64]

#: Blocks that the runs are cut into at least, and their usual length [s].
_BLOCKS, _LENGTH = 20, 1.0


@dataclass
class _Block:
    """Normal equations of one stretch of time, in whitened parameters: ``G`` (p x p), ``g`` (p)."""

    G: Array
    g: Array


def bootstrapped(problem: Problem, solution: Solution, runs: Sequence[Observed], draws: int, seed: int = 1) -> Solution:
    """The solution with the covariance of ``draws`` estimates from blocks drawn with replacement.

    Blocks are a second long, shorter where the runs would have fewer than twenty. Hidden parameters stay so.
    """
    seen = [name for name in problem.names if name not in solution.hidden]
    whitening = _whitening(problem, solution, seen)
    blocks = list(_blocks(solution, runs, seen, whitening).values())
    count = len(blocks)
    G = np.array([one.G for one in blocks])
    g = np.array([one.g for one in blocks])
    random = np.random.default_rng(seed)
    steps = np.empty((draws, len(seen)))
    for k in range(draws):
        times = np.bincount(random.integers(count, size=count), minlength=count).astype(float)
        steps[k] = np.linalg.lstsq(np.tensordot(times, G, 1), times @ g, rcond=1e-12)[0]
    spread = whitening @ np.cov(steps, rowvar=False).reshape(len(seen), len(seen)) @ whitening.T
    covariance = np.zeros_like(solution.covariance)
    places = [problem.names.index(name) for name in seen]
    covariance[np.ix_(places, places)] = spread
    return replace(solution, covariance=covariance)


def _whitening(problem: Problem, solution: Solution, seen: Sequence[str]) -> Array:
    """T (p x p) with unit normal equations in the parameters T^-1 chi."""
    R = np.concatenate([one.on(seen)[:, :-1] / solution.sigma[one.joint] for one in problem.factors])
    size = np.linalg.norm(R, axis=0)
    return np.asarray(np.linalg.inv(np.linalg.qr(R / size, mode="r")) / size[:, None], dtype=float)


def _blocks(
    solution: Solution, runs: Sequence[Observed], seen: Sequence[str], whitening: Array
) -> dict[tuple[int, int], _Block]:
    """By run and number, all blocks of all runs."""
    duration = sum(run.sampled.motion.samples * run.sampled.run.period for run in runs)
    length = min(_LENGTH, duration / _BLOCKS)
    place = {name: k for k, name in enumerate(seen)}
    values: Mapping[str, float] = solution.values
    result: dict[tuple[int, int], _Block] = {}
    for index, run in enumerate(runs):
        for part in run.rows():
            error = part.Y - part.W @ np.array([values[name] for name in part.names])
            mine = [k for k, name in enumerate(part.names) if name in place]
            Q = part.W[:, mine] @ whitening[[place[part.names[k]] for k in mine]] / solution.sigma[part.joint]
            numbers = ((part.t - run.sampled.run.start) / length).astype(int)
            for number in np.unique(numbers):
                inside = numbers == number
                key = index, int(number)
                block = result.setdefault(key, _Block(np.zeros((len(seen),) * 2), np.zeros(len(seen))))
                block.G += Q[inside].T @ Q[inside]
                block.g += Q[inside].T @ (error[inside] / solution.sigma[part.joint])
    return result
