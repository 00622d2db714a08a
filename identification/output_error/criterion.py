"""The criterion: squared errors of the simulated positions (report eq. 61), by parameters and first states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.output_error.experiment import Experiment
from identification.output_error.open_loop import OpenLoop
from identification.output_error.variations import Variations, variations

#: Damping that keeps what no position shows of a first state where it is.
_HELD = 1e-9
#: Smallest weight's residual [rad, m]: that of a simulation in steps.
_FLOOR = 1e-7


@dataclass(frozen=True)
class Point:
    """Values of the ``sought`` parameters (b) and of all segments' first states, an array (S x 2n) an experiment."""

    chi: Array
    states: tuple[Array, ...]


@dataclass(frozen=True)
class Linearised:
    """The criterion about a point: errors and their derivatives, experiment by experiment.

    ``errors`` (S x K x n) [rad, m] are measured less simulated positions, ``slopes`` (S x K x n x (2n + b)) the
    derivatives of the simulated ones by first state and parameters, ``sensitivity`` what they come from.
    """

    errors: tuple[Array, ...]
    slopes: tuple[Array, ...]
    sensitivity: tuple[Variations, ...]


@dataclass(frozen=True)
class Reduced:
    """Normal equations of the parameters alone, first states eliminated segment by segment.

    ``H`` (b x b) and ``g`` (b) are those of min |e - S d|^2; ``follow`` gives the states' steps (S x 2n) for a step of
    the parameters: own - by_chi d.
    """

    H: Array
    g: Array
    own: tuple[Array, ...]
    by_chi: tuple[Array, ...]

    def follow(self, step: Array) -> tuple[Array, ...]:
        """Steps of the first states (S x 2n each) that go with a step (b) of the parameters."""
        return tuple(own - by @ step for own, by in zip(self.own, self.by_chi, strict=True))


@dataclass(frozen=True)
class Normal:
    """Normal equations A x = y (S x (2n + b)) of each experiment's segments, b parameters last in x.

    With each come the curvatures (2n) that first states have where nothing but inertia acts on them.
    """

    parts: tuple[tuple[Array, Array, Array], ...]
    b: int

    @property
    def finite(self) -> bool:
        """Whether the sensitivities have not grown beyond all numbers."""
        return all(bool(np.isfinite(A).all()) for A, _, _ in self.parts)

    def reduced(self, damping: float = 0.0) -> Reduced:
        """For the parameters alone; first states are damped in parts of their curvatures without friction.

        A state that friction brings to rest has next to no curvature of its own: dampings in parts of that would let it
        go anywhere.
        """
        H, g = np.zeros((self.b, self.b)), np.zeros(self.b)
        own, by_chi = [], []
        for A, y, free in self.parts:
            size = len(free)
            states = A[:, :size, :size] + (damping + _HELD) * np.diag(free)
            follow = np.linalg.solve(states, np.concatenate([y[:, :size, None], A[:, :size, size:]], axis=-1))
            H += (A[:, size:, size:] - A[:, size:, :size] @ follow[:, :, 1:]).sum(axis=0)
            g += (y[:, size:] - (A[:, size:, :size] @ follow[:, :, :1])[:, :, 0]).sum(axis=0)
            own.append(follow[:, :, 0])
            by_chi.append(follow[:, :, 1:])
        return Reduced((H + H.T) / 2, g, tuple(own), tuple(by_chi))


@dataclass(frozen=True)
class Criterion:
    """Sum of squared position errors of all experiments, joint k's in units of ``scale`` [rad, m] (n).

    ``module`` is the robot's compiled Python module, ``sought`` are the parameters that vary, ``fixed`` the values [SI]
    of the others.
    """

    module: Any
    experiments: tuple[Experiment, ...]
    sought: tuple[str, ...]
    fixed: Mapping[str, float]
    scale: Array

    @cached_property
    def columns(self) -> NDArray[np.int64]:
        """Places (b) of the sought parameters among the base parameters."""
        return np.array([self.module.BASE_PARAMETERS.index(name) for name in self.sought], dtype=int)

    def values(self, chi: Array) -> dict[str, float]:
        """All parameters [SI] by name, the sought ones ``chi`` (b)."""
        return {**self.fixed, **dict(zip(self.sought, chi.tolist(), strict=True))}

    def loop(self, chi: Array) -> OpenLoop:
        """The open loop with the sought parameters ``chi`` (b)."""
        return OpenLoop(self.module, self.values(chi))

    def begin(self, chi: Array) -> Point:
        """The point with parameters ``chi`` (b) and first states as measured."""
        return Point(chi, tuple(one.start for one in self.experiments))

    def errors(self, point: Point) -> tuple[Array, ...]:
        """Measured less simulated positions (S x K x n) [rad, m] of each experiment."""
        loop = self.loop(point.chi)
        return tuple(one.q - loop.run(one, start).q for one, start in zip(self.experiments, point.states, strict=True))

    def value(self, point: Point) -> float:
        """The criterion; infinite where the simulation diverges."""
        return self.sum(self.errors(point))

    def sum(self, errors: Sequence[Array]) -> float:
        """The criterion of errors (S x K x n) [rad, m] of each experiment."""
        with np.errstate(over="ignore"):
            total = sum(float(((one / self.scale) ** 2).sum()) for one in errors)
        return total if np.isfinite(total) else np.inf

    def linearised(self, point: Point) -> Linearised:
        """Errors and sensitivities at a point where the simulation does not diverge."""
        loop = self.loop(point.chi)
        errors, slopes, found = [], [], []
        for one, start in zip(self.experiments, point.states, strict=True):
            motion = loop.run(one, start)
            varied = variations(loop.model, motion, one.step, self.columns)
            errors.append(one.q - motion.q)
            slopes.append(varied.forward())
            found.append(varied)
        return Linearised(tuple(errors), tuple(slopes), tuple(found))

    def normal(self, at: Linearised) -> Normal:
        """Normal equations about a point, in units of ``scale``."""
        parts = []
        for one, e, S in zip(self.experiments, at.errors, at.slopes, strict=True):
            rows = (S / self.scale[:, None]).reshape(len(S), -1, S.shape[-1])
            turned = rows.transpose(0, 2, 1)
            with np.errstate(over="ignore", invalid="ignore"):
                A, y = turned @ rows, (turned @ (e / self.scale).reshape(len(e), -1, 1))[:, :, 0]
            samples, last = e.shape[1], e.shape[1] * one.step
            own = samples / self.scale**2
            parts.append((A, y, np.concatenate([own, own * last**2 / 3])))
        return Normal(tuple(parts), len(self.sought))

    def weighted(self, errors: Sequence[Array]) -> Criterion:
        """The same with each joint's rms of these errors (S x K x n) [rad, m] as its scale."""
        square = sum((one**2).sum(axis=(0, 1)) for one in errors)
        count = sum(one.shape[0] * one.shape[1] for one in errors)
        return replace(self, scale=np.maximum(np.sqrt(square / count), _FLOOR))
