"""What untouched runs say against a new model is told, and what they contradict is taken back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

from identification.diagnosis.columns.hypothesis import BASE, VALUE
from identification.diagnosis.diagnosis import NAMED, UNEXPLAINED, diagnose
from identification.diagnosis.mending.mended import mended
from identification.diagnosis.mending.untouched import Untouched, hardly_shown, objections
from identification.diagnosis.runs.played import Played, aligned
from identification.diagnosis.runs.roles import Roles
from identification.residuals import Residual
from tests.diagnosis.diagnosed_arm import NOISE, STAYS, ready, recorded, rewritten, torque
from tests.recorded import Array

RUNS = "untouched runs"


def tried(before: float, after: float, floor: float = 1.0) -> Untouched:
    """Of 100 rows with a spread of 50 N m rms."""
    one, other = (Residual(100, 10 * rms, 600.0, 500.0) for rms in (before, after))
    return Untouched(one, other, floor)


def test_a_model_that_leaves_noise_meets_no_objection() -> None:
    assert objections({1: tried(1.02, 1.03), 2: tried(30.0, 1.4)}, RUNS) == []


def test_a_joint_that_got_worse_is_told() -> None:
    assert objections({1: tried(1.4, 1.81), 2: tried(5.0, 1.0)}, RUNS) == [
        "the new model explains the untouched runs less well on joint 1 (2.8 % without what was found, 3.62 % with it)"
    ]


def test_joints_that_keep_more_than_noise_are_told() -> None:
    (told,) = objections({1: tried(40.0, 20.0), 2: tried(60.0, 26.75), 3: tried(1.5, 1.5)}, RUNS)
    where = "on joint 1 (40 %, noise 2 %), joint 2 (53.5 %, noise 2 %)"
    assert told.startswith(f"the untouched runs keep far more than noise {where}: the model lacks more than was found")


def test_joints_on_which_runs_are_noisier_are_told_so() -> None:
    noisy, both = replace(tried(2.5, 2.5), louder=2.3), replace(tried(4.0, 4.0), louder=2.3)
    far, noisier = objections({1: noisy, 2: both}, RUNS)
    assert far.startswith("the untouched runs keep far more than noise on joint 2 (8 %, noise 2 %): the model lacks")
    assert noisier.startswith(
        "the untouched runs keep far more than the fitted ones' noise on joint 1 (5 %, noise 2 %): as much"
    )


@pytest.mark.parametrize(
    ("loud", "load", "told"), [(4.0, 0.0, "they may only be noisier"), (1.0, 8.0, "keep far more than noise on")]
)
def test_noise_of_a_run_is_told_from_what_its_model_lacks(loud: float, load: float, told: str, tmp_path: Path) -> None:
    """A last run with noise ``loud`` times that of the others, or with a weight of ``load`` N on an arm of a metre."""
    regressors, sources = recorded(tmp_path, [torque("")] * 3)

    def worse(t: Array, q: Array, tau: Array) -> tuple[Array, Array, Array]:
        more = NOISE * np.sqrt(loud**2 - 1) * np.random.default_rng(7).normal(size=len(t))
        return t, q, tau + (lfilter([1], [1, -STAYS], more) + load * np.cos(q))

    rewritten(sources[2], worse)
    *runs, test = (ready(one, regressors) for one in sources)
    roles = Roles((sources[0],), (sources[1],), (sources[2],), tuple(sources[:2]))
    found = diagnose(regressors, runs, roles, test=[test])
    notes = mended(tmp_path / "arm.yaml", found, None, tmp_path / "out").notes
    (note,) = (one for one in notes if one.startswith("the untouched runs"))
    assert told in note


def test_what_hardly_shows_is_told() -> None:
    """Noise of 2 % is nearly all that is left of joint 1; of joint 2 a part of the gap was left to close."""
    one, other = (SimpleNamespace(amplitude=dict.fromkeys(on, 1.0), hypothesis=None) for on in ([1], [1, 2]))
    one.hypothesis, other.hypothesis = (SimpleNamespace(named=name, kind=BASE) for name in ("elasticity", "tilt"))
    found: list[Any] = [one, other]
    (told,) = hardly_shown({1: tried(1.05, 1.04), 2: tried(5.0, 1.0)}, RUNS, found)
    assert told.startswith("elasticity hardly shows on the untouched runs")
    assert not [*hardly_shown({1: tried(1.05, 1.2)}, RUNS, found)]
    assert not [*hardly_shown({1: tried(1.4, 1.02)}, RUNS, found[:1])]
    assert not [*hardly_shown({1: tried(1.05, 1.04), 3: tried(5.0, 1.0)}, RUNS, found)]
    one.hypothesis.kind = VALUE
    assert not [*hardly_shown({1: tried(1.05, 1.04)}, RUNS, found[:1])]


def test_both_models_are_held_against_the_rows_that_count_for_both() -> None:
    """A delay that was found moves the ends; a limit of the current takes rows of one of them alone."""
    t, rows = 0.02 * np.arange(10), np.ones((1, 10), dtype=bool)
    clipped = rows.copy()
    clipped[0, 4:7] = False
    before = Played(t, t[None], 0 * t[None], rows)
    after = Played(t + 0.04, t[None] + 0.04, 0 * t[None], clipped)
    one, other = aligned(before, after)
    np.testing.assert_allclose(one.t, other.t)
    np.testing.assert_array_equal(one.kept, other.kept)
    assert one.residuals.per_joint[0].rows == other.residuals.per_joint[0].rows == 5


@pytest.mark.parametrize(
    ("fitted", "last", "named", "back", "verdict"),
    [
        ("stribeck", "stribeck", {"stribeck_friction"}, None, NAMED),
        ("stribeck", "", set(), "Stribeck friction", UNEXPLAINED),
        (
            "stribeck asymmetry",
            "stribeck",
            {"stribeck_friction"},
            "viscous friction that depends on the direction",
            UNEXPLAINED,
        ),
    ],
)
def test_what_a_testing_run_contradicts_is_taken_back(
    fitted: str, last: str, named: set[str], back: str | None, verdict: str, tmp_path: Path
) -> None:
    """The run that tests lacks what the fitted ones have; what it has too stays."""
    regressors, sources = recorded(tmp_path, [torque(one) for one in (fitted, fitted, last)])
    *runs, test = (ready(one, regressors) for one in sources)
    who = Roles((sources[0],), (sources[1],), (sources[2],), tuple(sources[:2]))
    found = diagnose(regressors, runs, who, test=[test])
    assert {one.hypothesis.effect for one in found.findings} == named
    # What was taken back is left beside what was not.
    assert found.verdict == verdict
    told = [note for note in found.notes if "is taken back" in note]
    assert [note.startswith(f"{back} on joint 1 is taken back") for note in told] == [True] * bool(back)


def test_what_was_found_and_is_not_written_is_no_objection() -> None:
    (told,) = objections({1: tried(40.0, 20.0), 2: tried(60.0, 26.75)}, RUNS, unwritten={1})
    assert "joint 2" in told
    assert "joint 1" not in told


def test_a_gain_that_makes_torques_larger_makes_no_joint_worse() -> None:
    """Half as much again of the torque, and of its noise: the part of the spread is what counts."""
    one = Untouched(Residual(100, 20.0, 600.0, 500.0), Residual(100, 24.0, 900.0, 750.0), 1.0)
    assert objections({1: one}, RUNS) == []
    assert one.closed is not None
    assert one.closed == pytest.approx((4.0**2 - 3.2**2) / (4.0**2 - 2.0**2))
