"""The report of a diagnosis: what it says in words is what was hidden, and its numbers are those of the result."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.effects.mechanisms import crank
from identification.diagnosis.diagnosis import LOCATED, NAMED, NOTHING, UNEXPLAINED
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.verdict.finding import Told
from identification.outcome import Value
from identification.report.diagnose.report import report
from identification.report.diagnose.sections import summary
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import change, values, verdict
from identification.report.numbers import plain
from identification.report.titles import titles
from tests.diagnosis.diagnosed_arm import NOISE, STAYS, Case, case
from tests.reports import Page


@pytest.fixture(scope="module")
def named(tmp_path_factory: pytest.TempPathFactory) -> Case:
    return case(tmp_path_factory.mktemp("named"), "stribeck")


def test_the_words_name_effect_joint_and_how_sure_it_is(named: Case) -> None:
    assert named.found.verdict == NAMED
    one = named.found.findings[0]
    assert one.hypothesis.effect == "stribeck_friction"
    assert f"The model lacks {one.hypothesis.title} on joint 1" in named.words
    value = one.parameters["Fst1"].value
    assert value is not None
    assert f"Fst1 = {plain(value, one.told[0].digits)} ± " in named.words
    assert f"It is {one.status}" in named.words
    tried = Subject(named.found, named.after).tried[1]
    within = tried.after.rms <= tried.floor
    assert ("that is not more than the noise" in named.words) == within
    assert ("of the gap between the two, in squares, is closed" in named.words) != within


def test_the_untouched_run_is_measured_against_noise(named: Case) -> None:
    subject = Subject(named.found, named.after)
    one = subject.tried[1]
    (_, before, after), k = subject.tested[0], 0
    for played, residual in ((before, one.before), (after, one.after)):
        e = (played.measured - played.model)[k, played.kept[k]]
        assert residual.rms == pytest.approx(float(np.sqrt(np.mean(e**2))))
    assert one.closed is not None
    assert one.closed > 0.9
    assert one.after.rms == pytest.approx(one.floor, rel=0.2)
    assert one.relative_floor == pytest.approx(one.after.relative_to_mean * one.floor / one.after.rms)


def test_untouched_runs_at_the_noise_are_told_beside_fitted_ones_that_keep_more(named: Case) -> None:
    """Noise of the fitted runs as large as what is left of the untouched one."""
    assert named.after is not None
    after = replace(named.after, tried={1: replace(named.after.tried[1], floor=10.0)})
    at_noise = "that is not more than the noise that was measured on the fitted runs"
    assert f"{at_noise}." in " ".join(change(Subject(named.found, after)))
    (lack,) = named.found.after.lack
    left = replace(named.found.after, lack=(replace(lack, p=1e-9, size=0.5, repeats=True),))
    words = " ".join(change(Subject(replace(named.found, after=left), after)))
    assert f"{at_noise}, though these keep 0.5 times that rms beside it." in words


def test_the_steps_are_of_the_runs_that_test(named: Case) -> None:
    steps = named.found.steps
    assert steps.tested
    assert steps.named == tuple(one.hypothesis.named for one in named.found.findings)
    before, after = steps.sizes
    assert before > 1.15
    assert after == pytest.approx(1.0, abs=0.1)
    assert "of the runs that test, as fits to the others predict them" in named.words


def test_the_noise_floor_is_that_of_the_noise_made(named: Case) -> None:
    """The rms of what a first-order filter leaves of white noise, below the decimation's corner."""
    rate = 20.0
    f = np.linspace(0, 0.8 * rate / 2, 2000)
    density = 2 * NOISE**2 / 100.0 / np.abs(1 - STAYS * np.exp(-2j * np.pi * f / 100.0)) ** 2
    made = math.sqrt(float(np.trapezoid(density, f)))
    assert noise_floor(named.found.search.bank, 0, rate) == pytest.approx(made, rel=0.15)


def test_every_section_of_a_finding_is_there(named: Case) -> None:
    for title in (
        "Where: lack of fit of each joint", "Where: residual over position, speed, load, time", "What is missing",
        "Where: spectrum of the residual", "Ranking of the candidates", "From the start to the noise",
        "Before and after on the runs that test", "What changed in the robot file", "Parameters of the new model",
        "Invisible on this data", "Runs and method",
    ):  # fmt: skip
        assert title in named.words, title
    assert "stribeck_friction, joint: 1" in named.words
    page = Page(named.page)
    assert all(trace["y"] for one in page.charts for trace in one["data"])
    assert named.after is not None
    assert page.rows["Fst1"][0] == pytest.approx(named.after.fit.values["Fst1"])
    assert report(named.found, named.after) == named.page


