"""Runs of one robot that do not agree: which one it is, and where; none that only differ in noise, size or warmth."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.agreement import Foreseen, odd_of_two
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from tests.recorded import TRUTH, TWO_LINKS, Recorded, as_recorded, fourier, recorded

RECIPE = Recipe(dynamics=4.0)
FRICTION = {name: TRUTH[name] for name in ("Fv1", "Fc1", "Fv2", "Fc2")}
DISAGREE = "not agree"


def runs(links: Regressors, count: int) -> list[Recorded]:
    return [recorded(links, TRUTH, seed=seed, noise=0.01) for seed in range(1, count + 1)]


def saved(folder: Path, some: list[Recorded]) -> list[Path]:
    return [one.save(folder / f"{name}.csv") for name, one in zip("abcdef", some, strict=False)]


def notes(links: Regressors, paths: list[Path]) -> list[str]:
    found = identify(links.model.robot, paths, options=Options(RECIPE), regressors=links)
    return [note for note in found.notes if DISAGREE in note]


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("wrong", [0, 1])
@pytest.mark.parametrize("joint", [1, 2])
def test_the_run_whose_torques_have_another_sign_is_refused(
    joint: int, wrong: int, count: int, links: Regressors, tmp_path: Path
) -> None:
    some = runs(links, count)
    name = f"tau{joint}"
    some[wrong] = some[wrong].with_columns(**{name: -some[wrong].columns[name]})
    told = f"{'ab'[wrong]}.csv:1:1: (all friction and inertia that )?the torques of joint {joint} (show|have another)"
    with pytest.raises(InputError, match=told):
        identify(links.model.robot, saved(tmp_path, some), options=Options(RECIPE), regressors=links)


def test_so_it_is_where_nothing_tells_which_sign_is_right(links: Regressors, tmp_path: Path) -> None:
    """Friction and the rotor's inertia are given: the other runs are more."""
    some = runs(links, 3)
    some[2] = some[2].with_columns(tau2=-some[2].columns["tau2"])
    options = Options(RECIPE, fixed={**FRICTION, "Ia2": TRUTH["Ia2"]})
    told = "c.csv:1:1: the torques of joint 2 have another sign than those of the other runs, expected one sign in all"
    with pytest.raises(InputError, match=told):
        identify(links.model.robot, saved(tmp_path, some), options=options, regressors=links)


@pytest.mark.parametrize("joint", [1, 2])
def test_a_run_that_tests_with_another_sign_of_one_joint_is_refused(
    joint: int, links: Regressors, tmp_path: Path
) -> None:
    some = runs(links, 3)
    some[2] = some[2].with_columns(**{f"tau{joint}": -some[2].columns[f"tau{joint}"]})
    *paths, test = saved(tmp_path, some)
    with pytest.raises(InputError, match=f"c.csv:1:1: the torques of joint {joint} have another sign than those that"):
        identify(links.model.robot, paths, [test], Options(RECIPE), links)


def lost_home(run: Recorded) -> Recorded:
    """Positions of the second joint from another zero."""
    return run.with_columns(q2=run.columns["q2"] + 0.5)


def gains(run: Recorded) -> Recorded:
    """A motor that is taken for a fifth stronger."""
    return run.with_columns(tau2=1.2 * run.columns["tau2"])


@pytest.mark.parametrize(("change", "joints"), [(lost_home, (1,)), (gains, (2,))])
def test_a_run_of_another_state_is_told(
    change: Callable[[Recorded], Recorded], joints: tuple[int, ...], links: Regressors, tmp_path: Path
) -> None:
    some = runs(links, 3)
    some[1] = change(some[1])
    (note,) = notes(links, saved(tmp_path, some))
    assert note.startswith(f"{tmp_path / 'b.csv'} does not agree with the other runs on joint {joints[0]} (a fit ")
    assert all(f"joint {joint} (a fit " in note for joint in joints)
    (of_two,) = notes(links, saved(tmp_path, some[:2]))
    assert of_two.startswith(f"{tmp_path / 'a.csv'} and {tmp_path / 'b.csv'} do not agree on joint ")


def test_of_two_runs_one_alone_may_foresee_the_other() -> None:
    """A short run foresees little of a long one: what is odd in one direction is told of both."""
    loud, unsure = (Foreseen(0, 100.0, 100.0, 50.0, 150.0, noise, uncertain) for noise, uncertain in ((1, 0), (1, 40)))
    assert (loud.odd, unsure.odd) == (True, False)
    for each in ([[loud], [unsure]], [[unsure], [loud]]):
        assert odd_of_two(each) == [loud]


def test_little_of_a_torque_that_hardly_changes_is_not_odd() -> None:
    """A gain that drifts by a hundredth where a joint holds a weight."""
    assert not Foreseen(0, 1000.0, 30.0, 10.0, 2000.0, 0.1, 0.0).odd
    assert not Foreseen(0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0).odd


