"""A residual is found over what made it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import sympy
from numpy.typing import NDArray

from generator.robot.description import REVOLUTE, Joint
from identification.diagnosis.columns.whitening import Colour
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.verdict.views import View, strongest, views
from tests.diagnosis.diagnosed_arm import ready, recorded, torque
from tests.matrices import WHITE

Array = NDArray[np.float64]

COUNT, RATE = 6000, 50.0


def test_time_is_that_since_the_recording_began(tmp_path: Path) -> None:
    """Parts of one recording come one after the other."""
    regressors, (source,) = recorded(tmp_path, [torque("")])
    first, second = (ready(f"{source}@{part}", regressors).sampled for part in ("0:15", "20:35"))
    for one, begins in ((first, 0.0), (second, 20.0)):
        t = Scene(one, regressors, {}).t
        assert t == pytest.approx(one.times)
        assert begins <= t[0] < begins + 2


class Seen:
    """A motion of one joint, and what a residual may be made of."""

    def __init__(self) -> None:
        t = np.arange(COUNT) / RATE
        draw = np.random.default_rng(1)
        self.t = t
        self.q, self.qd, self.qdd = np.zeros((3, COUNT))
        for k in (3, 7, 11, 17, 24):
            w, (a, b) = 2 * np.pi * k / t[-1], draw.normal(size=2) / np.sqrt(k)
            self.q += a * np.sin(w * t) + b * np.cos(w * t)
            self.qd += w * (a * np.cos(w * t) - b * np.sin(w * t))
            self.qdd -= w**2 * (a * np.sin(w * t) + b * np.cos(w * t))
        # Weight that depends on another joint too, so that it is no function of q.
        self.load = 200 * np.cos(self.q + 1.5 * np.sin(2 * np.pi * 13.3 * t / t[-1]))
        self.phase = 33.7 * self.q

    def scene(self) -> tuple[Any, Any]:
        motion = SimpleNamespace(q=self.q[None], qd=self.qd[None], qdd=self.qdd[None])
        joint = Joint(1, 0, REVOLUTE, *[sympy.S.Zero] * 4)
        robot = SimpleNamespace(moving=[joint], drives=SimpleNamespace(coupling=[[33.7]]))
        scene = SimpleNamespace(motion=motion, robot=robot, load=self.load[None], t=self.t, period=1 / RATE)
        run = SimpleNamespace(kept=np.abs(self.qd[None]) > 0.02, tau=self.load[None], decimated=lambda x: x)
        return run, scene

    def views(self, residual: Array) -> tuple[View, ...]:
        run, scene = self.scene()
        return views([run], [scene], [residual], 0, [WHITE])


SEEN = Seen()


@pytest.mark.parametrize(
    ("expected", "law"),
    [
        ("q", lambda s: np.exp(-(((s.q - 0.3) / 0.2) ** 2))),
        ("qd", lambda s: np.sign(s.qd) * np.exp(-np.abs(s.qd) / 0.3)),
        ("qdd", lambda s: s.qdd * np.abs(s.qdd)),
        ("load", lambda s: np.sign(s.qd) * np.abs(s.load)),
        ("time", lambda s: s.t),
        ("motor phase", lambda s: np.sin(s.phase)),
        ("q by direction", lambda s: np.sign(s.qd) * np.cos(3 * s.q)),
    ],
)
def test_the_variable_is_found(expected: str, law: Callable[[Seen], Array]) -> None:
    # What a model with weight and Coulomb and viscous friction leaves of it.
    known = np.stack([np.ones(COUNT), np.sign(SEEN.qd), SEEN.qd, np.cos(SEEN.q), np.sin(SEEN.q)], axis=1)
    effect = law(SEEN)
    effect = effect - known @ np.linalg.lstsq(known, effect, rcond=None)[0]
    effect = effect / effect.std()
    residual = effect + np.random.default_rng(2).normal(size=COUNT)
    variable, shares = strongest(SEEN.views(residual))
    assert variable == expected
    # Half of the variance is the effect's, of which bins blur a part.
    assert 0.25 < shares[expected] < 0.55


def test_noise_is_ordered_by_nothing_and_stays_in_its_band() -> None:
    found = SEEN.views(np.random.default_rng(3).normal(size=COUNT))
    assert max(one.share for one in found) < 0.01
    outside = sum(int(np.sum(np.abs(one.mean) > one.band)) for one in found)
    bins = sum(len(one.mean) for one in found)
    # Two standard deviations: one in 22.
    assert outside / bins < 0.1


def test_the_band_of_coloured_noise_is_wider() -> None:
    run, scene = SEEN.scene()
    slow = Colour((np.ones(1), np.array([1.0, -0.9])), (1 / np.sqrt(1 - 0.81), 1.0))
    plain, wide = (sorted(views([run], [scene], [SEEN.q], 0, [noise]), key=_name) for noise in (WHITE, slow))
    assert {"q", "qd", "time"} <= {one.variable for one in plain}
    for white, coloured in zip(plain, wide, strict=True):
        # The mean of n rows of a process with poles at 0.9 has the variance 1/(1 - 0.9)^2 / n.
        assert coloured.band == pytest.approx(10 * white.band)


def _name(one: View) -> tuple[str, int]:
    return one.variable, one.direction


def test_the_means_are_those_of_the_bins() -> None:
    residual = np.sin(SEEN.q)
    (over_q,) = [one for one in SEEN.views(residual) if one.variable == "q"]
    assert over_q.mean == pytest.approx(np.sin(over_q.centre), abs=0.02)
    backward, forward = (
        next(one for one in SEEN.views(np.sign(SEEN.qd)) if one.variable == "load" and one.direction == side)
        for side in (-1, 1)
    )
    assert backward.mean == pytest.approx(-1.0, abs=1e-9)
    assert forward.mean == pytest.approx(1.0, abs=1e-9)
    assert backward.count.sum() + forward.count.sum() <= int(np.sum(np.abs(SEEN.qd) > 0.02))


def test_too_few_rows_show_nothing() -> None:
    run, scene = SEEN.scene()
    run.kept = np.arange(COUNT)[None] < 50
    assert views([run], [scene], [SEEN.q], 0, [WHITE]) == ()
    assert strongest(()) == ("", {})


def test_an_upright_axis_has_no_load() -> None:
    run, scene = SEEN.scene()
    scene.load = 1e-14 * SEEN.q[None]
    found = views([run], [scene], [np.sign(SEEN.qd)], 0, [WHITE])
    assert "load" not in {one.variable for one in found}
    assert "qd" in {one.variable for one in found}
