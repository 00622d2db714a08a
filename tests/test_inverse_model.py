"""Least squares on the inverse model: true parameters come back, with honest uncertainty, or are named unknown."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from generator.errors import InputError
from identification.dataset import load
from identification.factors import added, factors
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.sampling import rows_of, sampled
from identification.sidecar import Payload
from tests.bodies import STEMS
from tests.recorded import TRUTH, Recorded, as_recorded, fourier, recorded

PLAIN = Recipe(dynamics=4.0, standstill=0.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("runs")


@pytest.fixture(scope="module")
def clean(links: Regressors, folder: Path) -> Path:
    return recorded(links, TRUTH).save(folder / "clean.csv")


@pytest.fixture(scope="module")
def noisy(links: Regressors, folder: Path) -> Path:
    return recorded(links, TRUTH, seed=2, noise=0.05).save(folder / "noisy.csv")


def test_the_robot_has_the_parameters_of_the_tests(links: Regressors) -> None:
    assert list(links.names) == list(TRUTH)


def test_clean_runs_give_the_truth(links: Regressors, clean: Path) -> None:
    found = identify(links.model.robot, [clean], options=Options(recipe=Recipe(dynamics=4.0)), regressors=links)
    values = found.full.solution.values
    # The standstill rows that remain near the threshold and the filters leave a little.
    assert {name: values[name] for name in TRUTH} == pytest.approx(TRUTH, rel=2e-3, abs=0.02)
    assert found.full.train.total.relative_to_mean < 0.1


def test_estimates_are_those_of_the_normal_equations(links: Regressors, noisy: Path) -> None:
    """Against a straightforward whole-matrix computation with the same rows."""
    robot = links.model.robot
    found = identify(robot, [noisy], options=Options(recipe=PLAIN), regressors=links)
    run = sampled(load(str(noisy), robot), PLAIN, links)
    stacked: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {0: [], 1: []}
    for rows in rows_of(run, links):
        W = np.zeros((len(rows.Y), len(TRUTH)))
        W[:, [list(TRUTH).index(name) for name in rows.names]] = rows.W
        stacked[rows.joint].append((W, rows.Y))
    W = [np.concatenate([w for w, _ in stacked[k]]) for k in (0, 1)]
    Y = [np.concatenate([y for _, y in stacked[k]]) for k in (0, 1)]
    chi = np.linalg.lstsq(np.concatenate(W), np.concatenate(Y), rcond=None)[0]
    for _ in range(2):
        sigma = [np.sqrt(np.sum((Y[k] - W[k] @ chi) ** 2) / (len(Y[k]) - np.linalg.matrix_rank(W[k]))) for k in (0, 1)]
        weighted = np.concatenate([W[k] / sigma[k] for k in (0, 1)])
        chi = np.linalg.lstsq(weighted, np.concatenate([Y[k] / sigma[k] for k in (0, 1)]), rcond=None)[0]
    std = np.sqrt(np.diag(np.linalg.inv(weighted.T @ weighted)))
    solution = found.full.solution
    assert [solution.values[name] for name in TRUTH] == pytest.approx(chi, rel=1e-8)
    assert [solution.std(name) for name in TRUTH] == pytest.approx(std, rel=1e-6)
    assert solution.condition == pytest.approx(np.linalg.cond(np.concatenate(W)), rel=1e-8)
    error = np.concatenate(Y) - np.concatenate(W) @ chi
    total = found.full.train.total
    assert total.norm == pytest.approx(np.linalg.norm(error), rel=1e-8)
    spread = np.linalg.norm(np.concatenate([y - y.mean() for y in Y]))
    assert total.relative_to_mean == pytest.approx(100 * np.linalg.norm(error) / spread, rel=1e-8)
    assert total.relative == pytest.approx(100 * np.linalg.norm(error) / np.linalg.norm(np.concatenate(Y)), rel=1e-8)


def test_ordinary_least_squares_has_one_variance(links: Regressors, noisy: Path) -> None:
    robot = links.model.robot
    recipe = PLAIN.changed(weights="none")
    solution = identify(robot, [noisy], options=Options(recipe=recipe), regressors=links).full.solution
    whole = added(factors(rows_of(sampled(load(str(noisy), robot), recipe, links), links)), tuple(TRUTH))
    R = np.concatenate([one.R for one in whole])
    W, z = R[:, :-1], R[:, -1]
    chi = np.linalg.solve(W.T @ W, W.T @ z)
    variance = np.sum((z - W @ chi) ** 2) / (sum(one.rows for one in whole) - len(TRUTH))
    assert [solution.values[n] for n in TRUTH] == pytest.approx(chi, rel=1e-7)
    assert [solution.std(n) for n in TRUTH] == pytest.approx(
        np.sqrt(variance * np.diag(np.linalg.inv(W.T @ W))), rel=1e-6
    )


def test_parts_of_a_long_run_make_the_whole(links: Regressors, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = recorded(links, TRUTH, duration=60.0, rate=1000.0, noise=0.05).save(folder / "long.csv")
    run = sampled(load(str(path), links.model.robot), Recipe(), links)
    parted = list(rows_of(run, links))
    monkeypatch.setattr("identification.sampling._PART", 1 << 30)
    whole = list(rows_of(run, links))
    assert run.filters.factor == 100
    for k in (0, 1):
        W = [np.concatenate([rows.W for rows in some if rows.joint == k]) for some in (parted, whole)]
        assert W[0].shape == W[1].shape
        assert np.abs(W[0] - W[1]).max() < 1e-9 * np.abs(W[1]).max()
    one_stage = Recipe(factor=10)
    run = sampled(load(str(path), links.model.robot), one_stage, links)
    whole = list(rows_of(run, links))
    monkeypatch.setattr("identification.sampling._PART", 1 << 13)
    parted = list(rows_of(run, links))
    assert len(parted) > 2 * len(whole) == 4
    for k in (0, 1):
        t = [np.concatenate([rows.t for rows in some if rows.joint == k]) for some in (parted, whole)]
        Y = [np.concatenate([rows.Y for rows in some if rows.joint == k]) for some in (parted, whole)]
        assert (t[0] == t[1]).all()
        assert np.abs(Y[0] - Y[1]).max() < 1e-9 * np.abs(Y[1]).max()


def test_uncertainty_covers_the_truth(links: Regressors, folder: Path) -> None:
    """White noise, rows kept apart by the decimation: the truth lies within two std in about 95 % of all cases."""
    inside, count = 0, 0
    for seed in range(12):
        run = recorded(links, TRUTH, seed=seed + 10, noise=0.1).save(folder / f"noise{seed}.csv")
        solution = identify(links.model.robot, [run], options=Options(recipe=PLAIN), regressors=links).full.solution
        inside += sum(abs(solution.values[n] - TRUTH[n]) < 2 * solution.std(n) for n in TRUTH)
        count += len(TRUTH)
    assert 0.88 < inside / count < 0.995


def coloured(links: Regressors, seed: int) -> Recorded:
    """A run with noise that lasts for a fifth of a second."""
    run = recorded(links, TRUTH, seed=seed)
    draw = np.random.default_rng(seed + 50)
    noise = signal.lfilter([1.0], [1, -0.975], draw.normal(size=(2, len(run.columns["t"]))))
    return run.with_columns(tau1=run.columns["tau1"] + noise[0], tau2=run.columns["tau2"] + 0.3 * noise[1])


@pytest.mark.long
def test_blocks_tell_the_uncertainty_under_coloured_noise(links: Regressors, folder: Path) -> None:
    """Estimates over many seeds are the judge; independent residuals promise too much."""
    plain, blocks, z = [], [], []
    for seed in range(14):
        path = coloured(links, seed).save(folder / f"coloured{seed}.csv")
        for draws, into in ((0, plain), (200, blocks)):
            options = Options(recipe=PLAIN, draws=draws)
            solution = identify(links.model.robot, [path], options=options, regressors=links).full.solution
            into.append([solution.std(name) for name in TRUTH])
        z.append([solution.values[name] - truth for name, truth in TRUTH.items()])
    actual = np.sqrt(np.mean(np.square(z), axis=0))
    assert np.median(actual / np.mean(plain, axis=0)) > 1.5
    assert 0.75 < np.median(actual / np.mean(blocks, axis=0)) < 1.4


def test_where_nothing_is_sought_nothing_is_drawn(links: Regressors, clean: Path) -> None:
    options = Options(recipe=PLAIN, fixed=TRUTH, draws=50)
    found = identify(links.model.robot, [clean], options=options, regressors=links).full
    assert found.train.total.relative_to_mean < 1


def test_several_runs_and_held_out_ones(links: Regressors, clean: Path, noisy: Path) -> None:
    robot = links.model.robot
    both = identify(robot, [clean, noisy], [clean], Options(recipe=PLAIN), links)
    alone = identify(robot, [noisy], [clean], Options(recipe=PLAIN), links)
    assert both.full.train.total.rows == alone.full.train.total.rows + alone.full.test.total.rows  # type: ignore[union-attr]
    for name in TRUTH:
        assert both.full.solution.std(name) < alone.full.solution.std(name)
    assert both.full.test is not None
    assert both.full.test.total.relative_to_mean < 2


def test_standing_joints_leave_parameters_unknown(links: Regressors, folder: Path) -> None:
    t, motion = fourier(links.model.robot, 20.0, 200.0)
    still = np.zeros_like(motion.q)
    still[0] = 1.0
    held = Motion(motion.q * still + 0.3 * (1 - still), motion.qd * still, motion.qdd * still)
    tau = links.torques(TRUTH, held)
    tau += 0.01 * np.random.default_rng(1).normal(size=tau.shape)
    q = held.q + np.random.default_rng(2).normal(size=tau.shape) * np.array([[0.0], [1e-6]])
    path = as_recorded(links, t, q, tau).save(folder / "still.csv")
    found = identify(links.model.robot, [path], options=Options(recipe=Recipe(dynamics=4.0)), regressors=links)
    solution = found.full.solution
    assert {"Fv2", "Ia2", "Fc2"} <= set(solution.hidden)
    assert {"Fv1", "Fc1"}.isdisjoint(solution.hidden)
    for name in solution.hidden:
        assert solution.std(name) == solution.relative_std(name) == float("inf")
    names = f"{', '.join(solution.hidden[:-1])} and {solution.hidden[-1]}"
    assert f"{names} cannot be identified: no motion in the data shows any of them alone" in found.notes
    assert {"Fv2", "Ia2", "Fc2", "Off2"}.isdisjoint(found.essential.sought)
    assert any("joint 2 stands still" in note and "it has no rows" in note for note in found.notes)
    assert found.full.train.total.relative_to_mean < 2
    assert solution.values["Fv1"] == pytest.approx(TRUTH["Fv1"], rel=0.02)


def test_a_joint_that_sticks_tells_nothing(links: Regressors, folder: Path) -> None:
    """Its dry friction holds whatever it must, up to Fc."""
    sources = []
    for number, stuck in enumerate((None, 1, 1)):
        t, motion = fourier(links.model.robot, 20.0, 200.0, number + 1)
        moving = np.ones_like(motion.q)
        if stuck is not None:
            moving[stuck] = 0.0
        held = Motion(motion.q * moving + 0.3 * (1 - moving), motion.qd * moving, motion.qdd * moving)
        tau = links.torques(TRUTH, held) + 0.01 * np.random.default_rng(number).normal(size=moving.shape)
        tau += 0.8 * TRUTH["Fc2"] * (1 - moving)
        sources.append(as_recorded(links, t, held.q, tau).save(folder / f"sticks{number}.csv"))
    solution = identify(links.model.robot, sources, options=Options(recipe=PLAIN), regressors=links).full.solution
    for name in ("Off2", "MX2", "Fc2", "ZZ2"):
        assert solution.values[name] == pytest.approx(TRUTH[name], abs=5 * solution.std(name) + 1e-3)


def test_fixed_parameters_are_not_estimated(links: Regressors, noisy: Path) -> None:
    fixed = {"ZZ2": TRUTH["ZZ2"], "Off1": 1.0, "MX2": TRUTH["MX2"]}
    found = identify(links.model.robot, [noisy], options=Options(recipe=PLAIN, fixed=fixed), regressors=links)
    free = identify(links.model.robot, [noisy], options=Options(recipe=PLAIN), regressors=links)
    solution = found.full.solution
    assert {name: solution.values[name] for name in fixed} == fixed
    assert all(solution.std(name) == 0 for name in fixed)
    assert set(found.full.sought) == set(TRUTH) - set(fixed)
    assert solution.std("MX1R") < free.full.solution.std("MX1R")
    assert found.full.train.total.norm > free.full.train.total.norm


LOAD = [0.02, 0.0, 0.0, 0.05, 0.0, 0.05, 0.3, -0.1, 0.0, 2.5]


def test_a_payload_is_told_from_the_arm_by_a_run_without_it(links: Regressors, folder: Path, clean: Path) -> None:
    loaded = recorded(links, TRUTH, seed=3, payload=LOAD).save(folder / "loaded.csv")
    options = Options(recipe=Recipe(dynamics=4.0))
    (folder / "loaded.yaml").write_text("payload: {name: box, MZ: 0 kg m}\n")
    found = identify(links.model.robot, [clean, loaded], options=options, regressors=links)
    solution = found.full.solution
    # In a plane, of ten parameters three act: the moment of inertia and two first moments, the mass being one of them.
    assert {"XXbox", "XYbox", "XZbox", "YYbox", "YZbox"} <= set(solution.hidden)
    assert solution.values["MYbox"] == pytest.approx(-0.1, abs=0.01)
    assert solution.values["MX1R"] == pytest.approx(TRUTH["MX1R"], rel=5e-3)
    (folder / "loaded.yaml").write_text(
        "payload: {name: box, XX: 0 kg m2, XY: 0 kg m2, XZ: 0 kg m2, YY: 0 kg m2, YZ: 0 kg m2, ZZ: 0.05 kg m2, "
        "MX: 0.3 kg m, MY: -0.1 kg m, MZ: 0 kg m}\n"
    )
    found = identify(links.model.robot, [clean, loaded], options=options, regressors=links)
    solution = found.full.solution
    assert "Mbox" in found.full.sought
    assert solution.values["Mbox"] == pytest.approx(2.5, abs=max(3 * solution.std("Mbox"), 0.02))


def test_a_run_with_a_known_payload_is_tried_with_it(links: Regressors, folder: Path, clean: Path) -> None:
    path = recorded(links, TRUTH, seed=4, payload=LOAD).save(folder / "tried.csv")
    options = Options(recipe=Recipe(dynamics=4.0))
    units = ["kg m2"] * 6 + ["kg m"] * 3 + ["kg"]
    given = ", ".join(f"{stem}: {value} {unit}" for stem, value, unit in zip(STEMS, LOAD, units, strict=True))
    (folder / "tried.yaml").write_text(f"payload: {{{given}}}\n")
    found = identify(links.model.robot, [clean], [path], options, links)
    assert found.full.test is not None
    assert found.full.test.total.relative_to_mean < 0.2
    (folder / "tried.yaml").write_text("payload: {M: 2.5 kg}\n")
    with pytest.raises(
        InputError, match=r"tried.csv:1:1: payload L is not on any run that is identified from, expected"
    ):
        identify(links.model.robot, [clean], [path], options, links)


def test_a_payload_in_all_runs_counts_as_part_of_the_last_body(links: Regressors, folder: Path) -> None:
    loaded = recorded(links, TRUTH, seed=3, payload=LOAD).save(folder / "always.csv")
    options = Options(recipe=Recipe(dynamics=4.0), payload=Payload("L", {}))
    found = identify(links.model.robot, [loaded], options=options, regressors=links)
    assert any(note.startswith("payload L: no run without it tells") for note in found.notes)
    assert not found.full.solution.hidden
    assert found.full.solution.values["MX2"] == pytest.approx(TRUTH["MX2"] + 0.3 + 2.5 * 0.4, rel=0.01)


def test_outliers_pull_the_robust_estimate_less(links: Regressors, folder: Path) -> None:
    run = recorded(links, TRUTH, seed=5, noise=0.02)
    struck = run.columns["tau1"].copy()
    struck[1000:1060] += 40.0
    path = run.with_columns(tau1=struck).save(folder / "struck.csv")
    robot = links.model.robot
    plain = identify(robot, [path], options=Options(recipe=PLAIN), regressors=links)
    tough = identify(robot, [path], options=Options(recipe=PLAIN, robust=True), regressors=links)

    def away(found: dict[str, float]) -> float:
        return float(np.linalg.norm([(found[n] - TRUTH[n]) / TRUTH[n] for n in ("MX1R", "ZZ1R", "Fv1", "Fc1", "Off1")]))

    assert away(dict(tough.full.solution.values)) < 0.2 * away(dict(plain.full.solution.values))
    assert any("count less than fully" in note for note in tough.notes)


def test_essential_parameters_end_below_the_ratio(links: Regressors, noisy: Path) -> None:
    found = identify(
        links.model.robot, [noisy], options=Options(recipe=PLAIN, ratio=20.0, growth=np.inf), regressors=links
    )
    relative = [found.essential.solution.relative_std(n) for n in found.essential.sought]
    assert 1 < len(relative) < len(TRUTH)
    assert max(relative) < 20 * min(relative)
    gone = set(TRUTH) - set(found.essential.sought)
    assert all(found.essential.solution.values[name] == 0 for name in gone)
    first = max(TRUTH, key=found.full.solution.relative_std)
    assert first in gone


def test_essential_parameters_leave_a_negligible_error(links: Regressors, noisy: Path, clean: Path) -> None:
    """Without a ratio that is asked for: the residual grows by 4 % at most, and clean data lose nothing they show."""
    found = identify(links.model.robot, [noisy], options=Options(recipe=PLAIN), regressors=links)
    assert found.essential.train.total.norm < 1.05 * found.full.train.total.norm
    sure = {name for name in TRUTH if found.full.solution.relative_std(name) < 5}
    assert sure <= set(found.essential.sought)
    found = identify(links.model.robot, [clean], options=Options(recipe=PLAIN), regressors=links)
    assert {name for name in TRUTH if found.full.solution.relative_std(name) < 1} <= set(found.essential.sought)


def test_rows_near_standstill_are_left_out(links: Regressors, clean: Path) -> None:
    robot = links.model.robot
    kept = {}
    for threshold in (0.0, 0.05):
        recipe = Recipe(dynamics=4.0, standstill=threshold)
        run = sampled(load(str(clean), robot), recipe, links)
        kept[threshold] = {rows.joint: rows for rows in rows_of(run, links)}
        if threshold:
            for k, rows in kept[threshold].items():
                near = [
                    np.abs(run.motion.qd[k][np.abs(run.times - t) <= run.filters.factor * 0.00499]).min()
                    for t in rows.t
                ]
                assert min(near) >= threshold
    assert all(len(kept[0.05][k].Y) < len(kept[0.0][k].Y) for k in (0, 1))


def test_torques_that_the_model_cannot_make_are_refused(links: Regressors, folder: Path) -> None:
    run = recorded(links, TRUTH, seed=8)
    other = np.random.default_rng(3).normal(size=(2, len(run.columns["t"])))
    other = signal.lfilter([0.01], [1, -0.99], other)
    path = run.with_columns(tau1=other[0], tau2=other[1]).save(folder / "other.csv")
    with pytest.raises(InputError, match=r"the model of two_links leaves .* unexplained, expected a run of this robot"):
        identify(links.model.robot, [path], regressors=links)


def test_ten_rows_are_too_few(links: Regressors, folder: Path) -> None:
    path = recorded(links, TRUTH).rows(0, 10).save(folder / "ten.csv")
    with pytest.raises(InputError, match=r"ten.csv:1:1: 10 rows \(0.05 s at 200 Hz\), expected at least \d+ for the"):
        identify(links.model.robot, [path], regressors=links)


def test_times_in_milliseconds_are_found_out(links: Regressors, folder: Path) -> None:
    run = recorded(links, TRUTH)
    path = run.with_columns(t=1000 * run.columns["t"]).save(folder / "milliseconds.csv")
    expected = r"milliseconds.csv:1:1: one sample in 5 s \(0.2 Hz\), expected at least 4.44 Hz; are the times in s\?"
    with pytest.raises(InputError, match=expected):
        identify(links.model.robot, [path], regressors=links)


def test_negative_friction_is_told(links: Regressors, folder: Path) -> None:
    run = recorded(links, {**TRUTH, "Fv1": -8.0}, noise=0.01)
    found = identify(links.model.robot, [run.save(folder / "driven.csv")], regressors=links)
    assert any(note.startswith("Fv1 is -") and "below its bound 0" in note for note in found.notes)
