"""How a simulated motion follows changes of its first state, of parameters and of torques: sensitivities (eq. 64).

The direct model M qdd = tau - H gives, with the inverse model ID linear in the base parameters, ID = W(q, qd, qdd) chi,

    M d(qdd) = d(tau) - (dID/dq) dq - (dID/dqd) dqd - W d(chi)

Derivatives of ID are finite differences of the generated inverse dynamics over all samples at once. A joint that is
stuck has d(qdd) = 0. Where a joint's speed passes zero its friction jumps, and so do the speeds' variations: with
accelerations qdd- before and qdd+ after, d(qd)+ = d(qd)- + (qdd+ - qdd-) d(qd_j)- / qdd_j- (the saltation of a motion
with events, Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004, chapter 7).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.output_error.open_loop import SimulatedMotion

#: Steps of the finite differences of positions and speeds [rad, m; rad/s, m/s].
_OF_Q, _OF_QD = 1e-5, 1e-5
#: Acceleration [rad/s2, m/s2] below which a joint passes zero too slowly for its event to be told.
_SLOW = 1e-9


@dataclass(frozen=True)
class Variations:
    """x' = F x + G d(chi) + B d(tau) of x = [dq; dqd], in steps of ``step`` [s] over S segments of K samples.

    ``transition`` (S x K-1 x 2n x 2n) leads from each sample to the next, ``driven`` (S x K-1 x 2n x b) is what unit
    changes of parameters add, ``inverse`` (S x K x n x n) is B's lower half, M^-1 of the joints that move.
    """

    step: float
    transition: Array
    driven: Array
    inverse: Array

    def forward(self) -> Array:
        """Derivatives of q (S x K x n x (2n + b)) by the first state and the parameters, at all samples.

        They are not finite where an unstable motion makes them grow beyond all numbers.
        """
        segments, steps, size, b = self.driven.shape
        x = np.zeros((segments, size, size + b))
        x[:, :, :size] = np.eye(size)
        result = np.empty((segments, steps + 1, size // 2, size + b))
        result[:, 0] = x[:, : size // 2]
        with np.errstate(over="ignore", invalid="ignore"):
            for k in range(steps):
                x = self.transition[:, k] @ x
                x[:, :, size:] += self.driven[:, k]
                result[:, k + 1] = x[:, : size // 2]
        return result

    def backward(self, weights: Array) -> Array:
        """Derivatives (S x K x c x n) of sums over q by an impulse of torque [N m s, N s] at each sample.

        The c sums are sum_k weights_k^T dq_k with ``weights`` (S x K x n x c).
        """
        segments, steps, size, _ = self.driven.shape
        n = size // 2
        adjoint = np.zeros((segments, size, weights.shape[-1]))
        result = np.empty((segments, steps + 1, weights.shape[-1], n))
        for k in range(steps, -1, -1):
            adjoint[:, :n] += weights[:, k]
            result[:, k] = adjoint[:, n:].transpose(0, 2, 1) @ self.inverse[:, k]
            if k:
                adjoint = self.transition[:, k - 1].transpose(0, 2, 1) @ adjoint
        return result


def variations(model: Any, motion: SimulatedMotion, step: float, columns: NDArray[np.int64]) -> Variations:
    """Of a simulated ``motion``; ``columns`` (b) are the base parameters that vary, ``model`` has all their values."""
    segments, samples, n = motion.q.shape
    q, qd, tau = (np.ascontiguousarray(x.reshape(-1, n)) for x in (motion.q, motion.qd, motion.tau))
    inertia = mass_matrix(model, q)
    stuck = qd == 0.0
    moving = ~stuck
    inertia = np.where(moving[:, :, None] & moving[:, None, :], inertia, np.eye(n))
    inverse = np.linalg.inv(inertia) * moving[:, None, :]
    torque = tau - model.inverse_dynamics(q, qd, np.zeros_like(q))
    qdd = np.ascontiguousarray((inverse @ torque[:, :, None])[:, :, 0])
    F = np.zeros((len(q), 2 * n, 2 * n))
    F[:, :n, n:] = np.eye(n)
    F[:, n:, :n] = -inverse @ _by_position(model, q, qd, qdd)
    F[:, n:, n:] = -inverse @ _by_speed(model, q, qd, qdd)
    W = model.observation_matrix(q, qd, qdd).reshape(len(q), n, -1)[:, :, columns]
    G = np.zeros((len(q), 2 * n, len(columns)))
    G[:, n:] = -inverse @ W
    shape = (segments, samples)
    F, G, inverse, qdd = (x.reshape(*shape, *x.shape[1:]) for x in (F, G, inverse, qdd))
    transition = _heun(F, step)
    driven = step / 2 * (G[:, :-1] + G[:, 1:] + step * F[:, 1:] @ G[:, :-1])
    for (segment, k), events in _events(motion.qd, qdd, step).items():
        at = (segment, slice(k, k + 2))
        transition[segment, k], driven[segment, k] = _through(events, F[at], G[at], qdd[at], step)
    return Variations(step, transition, driven, inverse)


def mass_matrix(model: Any, q: Array) -> Array:
    """M(q) (N x n x n) at positions (N x n), by the generated inverse dynamics over all samples at once."""
    still = np.zeros_like(q)
    rest = model.inverse_dynamics(q, still, still)
    result = np.empty((*q.shape, q.shape[1]))
    for j in range(q.shape[1]):
        result[:, :, j] = model.inverse_dynamics(q, still, _moved(still, j, 1.0)) - rest
    return result


def _heun(F: Array, step: float) -> Array:
    """Transition matrices of x' = F x by Heun's method (order 2)."""
    identity: Array = np.eye(F.shape[-1])
    result: Array = identity + step / 2 * (F[:, :-1] + F[:, 1:] + step * F[:, 1:] @ F[:, :-1])
    return result


def _by_position(model: Any, q: Array, qd: Array, qdd: Array) -> Array:
    """dID/dq (N x n x n)."""
    columns = [
        (model.inverse_dynamics(_moved(q, j, _OF_Q), qd, qdd) - model.inverse_dynamics(_moved(q, j, -_OF_Q), qd, qdd))
        / (2 * _OF_Q)
        for j in range(q.shape[1])
    ]
    return np.stack(columns, axis=-1)


def _by_speed(model: Any, q: Array, qd: Array, qdd: Array) -> Array:
    """dID/dqd (N x n x n); speeds are moved away from zero, so that no sign(qd) changes."""
    here = model.inverse_dynamics(q, qd, qdd)
    columns = []
    for j in range(q.shape[1]):
        by = np.where(qd[:, j] < 0, -_OF_QD, _OF_QD)
        columns.append((model.inverse_dynamics(q, _moved(qd, j, by), qdd) - here) / by[:, None])
    return np.stack(columns, axis=-1)


def _moved(x: Array, j: int, by: float | Array) -> Array:
    result = x.copy()
    result[:, j] += by
    return result


def _events(qd: Array, qdd: Array, step: float) -> dict[tuple[int, int], list[tuple[float, int, bool]]]:
    """By segment and step, where a joint's speed passes or reaches zero: part of the step before it, joint, whether it
    sticks; in order.
    """
    sign = np.sign(qd)
    result: dict[tuple[int, int], list[tuple[float, int, bool]]] = {}
    for segment, k, j in np.argwhere((sign[:, :-1] != 0) & (sign[:, 1:] != sign[:, :-1])).tolist():
        way = -qdd[segment, k, j] * step
        part = float(np.clip(qd[segment, k, j] / way, 0.0, 1.0)) if abs(way) > _SLOW else 0.5
        result.setdefault((segment, k), []).append((part, j, sign[segment, k + 1, j] == 0))
    return {place: sorted(events) for place, events in result.items()}


def _through(events: list[tuple[float, int, bool]], F: Array, G: Array, qdd: Array, step: float) -> tuple[Array, Array]:
    """Transition and what parameters add over a step with events, from values before and after (2 x ...)."""
    size = F.shape[-1]
    transition, driven = np.eye(size), np.zeros_like(G[0])
    done = 0.0
    for part, j, sticks in events:
        flow = (part - done) * step
        jump = _jump(j, sticks, qdd)
        transition = jump @ (transition + flow * F[0] @ transition)
        driven = jump @ (driven + flow * (F[0] @ driven + G[0]))
        done = part
    flow = (1 - done) * step
    return transition + flow * F[1] @ transition, driven + flow * (F[1] @ driven + G[1])


def _jump(j: int, sticks: bool, qdd: Array) -> Array:
    """What the variations do where joint j's speed is zero: ones but for its column."""
    n = qdd.shape[-1]
    before, after = qdd
    result: Array = np.eye(2 * n)
    if abs(before[j]) >= _SLOW:
        result[n:, n + j] += np.clip((after - before) / before[j], -1.0, 1.0)
        result[n + j, n + j] = np.clip(after[j] / before[j], 0.0, 1.0)
    if sticks:
        result[n + j, n + j] = 0.0
    return result
