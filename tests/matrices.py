"""Banks of the diagnosis on matrices that a test writes down, without a robot."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.whitening import Colour

Array = NDArray[np.float64]

#: Noise that is white already, of deviation 1.
WHITE = Colour((np.ones(1),), (1.0,))


#: Rows a second; rows after which nothing is left of how a process begins.
RATE, SETTLED = 50.0, 200


def run(W: Array, tau: Array, kept: NDArray[np.bool_] | None = None, period: int = 0) -> Any:
    """A run of one joint: base columns W (p x N), torque tau (N), rows that are ``kept`` (N, all if None)."""
    rows = np.ones(len(tau), dtype=bool) if kept is None else kept
    return SimpleNamespace(
        sampled=SimpleNamespace(motion=W[:, None, :]),
        t=np.arange(len(tau), dtype=float) / RATE,
        rate=RATE,
        factor=20,
        tau=tau[None],
        kept=rows[None],
        period=period,
        times=len(tau) / period if period and len(tau) >= 2 * period else 0.0,
        decimated=lambda x: x,
    )


def bank(runs: Sequence[Any]) -> Bank:
    """The runs' base columns and torques; a scene is its run's number and carries nothing."""
    names = tuple(f"p{i}" for i in range(len(runs[0].sampled.motion)))
    robot = SimpleNamespace(moving=(), flexible=(), effects=(), lengths=(), parameter_sets={})
    regressors = SimpleNamespace(names=names, structure=[names], base=lambda motion: [motion[:, 0]])
    regressors.model = SimpleNamespace(effects=())
    scenes: Any = [
        SimpleNamespace(
            regressors=regressors,
            robot=robot,
            number=r,
            motion=runs[r].sampled.motion,
            carried=lambda motion: np.zeros(motion.shape[1:]),
        )
        for r in range(len(runs))
    ]
    return Bank(runs, scenes)


def whitened(one: Bank) -> Bank:
    """With rows taken as white."""
    one.whiten([[WHITE] for _ in one.runs])
    return one


def process(law: Array, deviation: float, count: int, seed: int) -> Array:
    """Noise in its steady state (``count``), of which ``law`` (p + 1) leaves white noise of a ``deviation``."""
    drawn = np.random.default_rng(seed).normal(size=count + SETTLED)
    return np.asarray(lfilter([deviation], law, drawn)[SETTLED:])


def several(effect: str, coefficients: Sequence[Coefficient], columns: Sequence[Array]) -> Hypothesis:
    """An effect of several coefficients, each with its column in every run (runs x N)."""

    def of(scene: Any, shape: Mapping[str, float]) -> Array:
        return np.stack([column[scene.number] for column in columns])[:, None]

    return Hypothesis(effect, effect, 1, tuple(coefficients), of)


def hypothesis(
    effect: str,
    columns: Callable[[int, Mapping[str, float]], Array],
    shapes: Sequence[ShapeRange] = (),
    bounds: tuple[float | None, float | None] = (None, None),
) -> Hypothesis:
    """An effect of one coefficient whose column in run r is ``columns(r, shape)`` (N)."""

    def of(scene: Any, shape: Mapping[str, float]) -> Array:
        return columns(scene.number, shape)[None, None]

    return Hypothesis(effect, effect, 1, (Coefficient("c1", "1", *bounds),), of, shapes=tuple(shapes))


def variant(effect: str, coefficient: Coefficient, column: int, joint: int = 1, **told: Any) -> Variant:
    """A variant of one coefficient, in the ``column`` of a bank, whose torque nobody asks for.

    ``told`` are further fields of its hypothesis.
    """
    one = Hypothesis(effect, effect, joint, (coefficient,), lambda scene, shape: np.zeros((1, 1, 1)), **told)
    return Variant(one, {}, (column,), (joint - 1,), (0,))
