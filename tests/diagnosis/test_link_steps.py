"""Links on drive trains with a gap: in it they fall freely, beyond it they swing; many at once are each by itself."""

from __future__ import annotations

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.link_steps import Link, Spring, played, torques_in_gaps

H, SAMPLES = 0.002, 1000
INERTIA = 4.0


def link(load: Array, inertia: Array) -> Link:
    return Link(load, load, inertia, np.gradient(inertia, H))


def constant(load: float) -> Link:
    return link(np.full(SAMPLES, load), np.full(SAMPLES, INERTIA))


def test_a_link_falls_freely_through_a_gap_and_lies_at_its_end() -> None:
    """M e'' = -load until e is at the gap's end, where the drive train carries the load."""
    load, half, k = 8.0, 0.05, 2e4
    e, speed, acceleration = played(constant(load), Spring(k, 150.0, half, H), (half, 0.0))
    rate = load / INERTIA
    t = H * np.arange(SAMPLES)
    falls = t < np.sqrt(4 * half / rate) - 2 * H
    # The first step begins from rest: half a sample later than in time.
    np.testing.assert_allclose(e[falls], half - rate * t[falls] * (t[falls] + H) / 2, atol=1e-12)
    np.testing.assert_allclose(speed[1:][falls[1:]], -rate * (t[1:][falls[1:]] + H / 2), atol=1e-10)
    np.testing.assert_allclose(acceleration[falls], -rate, atol=1e-8)
    np.testing.assert_allclose(e[-1], -half - load / k, rtol=1e-6)


def test_without_a_gap_a_link_swings_step_by_step() -> None:
    """As the module's first lines have it, written out, with a link whose inertia changes and that moves at first."""
    t = H * np.arange(SAMPLES)
    one = link(30 * np.sin(5 * t), INERTIA + np.sin(2 * t))
    smooth = one.load.copy()
    smooth[1:-1] += np.diff(one.load, 2) / 12
    k, d, e, speed = 9e3, 40.0, -2e-3, 0.07
    found = played(one._replace(smooth=smooth), Spring(k, d, 0.0, H), (e, speed))
    w = H * speed
    for i, (load, M, c) in enumerate(zip(smooth, one.inertia, one.drag, strict=True)):
        x = k * H**2 / M
        second = 1 + x / 12 + x**2 / 240
        slowed = (c + d) * H / (2 * M)
        after = (w * (1 - slowed) - (load + k * e) * H**2 / M / second) / (1 + slowed)
        expected = e, (w + after) / (2 * H), (after - w) / H**2 * second + (load - one.load[i]) / M
        np.testing.assert_allclose(found[:, i], expected, rtol=1e-7, atol=1e-9)
        e, w = e + after, after


def test_many_drive_trains_are_each_by_itself() -> None:
    """Links and springs of different kinds; damped well, so that how they bounce does not grow from rounding."""
    t = H * np.arange(SAMPLES)
    loads = np.stack([40 * np.sin(7 * t), 25 * np.cos(3 * t) + 10 * np.sin(11 * t)])
    inertias = np.stack([INERTIA + np.sin(2 * t), 2 * INERTIA - np.cos(4 * t)])
    links = [link(*one) for one in zip(loads, inertias, strict=True)]
    draw = np.random.default_rng(0)
    springs = Spring(
        draw.uniform(2e3, 2e4, (2, 5)), draw.uniform(150, 300, (2, 5)), draw.uniform(1e-4, 3e-3, (2, 5)), H
    )
    start = draw.normal(size=(2, 5)) * 1e-3, draw.normal(size=(2, 5)) * 1e-2
    together = Link(*(np.stack(each, axis=-1) for each in zip(*links, strict=True)))
    found = np.concatenate(list(torques_in_gaps(together, springs, start)))
    for s, one in enumerate(links):
        for k in range(5):
            spring = Spring(*(each[s, k] for each in springs[:3]), H)
            alone = one.inertia * played(one, spring, (start[0][s, k], start[1][s, k]))[2]
            np.testing.assert_allclose(found[:, s, k], alone, atol=1e-6 * np.abs(alone).max())