def test_a_payload_of_which_nothing_is_said_is_told(links: Regressors, tmp_path: Path) -> None:
    some = runs(links, 4)
    point = [0, 0, 0, 0, 0, 0, 0, 0, 0, 3.0]
    some[3] = recorded(links, TRUTH, seed=4, noise=0.01, payload=point)
    (note,) = notes(links, saved(tmp_path, some))
    assert note.startswith(f"{tmp_path / 'd.csv'} does not agree with the other runs on joint 1 (")
    assert " and joint 2 (" in note


def test_each_of_several_odd_runs_is_told_and_no_other(links: Regressors, tmp_path: Path) -> None:
    some = runs(links, 6)
    some[0], some[3] = lost_home(some[0]), gains(some[3])
    told = notes(links, saved(tmp_path, some))
    assert {Path(note.split(" does ")[0]).name for note in told} == {"a.csv", "d.csv"}


def played(
    links: Regressors, truth: Mapping[str, float], seed: int, size: float = 1.0, noise: float = 0.01
) -> Recorded:
    """A run of ``size`` times the usual motion, with friction that falls at low speeds, which the model lacks."""
    t, usual = fourier(links.model.robot, 20.0, 200.0, seed)
    middle = usual.q.mean(axis=1)[:, None]
    motion = Motion(middle + size * (usual.q - middle), size * usual.qd, size * usual.qdd)
    tau = links.torques(truth, motion)
    dry = np.array([[truth["Fc1"]], [truth["Fc2"]]])
    tau += 0.2 * dry * np.sign(motion.qd) * np.exp(-((motion.qd / 0.15) ** 2))
    tau += noise * tau.std(axis=1)[:, None] * np.random.default_rng(seed).normal(size=tau.shape)
    return as_recorded(links, t, motion.q, tau)


def test_runs_of_other_sizes_noise_and_warmth_agree(links: Regressors, tmp_path: Path) -> None:
    warm = {**TRUTH, **{name: 0.85 * value for name, value in FRICTION.items()}}
    some = [
        played(links, TRUTH, 1),
        played(links, TRUTH, 2, size=0.4),
        played(links, warm, 3),
        played(links, warm, 4, size=0.6),
        played(links, TRUTH, 5, noise=0.2),
    ]
    paths = saved(tmp_path, some)
    for each in (paths, paths[:2], paths[:3:2], paths[1:4:2], paths[::4]):
        assert not notes(links, each)


def test_a_joint_that_stands_still_in_the_others_is_not_compared(links: Regressors, tmp_path: Path) -> None:
    t, moving = fourier(links.model.robot, 20.0, 200.0, 2)
    still = Motion(*(np.array([[1.0], [0.0]]) * one for one in (moving.q, moving.qd, moving.qdd)))
    tau = links.torques(TRUTH, still)
    tau += 0.01 * tau.std() * np.random.default_rng(0).normal(size=tau.shape)
    some = [runs(links, 1)[0], as_recorded(links, t, still.q, tau)]
    assert not notes(links, saved(tmp_path, some))
    odd = [some[0], some[1].with_columns(tau1=1.1 * some[1].columns["tau1"])]
    (note,) = notes(links, saved(tmp_path, odd))
    assert "do not agree on joint 1 (" in note


def test_a_payload_that_is_estimated_is_of_the_runs_that_carry_it(links: Regressors, tmp_path: Path) -> None:
    """Five runs of which three carry it and say so; then one of these that says so and does not."""
    point = [0, 0, 0, 0, 0, 0, 0.4, 0, 0, 1.0]
    some = [recorded(links, TRUTH, seed=k, noise=0.01, payload=point if k > 2 else None) for k in range(1, 6)]
    paths = saved(tmp_path, some)
    for one in paths[2:]:
        one.with_suffix(".yaml").write_text("payload: {name: box}\n")
    assert not notes(links, paths)
    recorded(links, TRUTH, seed=5, noise=0.01).save(paths[4])
    (note,) = notes(links, paths)
    assert note.startswith(f"{paths[4]} does not agree with the other runs on joint ")


def test_friction_that_builds_up_over_a_way_is_another_in_warm_runs(tmp_path: Path) -> None:
    """Presliding in the model: its amplitude is friction, which may differ from run to run."""
    path = tmp_path / "presliding.yaml"
    path.write_text(TWO_LINKS + "  - {effect: dahl_friction, joint: 1, values: {xs: 0.01 rad}}\n")
    bristle = Regressors(read(path))
    (name,) = {*bristle.names} - {*TRUTH}
    some = [recorded(bristle, {**TRUTH, name: size}, seed=k, noise=0.01) for k, size in enumerate((40, 20, 40), 1)]
    paths = saved(tmp_path, some)
    assert not notes(bristle, paths)
    lost_home(some[1]).save(paths[1])
    (note,) = notes(bristle, paths)
    assert note.startswith(f"{paths[1]} does not agree with the other runs on joint 1 (")
