"""What disturbs a motion that repeats in one of its periods is told, and its rows spoil nothing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

from identification.diagnosis.diagnosis import UNEXPLAINED, Diagnosis, diagnose
from identification.diagnosis.mending.mended import mended
from identification.diagnosis.noise.passing import Passing, passing
from identification.diagnosis.runs.roles import Roles
from identification.diagnosis.search.loop import first_values
from identification.diagnosis.verdict.finding import FIRM
from tests.diagnosis.diagnosed_arm import TRUTH, diagnosis_of, ready, recorded, rewritten, torque
from tests.recorded import Array, Recorded

#: A torque [N m] over the time [s], the position [rad] and the speed [rad/s].
Added = Callable[[Array, Array, Array], Array]
#: Seconds in which a brake drags, and its torque [N m].
FROM, TO, DRAG = 13.0, 18.0, 12.0


def drag(t: Array, _: Array, qd: Array) -> Array:
    return np.where((t > FROM) & (t < TO), DRAG * np.sign(qd), 0.0)


def diagnosed(folder: Path, added: Added, hidden: str = "") -> Diagnosis:
    """Two runs of four periods, with something on top of the second."""
    regressors, sources = recorded(folder, [torque(hidden)] * 2)
    with_more(sources[1], added)
    return diagnosis_of(sources, regressors)


def with_more(source: str, added: Added) -> None:
    rewritten(source, lambda t, q, tau: (t, q, tau + added(t, q, np.gradient(q, t))))


def test_a_brake_that_drags_once_is_unexplained_where_it_drags(tmp_path: Path) -> None:
    found = diagnosed(tmp_path, drag)
    assert found.verdict == UNEXPLAINED
    assert found.findings == ()
    (one,) = found.search.passing
    assert one.path.name == "2.csv"
    assert (one.begins, one.ends) == (pytest.approx(FROM, abs=0.6), pytest.approx(TO, abs=0.6))
    for where in (found.before, found.after):
        assert (where.joint, where.variable) == (1, "time")
        assert where.region == f"once, from {one.when}"
    assert any(
        "of all other periods of the motion, as of a disturbance: these rows are left out" in note
        for note in found.notes
    )


def test_a_brake_that_drags_twice_is_told_to_do_so(tmp_path: Path) -> None:
    """Five seconds each, at other phases of the motion."""
    found = diagnosed(tmp_path, lambda t, q, qd: drag(t, q, qd) + drag(t - 15.0, q, qd))
    assert len(found.search.passing) == 2
    longest = max(found.search.passing, key=lambda one: one.ends - one.begins)
    assert found.after.region == f"2 times, longest from {longest.when}"


def touch(t: Array, _: Array, qd: Array) -> Array:
    """A push of half a second."""
    return np.asarray(DRAG * np.exp(-(((t - FROM) / 0.25) ** 2)))


def test_a_short_push_is_seen_too(tmp_path: Path) -> None:
    (one,) = diagnosed(tmp_path, touch).search.passing
    assert one.begins < FROM < one.ends
    assert one.ends - one.begins < 2.0


def of_two_periods(folder: Path, added: Added) -> tuple[Passing, ...]:
    """What passes by in two runs of two periods, with something on top of the second."""
    regressors, sources = recorded(folder, [torque("")] * 2)
    for source in sources:
        Recorded.read(source).rows(0, 2001).save(Path(source))
    with_more(sources[1], added)
    return diagnosis_of(sources, regressors).search.passing


@pytest.mark.parametrize("at", [FROM, FROM - 10.0])
def test_of_two_periods_the_one_is_disturbed_that_the_model_does_not_explain(at: float, tmp_path: Path) -> None:
    (one,) = of_two_periods(tmp_path, lambda t, q, qd: touch(t - (at - FROM), q, qd))
    assert one.path.name == "2.csv"
    assert one.begins < at < one.ends
    assert one.ends - one.begins < 2.0


def test_of_two_periods_neither_is_disturbed_where_the_model_lacks_as_much_in_both(tmp_path: Path) -> None:
    def in_both(t: Array, q: Array, qd: Array) -> Array:
        return touch(t, q, qd) + touch(t + 10.0, q, qd)

    assert of_two_periods(tmp_path, lambda t, q, qd: in_both(t, q, qd) + touch(t, q, qd)) == ()


@pytest.mark.parametrize("seconds", [0.05, 1.0, 5.0])
def test_noise_that_stays_for_a_time_does_not_pass(seconds: float) -> None:
    """Along one run of three periods of ten seconds, fifty rows a second."""
    draw, stays = np.random.default_rng(3), np.exp(-0.02 / seconds)
    t, every = np.arange(1500) / 50, np.ones((1, 1500), dtype=bool)
    sampled = SimpleNamespace(run=SimpleNamespace(name="1.csv"))
    tau = np.zeros((1, 1500))
    run: Any = SimpleNamespace(period=500, rate=50.0, kept=every, t=t, tau=tau, sampled=sampled)
    for _ in range(40):
        assert passing([run], [lfilter([1], [1, -stays], draw.normal(size=(1, 3000)))[:, 1500:]]) == ()


@pytest.mark.parametrize("pushed", [0.0, 0.01])
def test_without_noise_nothing_passes_but_what_happens(pushed: float, tmp_path: Path) -> None:
    """Where a simulation ends its filters leave what they leave nowhere else; a push there is seen all the same."""
    regressors, sources = recorded(tmp_path, [torque("")] * 2, noise=0.0)
    with_more(sources[1], lambda t, q, qd: pushed * (t > t[-1] - 0.8))
    runs = [ready(source, regressors) for source in sources]
    values = first_values(runs, (0, 1), regressors, None)
    left = [run.tau - run.decimated(regressors.torques(values, run.sampled.motion)) for run in runs]
    found = passing(runs, left)
    assert [one.path.name for one in found] == ["2.csv"] * (pushed > 0)
    assert all(one.ends > 39.5 for one in found)


@pytest.mark.parametrize("left_out", [(), (595, 608, 625, 631, 650, 665)])
def test_reversals_on_both_sides_and_within_do_not_hide_a_push(left_out: tuple[int, ...]) -> None:
    """Along the same run, whose rows near reversals do not count."""
    draw, t, kept = np.random.default_rng(3), np.arange(1500) / 50, np.ones((1, 1500), dtype=bool)
    for begin, end in zip(left_out[::2], left_out[1::2], strict=True):
        kept[0, begin:end] = False
    sampled = SimpleNamespace(run=SimpleNamespace(name="1.csv"))
    tau = np.zeros((1, 1500))
    run: Any = SimpleNamespace(period=500, rate=50.0, kept=kept, t=t, tau=tau, sampled=sampled)
    push = 100 * ((t > 12.1) & (t < 13.05))
    (one,) = passing([run], [draw.normal(size=(1, 1500)) + push])
    assert one.begins < 12.5 < one.ends


def test_a_push_of_some_times_the_noise_passes(tmp_path: Path) -> None:
    (one,) = diagnosed(tmp_path, lambda t, q, qd: 0.5 * touch(FROM + (t - FROM) / 3, q, qd)).search.passing
    assert one.begins < FROM < one.ends


def test_its_rows_do_not_move_the_parameters(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("")] * 3)
    with_more(sources[1], drag)
    *runs, last = (ready(one, regressors) for one in sources)
    found = diagnose(
        regressors, runs, Roles((sources[0],), (sources[1],), (sources[2],), tuple(sources[:2])), test=[last]
    )
    fit = mended(tmp_path / "arm.yaml", found, None, tmp_path / "out").fit
    for name, true in TRUTH.items():
        assert fit.values[name] == pytest.approx(true, abs=5 * fit.std[name]), name
    # Five seconds of eighty, both ways, would add 0.75 N m.
    assert fit.values["Fc1"] == pytest.approx(TRUTH["Fc1"], abs=0.25)


def test_an_effect_is_found_beside_it(tmp_path: Path) -> None:
    found = diagnosed(tmp_path, drag, "stribeck")
    assert found.findings[0].hypothesis.effect == "stribeck_friction"
    assert found.verdict == UNEXPLAINED
    assert found.search.passing


def _loud_at_a_place(t: Array, q: Array, qd: Array) -> Array:
    near = np.abs(q - q.max()) < 0.1 * np.ptp(q)
    return np.where(near, 8.0 * np.random.default_rng(5).normal(size=len(t)), 0.0)


def _in_every_period(t: Array, q: Array, qd: Array) -> Array:
    return drag(FROM + np.mod(t - FROM, 10.0), q, qd)


def _drifting(t: Array, q: Array, qd: Array) -> Array:
    return 5.0 * (1 - np.exp(-t / 25.0))


def _loud(t: Array, q: Array, qd: Array) -> Array:
    return 3.0 * np.random.default_rng(6).normal(size=len(t))


@pytest.mark.parametrize("added", [_loud_at_a_place, _in_every_period, _drifting, _loud])
def test_what_every_period_has_or_noise_makes_does_not_pass(added: Added, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, added)
    assert found.search.passing == ()
    assert len([one for one in found.findings if one.status == FIRM]) == 0