@pytest.mark.parametrize(
    ("value", "std", "written"),
    [
        (2051.527, 9.84, "2051.5"),
        (0.0529644, 0.00137, "0.053"),
        (40913.9, 69430.0, "41000"),
        (-0.003514, 0.000459, "-0.00351"),
        (1.25, None, "1.25"),
        (1.25, math.inf, "1.25 (not shown by these runs)"),
    ],
)
def test_a_value_is_written_as_far_as_it_is_known(value: float, std: float | None, written: str) -> None:
    """The last digit is the second one of the standard deviation; two are written at least."""
    assert Told("a", value, std, "1").text("").startswith(f"{written} +- " if std and std < math.inf else written)


def test_a_length_that_only_scales_the_others_is_told_to_be_chosen() -> None:
    told = "1 m (chosen: the runs tell the other lengths and the force only relative to it)"
    assert Told("d21", 1.0, None, "m", scale=True).text(" m") == told
    assert [one.name for one in crank.SHAPES if one.scale] == ["d21"]


def test_what_stands_at_its_bound_has_no_deviation(named: Case) -> None:
    one = replace(named.found.findings[0], parameters={"Fst1": Value(0.0, 0.0, "N m")})
    first = one.told[0]
    assert (first.value, first.std, first.at_bound) == (0.0, None, True)
    assert "Fst1 = 0\u00a0N\u00a0m (at its bound)" in values(one)


def test_an_effect_on_several_joints_is_told_once(named: Case) -> None:
    one = named.found.findings[0]
    other = replace(one, joints=(2,), hypothesis=replace(one.hypothesis, joint=2, joints=(2,)))
    both = Case(found := replace(named.found, findings=(other, one)), None, report(found))
    assert f"The model lacks {one.hypothesis.title} on joints 1 and 2." in both.words
    apart = replace(named.found, findings=(replace(other, doubts=("it is small",)), one))
    assert f"lacks {one.hypothesis.title} on joint 2 and {one.hypothesis.title} on joint 1." in " ".join(
        verdict(Subject(apart))
    )


def test_a_shape_that_the_runs_do_not_tell_is_said(named: Case) -> None:
    one = named.found.findings[0]
    assert one.determined
    assert "one by one" not in named.words
    vague = replace(one, shape_std={"vs": 2 * one.shape["vs"]})
    case = Case(found := replace(named.found, findings=(vague,)), None, report(found))
    assert "The runs tell its torque, but not these values one by one" in case.words


def test_runs_of_one_name_are_called_by_their_folders() -> None:
    assert titles(["mon/run.csv", "tue/run.csv", "tue/other.csv"]) == ["mon/run.csv", "tue/run.csv", "other.csv"]


def test_runs_that_were_fitted_are_not_called_untouched(named: Case) -> None:
    assert "On the untouched runs " in named.words
    roles = replace(named.found.roles, searched=named.found.roles.test)
    case = Case(found := replace(named.found, roles=roles), named.after, report(found, named.after))
    assert "On the runs that were fitted " in case.words
    assert "Runs that nothing looked at before" not in case.words


def test_a_right_model_is_said_to_be_right(tmp_path: Path) -> None:
    one = case(tmp_path, "nothing")
    assert one.found.verdict == NOTHING
    assert "The model explains these runs" in one.words
    assert "What is missing" not in one.words
    assert "Before and after on the runs that test" not in one.words


def test_what_no_effect_explains_is_said_to_be_unexplained(named: Case) -> None:
    """The same result as if a joint was left with more than noise."""
    left = replace(named.found.after, joint=1, variable="q", region="q 0.3 to 0.4 rad")
    one = Case(found := replace(named.found, verdict=UNEXPLAINED, after=left), None, report(found))
    assert "no effect of the library explains well enough to be named: joint 1 keeps more than noise" in one.words
    assert f"The findings below are therefore tentative: {found.findings[0].hypothesis.title} on joint 1" in one.words
    nameless = replace(found, findings=())
    assert "tentative" not in Case(nameless, None, report(nameless)).words


@pytest.mark.parametrize(("unexplained", "told"), [(0, 1), (2, 2)])
def test_the_card_is_of_the_joint_that_stays_unexplained(unexplained: int, told: int, named: Case) -> None:
    """On joint 1 most is closed, on joint 2 nothing."""
    assert named.after is not None
    one = named.after.tried[1]
    after = replace(named.after, tried={1: one, 2: replace(one, after=one.before)})
    found = replace(named.found, after=replace(named.found.after, joint=unexplained))
    assert f"left on joint {told}" in str(summary.render(Subject(found, after)))


def test_a_dry_run_says_where_and_no_more(named: Case) -> None:
    dry = replace(named.found, verdict=LOCATED, findings=(), after=replace(named.found.after, joint=0))
    words = Case(dry, None, report(dry)).words
    assert "nothing was named. Joint 1 keeps more than noise, at qd " in words
    assert "no effect of the library explains" not in words
    assert "Ranking of the candidates" not in words
    nowhere = replace(dry, before=dry.after)
    assert "nothing was named. No joint keeps more than noise." in Case(nowhere, None, report(nowhere)).words


def test_a_report_of_a_diagnosis_fetches_nothing(named: Case) -> None:
    assert Page(named.page).loads == []
    assert len(named.page) < 8e6
