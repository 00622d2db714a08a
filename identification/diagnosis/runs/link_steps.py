"""A link on its drive train, sample by sample: M e'' + (c + d) e' + k z = -load, with M its inertia, c its drag, and z
what its deflection e is beyond the gap of the drive train; d acts beyond the gap alone.

To the first order in 1/k and without a gap e is -load/k, but that holds far below the resonance alone. Without a gap by
Numerov's method: the frequency of a swing is right to 1e-4 at eight samples a period. With one by central differences,
which keep the momentum of impacts. Damping is centred. With w the way from the sample before to this one, the next is

    w' = slowed (2 w - pull z - push) - w,  e' = e + w'
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any, NamedTuple, TypeAlias

import casadi
import numpy as np

from identification.arrays import Array
from identification.recursion import recursion

#: A number, or an array of as many as are played at once.
Value: TypeAlias = Any

#: k h^2 / M up to which the differences swing and do not grow: where it is 4 times ``_second``, and 4 with a gap.
STABLE, STABLE_IN_GAPS = 20 - np.sqrt(160), 4.0
#: Steps that are one for the interpreter.
_STEPS = 25


class Link(NamedTuple):
    """What a step takes of a link, sample by sample: its ``load`` [N m, N], that smoothed as Numerov's method has it,
    ``inertia`` [kg m2, kg] and ``drag`` [N m s/rad, N s/m].
    """

    load: Value
    smooth: Value
    inertia: Value
    drag: Value


class Spring(NamedTuple):
    """What a step takes of a drive train: ``stiffness`` [N m/rad, N/m], ``damping`` [N m s/rad, N s/m], ``half`` of its
    gap [rad, m]; and the samples' ``period`` [s].
    """

    stiffness: Value
    damping: Value
    half: Value
    period: float


def played(link: Link, spring: Spring, start: tuple[float, float]) -> Array:
    """Deflection [rad, m], its speed and its acceleration (3 x N) from a ``start`` (e, e') on one drive train; of two
    samples or more.
    """
    h, first = spring.period, spring.period * start[1]
    e, second, beside = (_in_gap if spring.half else _held)(link, spring, start[0], first)
    after = np.diff(e)
    before = np.concatenate([[first], after[:-1]])
    return np.stack([e[:-1], (before + after) / (2 * h), (after - before) * (second / (h * h)) + beside])


def torques_in_gaps(links: Link, springs: Spring, start: tuple[Array, Array]) -> Iterator[Array]:
    """Inertia times acceleration [N m, N] of S links (N x S each), each on K drive trains (S x K) with gaps, some
    samples at a time (... x S x K); from a ``start`` (e, e') (S x K each).
    """
    h, ends = springs.period, (-springs.half, springs.half)
    e, w = start[0], h * start[1]
    for first in range(0, len(links.load), _STEPS):
        link = Link(*(each[first : first + _STEPS, :, None] for each in links))
        # Broadcast once for all steps: at each it would take longer than the step.
        rates = [np.ascontiguousarray(one) for one in np.broadcast_arrays(*_in_gaps(link, springs))]
        ways = np.empty((len(link.load) + 1, *e.shape))
        ways[0] = w
        for after, *now in zip(ways[1:], *rates, strict=True):
            w = _next(e, w, now, ends, np, np.where)
            e = e + w
            after[:] = w
        yield np.diff(ways, axis=0) * (link.inertia / (h * h))


def _held(link: Link, spring: Spring, e: float, w: float) -> tuple[Array, Array, Array]:
    """Deflections (N + 1) on a drive train without a gap, of which a way is the difference of two; their second
    derivative in parts of the second difference, and what comes to it beside.
    """
    second = _second(spring.stiffness * (spring.period**2 / link.inertia))
    slowed, pull, push = _slowed(link, spring, spring.damping), *_pulled(link, link.smooth, spring)
    last, before_last, summands = slowed * (2 - pull / second), 1 - 2 * slowed, -slowed * push / second
    summands[0] += last[0] * e + before_last[0] * (e - w)
    summands[1] += before_last[1] * e
    deflections = np.concatenate([[e], recursion([last, before_last], summands)])
    return deflections, second, (link.smooth - link.load) / link.inertia


def _in_gap(link: Link, spring: Spring, e: float, w: float) -> tuple[Array, Array, Array]:
    """The same on a drive train with a gap."""
    samples = len(link.load)
    count = -(-samples // _STEPS)
    rates = np.pad(np.stack(_in_gaps(link, spring)), ((0, 0), (0, count * _STEPS - samples)), mode="edge")
    _, after = _many_steps(count)([e, w], rates, np.full(count, spring.half)[None])
    return np.concatenate([[e], np.asarray(after)[0, :samples]]), np.ones(1), np.zeros(1)


def _in_gaps(link: Link, spring: Spring) -> tuple[Value, Value, Value, Value]:
    """What ``_next`` takes: how a way is slowed within a gap and beyond it, what pulls and what pushes."""
    return _slowed(link, spring, 0.0), _slowed(link, spring, spring.damping), *_pulled(link, link.load, spring)


def _slowed(link: Link, spring: Spring, damping: Value) -> Value:
    """1 / (1 + (c + d) h / (2 M))."""
    twice = 2 * link.inertia
    return twice / ((twice + spring.period * link.drag) + spring.period * damping)


def _pulled(link: Link, load: Value, spring: Spring) -> tuple[Value, Value]:
    """Ways by a drive train's deflection and by a load in the square of a period."""
    per_torque = spring.period**2 / link.inertia
    return spring.stiffness * per_torque, load * per_torque


def _next(e: Value, w: Value, rates: Sequence[Value], ends: tuple[Value, Value], of: Any, choose: Any) -> Value:
    """The way after ``w``. The library ``of`` its values has fmax and fmin; ``choose`` takes one of two."""
    within, beyond, pull, push = rates
    nearest = of.fmin(of.fmax(e, ends[0]), ends[1])
    return choose(e != nearest, beyond, within) * (w + w - pull * (e - nearest) - push) - w


def _second(x: Array) -> Array:
    """The second derivative of a swing in parts of its second difference, (y / sin y)^2 with y = sqrt(x) / 2."""
    return 1 + x / 12 * (1 + x / 20)


@cache
def _many_steps(count: int) -> casadi.Function:
    """``count`` times ``_STEPS`` steps in a gap one after the other: of the first (e, w), rates and half the gap."""
    state, rates, half = (casadi.SX.sym(name, *size) for name, *size in (("x", 2), ("rates", 4, _STEPS), ("half", 1)))
    e, w, after = *casadi.vertsplit(state), []
    for each in casadi.horzsplit(rates):
        w = _next(e, w, casadi.vertsplit(each), (-half, half), casadi, casadi.if_else)
        e = e + w
        after.append(e)
    steps = casadi.Function("steps", [state, rates, half], [casadi.vertcat(e, w), casadi.horzcat(*after)])
    return steps.mapaccum("all", count)
