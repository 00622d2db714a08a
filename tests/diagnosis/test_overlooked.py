"""What counts as noise where it is measured, and is none: it is told all the same that something is missing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.verdict.overlooked import untested, untold
from identification.diagnosis.verdict.trial import along
from identification.diagnosis.verdict.unexplained import unexplained
from identification.observation import Motion
from tests.diagnosis.diagnosed_arm import answered, ready
from tests.matrices import bank, run
from tests.recorded import TRUTH, as_recorded, fourier, two_links

Array = NDArray[np.float64]

#: Of the noise [N m], and how long a run is [s]: two periods.
NOISE, SECONDS = 0.3, 20.0


def diagnosis(
    folder: Path, changed: Callable[[int, Array, Motion, Array], Array], turning: bool = True, slows: bool = False
) -> Diagnosis:
    """Of three runs and one that tests; torques of joint 2 are ``changed`` from what they are by the run's number, the
    time and the motion. It turns round in all runs, or in the last one alone, which ``slows`` down to a crawl or not.
    """
    regressors, draw, sources = two_links(folder), np.random.default_rng(17), []
    for number in range(4):
        t, motion = fourier(regressors.model.robot, SECONDS, 250.0, number)
        if not turning and number < 3:
            q, qd, qdd = (np.copy(x) for x in (motion.q, motion.qd, motion.qdd))
            q[1], qd[1], qdd[1] = 0.2 * t + 0.1 * np.sin(t) - 2, 0.2 + 0.1 * np.cos(t), -0.1 * np.sin(t)
            motion = Motion(q, qd, qdd)
        if slows and number == 3:
            motion = slowing(t, motion)
        tau = regressors.torques(TRUTH, motion)
        tau[1] = changed(number, t, motion, tau[1])
        tau += NOISE * draw.normal(size=tau.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{number}.csv")))
    request = Request(sources[:3], test=sources[3:])
    return answered(folder / "two_links.yaml", request, folder / "out")[0]


def slowing(t: Array, motion: Motion) -> Motion:
    """Joint 2 swings, and creeps in the second half."""
    q, qd, qdd = (np.copy(x) for x in (motion.q, motion.qd, motion.qdd))
    swings = (1 - np.tanh(4 * (t - SECONDS / 2))) / 2
    qd[1] = swings * np.cos(2 * t) + 0.06 * (1 - swings)
    q[1], qdd[1] = np.cumsum(qd[1]) * (t[1] - t[0]), np.gradient(qd[1], t)
    return Motion(q, qd, qdd)


def same(number: int, t: Array, motion: Motion, tau: Array) -> Array:
    return tau


def colder(number: int, t: Array, motion: Motion, tau: Array) -> Array:
    """Dry friction that is larger in the run that tests."""
    return np.asarray(tau + 2.0 * np.sign(motion.qd[1]) * (number == 3))


def test_friction_that_changes_from_run_to_run_is_not_nothing(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, colder)
    assert found.verdict == UNEXPLAINED
    assert (found.after.joint, found.after.variable) == (2, "time")
    (note,) = (one for one in found.notes if "the runs that test keep" in one)
    assert "times the noise on joint 2, the others do not" in note


@pytest.mark.parametrize(
    ("size", "slow", "told"),
    [(0.4, True, {}), (1.0, True, {0: pytest.approx(0.71, abs=0.05)}), (1.0, False, {}), (10.0, False, {})],
)
def test_most_of_a_torque_is_no_noise(size: float, slow: bool, told: dict[int, float]) -> None:
    """Of a torque of rms 1 beside what a model leaves of another ``size``: 0.4 are 37 % of the whole, 1 are 71 %.

    White noise may be as large: a light joint's currents, or those of one that hardly moves.
    """
    draw = np.random.default_rng(5)
    W = draw.normal(size=(1, 4000))
    rest = np.sqrt(2) * np.sin(np.arange(4000) / 100) if slow else draw.normal(size=4000)
    one = bank([run(W, W[0] + size * rest)])
    assert untold(SimpleNamespace(bank=one), {0: 1.0}) == told  # type: ignore[arg-type]


def creeping(number: int, t: Array, motion: Motion, tau: Array) -> Array:
    """Friction close to standstill alone, in the run that tests."""
    return np.asarray(tau + 2.0 * np.sign(motion.qd[1]) * (np.abs(motion.qd[1]) < 0.065) * (number == 3))


def test_what_is_close_to_standstill_counts_where_something_was_taken_back(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, creeping, slows=True)
    assert (found.verdict, found.findings) == (NOTHING, ())
    trial = along(found.search, [ready(str(tmp_path / "3.csv"), found.search.bank.scenes[0].regressors)])
    assert trial is not None
    assert untested(found.search, trial) == {}
    assert untested(found.search, trial, [0]) == {}
    assert untested(found.search, trial, [0, 1])[1] > 2
    hypothesis = SimpleNamespace(title="Stribeck friction")
    gone = SimpleNamespace(evidence=SimpleNamespace(variant=SimpleNamespace(hypothesis=hypothesis, coordinates=(1,))))
    rest = unexplained(found.search, [gone], trial, found.after, (), ())  # type: ignore[list-item]
    assert rest.missing
    assert rest.where is not None
    assert (rest.where.joint, rest.where.variable, rest.where.region) == (2, "qd", "close to standstill")
    (note,) = rest.notes
    assert "times the noise on joint 2, most of it close to standstill: Stribeck friction of the values" in note


def louder(number: int, t: Array, motion: Motion, tau: Array) -> Array:
    """Noise that is larger in the run that tests."""
    return np.asarray(tau + 3 * NOISE * np.random.default_rng(29).normal(size=tau.shape) * (number == 3))


@pytest.mark.long
def test_more_noise_is_no_contradiction(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, louder)
    assert (found.verdict, found.findings) == (NOTHING, ())


@pytest.mark.parametrize("turning", [pytest.param(True, marks=pytest.mark.long), False])
def test_what_the_fitted_runs_leave_open_is_no_contradiction(turning: bool, tmp_path: Path) -> None:
    """A joint that never turns round shows the sum of its offset and its dry friction, and the testing run more."""
    found = diagnosis(tmp_path, same, turning)
    assert (found.verdict, found.findings) == (NOTHING, ())
