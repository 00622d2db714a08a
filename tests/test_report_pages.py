"""Reports: complete in one file, the same every time, and saying what results.json says."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from pkgutil import iter_modules
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

import identification.report.identify.sections
from generator.review.page import sections
from identification import report as report_package
from identification.excitation.request import Request
from identification.observation import Motion
from identification.report import series
from identification.report.excite.sections import summary as designed
from identification.report.identify.report import report
from identification.report.identify.sections import condition, parameters, runs, summary
from identification.report.identify.subject import ALL, CONSISTENT, ESSENTIAL, Subject
from identification.report.numbers import plain
from identification.report.welch import spectrum
from tests.recorded import TRUTH
from tests.reports import KINDS, Page, identified, pages


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return pages(tmp_path_factory.mktemp("reports"))


@pytest.fixture(scope="module")
def subject(tmp_path_factory: pytest.TempPathFactory) -> Subject:
    return identified(tmp_path_factory.mktemp("identified"))


def numbers(value: object) -> Iterator[float]:
    if isinstance(value, list):
        for one in value:
            yield from numbers(one)
    elif isinstance(value, int | float):
        yield float(value)


def test_every_kind_is_written(written: dict[str, bytes]) -> None:
    assert written.keys() == KINDS.keys()
    packages = {name for _, name, package in iter_modules(report_package.__path__) if package}
    assert {kind.package for kind in KINDS.values()} == packages


@pytest.mark.parametrize("kind", KINDS)
def test_a_report_fetches_nothing(written: dict[str, bytes], kind: str) -> None:
    assert Page(written[kind]).loads == []
    style = re.search(r"<style>(.*?)</style>", written[kind].decode(), re.DOTALL)
    assert style is not None
    assert not re.search(r"@import|url\(", style[1])
    assert len(written[kind]) < 8e6
    assert written[kind].count(b"plotly.js v") == 1


@pytest.mark.parametrize("kind", KINDS)
def test_every_chart_has_data(written: dict[str, bytes], kind: str) -> None:
    charts = Page(written[kind]).charts
    assert len(charts) >= 1
    for one in charts:
        assert one["data"]
        for trace in one["data"]:
            across, upward = len(trace["x"]), len(trace["z"] if "z" in trace else trace["y"])
            assert across == upward > 0
            assert all(math.isfinite(value) for value in numbers(trace["y"]))


def test_a_report_says_what_the_results_say(written: dict[str, bytes], subject: Subject) -> None:
    rows = Page(written["identify"]).rows
    assert subject.consistent is not None
    assert set(rows) == set(subject.results["parameters"])
    for name, one in subject.results["parameters"].items():
        consistent = subject.consistent.base[name]
        assert rows[name] == pytest.approx([one["value"], one["std"], one["relative_std_percent"], consistent])
    text = written["identify"].decode()
    for residual in subject.residuals.values():
        for kind in ("train", "test"):
            for one in (*residual[kind]["per_joint"], residual[kind]["total"]):
                assert f'value="{one["norm"]!r}"' in text
                assert f'value="{one["relative_percent"]!r}"' in text
                assert f'value="{one["relative_to_mean_percent"]!r}"' in text


def test_the_elimination_tells_where_it_ended(subject: Subject) -> None:
    """A ratio that the growth limit keeps from being reached is not said to be."""
    best = subject.results["essential"]
    found = [one["relative_std_percent"] for one in best["parameters"].values() if one["std"]]
    text = str(runs.render(subject))
    assert best["ratio"] == 30
    assert "is below 30 or the residual would grow by more than 4 % (report eq. 47)" in text
    reached = re.search(r"eq. 47\): it is ([0-9.e+]+)", text)
    assert reached is not None
    assert float(reached[1]) == pytest.approx(max(found) / min(found), rel=0.01)
    asked = replace(subject, results={**subject.results, "essential": {**best, "ratio": 15.0, "growth": float("inf")}})
    assert "is below 15 (report eq. 47): it is" in str(runs.render(asked))


def test_output_error_shows_what_the_simulation_misses(written: dict[str, bytes]) -> None:
    """Two joints in a fitted and a held-out run: nearly the same motion, and not the same numbers."""
    page = Page(written["output_error"])
    shown = [one["data"] for one in page.charts if one["data"][0].get("name") == "measured"]
    assert len(shown) == 4
    for measured, simulated, left in shown:
        assert (simulated["name"], left["name"]) == ("simulated", "residual, simulated")
        assert len(set(measured["x"])) > 100
        worst = max(abs(value) for value in left["y"] if value is not None)
        assert 0 < worst < 0.06
        t, q = (np.array([x for x in measured[axis] if x is not None]) for axis in "xy")
        assert np.ptp(q) > 0.5
        at = np.interp(np.array(simulated["x"], dtype=float), t, q)
        assert np.array(simulated["y"], dtype=float) == pytest.approx(at, abs=0.1)


def test_the_lag_of_link_side_encoders_is_shown(written: dict[str, bytes]) -> None:
    over = {one["data"][-1]["name"]: one["data"] for one in Page(written["links"]).charts}
    for number in (1, 2):
        slope = over[f"latency{number}"][-1]
        assert (slope["y"][1] - slope["y"][0]) / (slope["x"][1] - slope["x"][0]) == pytest.approx(3e-3, rel=0.02)
    slope = over["1/k2"][-1]
    assert (slope["x"][1] - slope["x"][0]) / (slope["y"][1] - slope["y"][0]) == pytest.approx(2e4, rel=0.05)
    # A rigid drive train has no line: its points alone are there.
    assert "1/k1" not in over
    text = written["links"].decode()
    assert "k1 cannot be told from these runs" in text
    assert "differences q − qs are left unexplained" in text


def test_a_line_far_from_zero_keeps_its_points_apart() -> None:
    """Times of a clock, angles of a drive train that twists by a thousandth of where it stands."""
    t = 1.7e9 + np.arange(1000) / 1000
    across, _ = series.thinned(t, np.sin(9 * t), 2000)
    assert np.array(across, dtype=float) == pytest.approx(t, abs=1e-6, rel=0)
    assert series.resolved(-1.5 + np.array([0.0, 1.25e-7])) == [-1.5, -1.499999875]
    assert series.resolved(np.array([2.0, 2.0])) == [2.0, 2.0]


def test_a_spectrum_ends_where_a_slower_run_ends() -> None:
    """Beyond, the faster one tells alone."""
    t, slow = np.arange(4000) / 200, np.arange(400) / 20
    silent, loud = np.zeros(4000), np.random.default_rng(1).normal(size=400)
    found = spectrum([(t, silent, 1 / 200), (slow, loud, 1 / 20)])
    assert found is not None
    assert np.all(found.amplitude[found.f > 10] == 0)
    assert np.all(found.amplitude[found.f < 10] > 0)


def test_what_is_no_number_is_a_dash() -> None:
    assert [plain(one) for one in (math.nan, math.inf, -math.inf)] == ["–", "∞", "−∞"]


def test_the_same_result_gives_the_same_bytes(subject: Subject) -> None:
    first = report(subject.found, subject.consistent)
    assert report(subject.found, subject.consistent) == first
    assert not re.search(rb"\b20\d\d-\d\d-\d\d\b", first.split(b"plotly.js v")[0])


def test_a_new_file_is_a_new_section(subject: Subject, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "zz_told_by_a_file.py").write_text(
        "from generator.review.markup import element\nTITLE = 'Told by a file'\nORDER = 25\n"
        "def render(subject):\n    return element('p', subject.found.robot.name)\n"
    )
    package = identification.report.identify.sections
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
    try:
        titles = [one.title for one in sections(package, subject)]
    finally:
        sys.modules.pop(f"{package.__name__}.zz_told_by_a_file", None)
    assert titles[:4] == ["Summary", "Fitted and held-out runs", "Told by a file", "Measured and estimated torque"]


def test_residuals_row_by_row_have_the_norms_of_the_factors(subject: Subject) -> None:
    for model in (ALL, ESSENTIAL, CONSISTENT):
        for kind, held_out in (("train", False), ("test", True)):
            for k, one in enumerate(subject.residuals[model][kind]["per_joint"]):
                rows = [run.torques[k].residual(model) for run in subject.runs if run.held_out is held_out]
                assert sum(map(len, rows)) == one["rows"]
                assert np.linalg.norm(np.concatenate(rows)) == pytest.approx(one["norm"], rel=1e-6)


@pytest.mark.parametrize(("key", "told"), [("relative_to_mean_percent", False), ("norm", True)])
def test_held_out_rows_are_worse_by_what_they_leave_not_by_what_moves_there(
    subject: Subject, key: str, told: bool
) -> None:
    results = deepcopy(dict(subject.results))
    held_out = results["residual"]["test"]
    for one in (held_out["total"], *held_out["per_joint"]):
        one[key] *= 3
    verdict = str(summary.render(replace(subject, results=results)))
    assert ("the fitted runs do not show all that matters" in verdict) == told
    assert not told or re.search(r"A row held out leaves [23][.\d]* times as much torque", verdict)


def test_rows_know_where_the_joint_was(subject: Subject) -> None:
    one = subject.runs[0].torques[1]
    sampled = subject.runs[0].observed.sampled
    assert np.interp(one.t, sampled.times, sampled.motion.q[1]) == pytest.approx(one.q, abs=1e-12)
    assert np.interp(one.t, sampled.times, sampled.motion.qd[1]) == pytest.approx(one.qd, abs=1e-12)


def test_the_inertia_matrix_is_that_of_two_links_by_hand(subject: Subject) -> None:
    run = subject.runs[0]
    q = run.observed.sampled.motion.q[:, :1]
    M = subject.found.regressors.inertia(TRUTH, q)[0]
    # Two links by hand; the second rotor stands beside the first link's inertia in ZZ1R.
    lever = 0.5 * (TRUTH["MX2"] * np.cos(q[1, 0]) - TRUTH["MY2"] * np.sin(q[1, 0]))
    assert M[0, 0] == pytest.approx(TRUTH["ZZ1R"] + TRUTH["ZZ2"] + 2 * lever)
    assert M[1, 1] == pytest.approx(TRUTH["ZZ2"] + TRUTH["Ia2"])
    still = Motion(q, np.zeros_like(q), np.zeros_like(q))
    for k in range(2):
        turned = replace(still, qdd=np.eye(2)[:, k : k + 1])
        inertial = subject.found.regressors.torques(TRUTH, turned) - subject.found.regressors.torques(TRUTH, still)
        assert inertial[:, 0] == pytest.approx(M[:, k])


def test_singular_values_have_the_condition_number(subject: Subject) -> None:
    s, _, names = condition.directions(subject)
    assert len(names) == len(TRUTH)
    assert s[0] / s[-1] == pytest.approx(subject.found.full.solution.scaled_condition)


def test_a_shortened_line_keeps_what_stands_out() -> None:
    t = np.arange(100_000) / 1000
    y = np.sin(t)
    y[70_123], y[30_456] = 5.0, -4.0
    across, upward = series.thinned(t, y, 400)
    assert len(across) <= 401
    assert (max(upward), min(upward)) == (5.0, -4.0)
    assert across[upward.index(5.0)] == pytest.approx(70.123)


def test_a_line_is_interrupted_where_rows_are_missing() -> None:
    t = np.concatenate([np.arange(0, 10, 0.1), np.arange(20, 30, 0.1)])
    across, upward = series.thinned(t, t.copy(), 1000)
    assert upward.count(None) == 1
    gap = upward.index(None)
    assert (across[gap - 1], across[gap + 1]) == pytest.approx((9.9, 20.0))


def test_a_spectrum_has_the_power_of_the_signal_with_and_without_gaps() -> None:
    draw = np.random.default_rng(3)
    t = np.arange(20_000) * 0.02
    noise = 3.0 * draw.normal(size=len(t))
    present = draw.random(len(t)) < 0.7
    for kept in (np.ones(len(t), dtype=bool), present):
        found = spectrum([(t[kept], noise[kept], 0.02)])
        assert found is not None
        power = float(np.mean(found.amplitude[:-1] ** 2) * 25.0)
        assert power == pytest.approx(9.0, rel=0.05)
    line = spectrum([(t, np.sin(2 * np.pi * 5.0 * t), 0.02)])
    assert line is not None
    assert line.f[int(np.argmax(line.amplitude))] == pytest.approx(5.0, abs=0.1)
    assert spectrum([(t[:5], noise[:5], 0.02)]) is None


def test_means_of_classes_are_within_their_band() -> None:
    draw = np.random.default_rng(1)
    x = draw.uniform(-1, 1, 4800)
    means = series.binned(x, 2 * x + draw.normal(size=4800))
    assert len(means.x) == 24
    assert np.mean(np.abs(means.mean - 2 * means.x) < 2 * means.std) > 0.8
    assert len(series.binned(x[:5], x[:5]).x) == 0


def test_a_page_without_a_consistent_model_does_not_explain_one(subject: Subject) -> None:
    """That column is not there either."""
    assert "consistent value is" in str(parameters.render(subject))
    assert "onsistent value" not in str(parameters.render(replace(subject, consistent=None)))


def test_a_designed_motion_is_summed_up_with_the_parameters_that_are_zero() -> None:
    values = {"ZZ1": 2.0, "Fv1": 4.0, "Off1": 0.0, "Fc1": 0.0}
    expected = SimpleNamespace(
        scaled_condition=3.0, values=values, hidden=(), relative_std=lambda name: 2.0 if values[name] else math.inf
    )
    found = SimpleNamespace(
        expected=expected,
        duration=10.0,
        request=Request(periods=1, rate=200.0),
        limits=SimpleNamespace(loads=np.zeros(0)),
        units=values,
    )
    text = str(designed.render(cast(Any, found)))
    assert "Of 4 base parameters 2 will be known to 10\u202f% or better." in text
    assert "Off1 and Fc1 are 0 in the set of values and have no relative standard deviation." in text
