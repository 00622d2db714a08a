"""Drive trains that the robot's file says are elastic: their torques are known, and hide nothing else."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy

from generator.robot.description import EffectUse, ParameterSet, ParameterValue, Quantity
from generator.robot.description import Robot as Described
from generator.robot.readers import read
from identification import recipes
from identification.dataset import load
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis, diagnose
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.roles import roles
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.runs.stated_elasticity import (
    Stated,
    columns,
    damped,
    moved,
    names,
    precision,
    stated,
    torque,
)
from identification.observation import Regressors
from tests.diagnosis.diagnosed import CLEAN, Known, known, rows, with_robot
from tests.diagnosis.diagnosed_arm import ARM as ARM_OF_ONE
from tests.diagnosis.diagnosed_arm import diagnosis_of, recorded
from tests.diagnosis.diagnosed_arm import torque as hidden
from tests.plant.effect import Effect
from tests.plant.robot import Array
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import Run, write_csv
from tests.plant.simulate import make_run, own_effects
from tests.plant.trajectories.fourier import fourier
from tests.plant.trajectories.point_to_point import point_to_point
from tests.plant.trajectory import Trajectory
from tests.recorded import parameters_text

ARM = "three_axis"
SOFT = 2.0


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(ROBOTS[ARM], tmp_path_factory.mktemp("arm"))


def told(arm: Known, stiffness: dict[int, float], gap: float = 0.0) -> Described:
    """The arm's robot whose file states stiffnesses by joint, and a gap of joint 2."""
    robot = arm.regressors.model.robot
    values = {f"k{j}": ParameterValue(k, "N m/rad") for j, k in stiffness.items()}
    sets = {**robot.parameter_sets, "stiff": ParameterSet("stiff", "", "", values)}
    uses = [EffectUse("joint_elasticity", (2,), {"gap": Quantity(sympy.Float(gap), "rad")})] if gap else []
    return replace(robot, flexible=tuple(stiffness), parameter_sets=sets, effects=(*robot.effects, *uses))


def scene_of(arm: Known, run: Run, stiffness: dict[int, float], gap: float = 0.0) -> Scene:
    """A run beside the model of the arm whose file states that."""
    scene = arm.scene(run)
    assert scene.model_torque.any()  # the rigid code is made before the file says more
    return with_robot(scene, told(arm, stiffness, gap))


def soft(name: str) -> list[Effect]:
    """Every joint on an elastic drive train, softer than usual."""
    return [Effect("joint_flexibility", j, SOFT / one.stiffness) for j, one in enumerate(ROBOTS[name].chain, 1)]


def test_a_drive_train_is_stated_by_the_list_of_joints_and_a_stiffness(arm: Known) -> None:
    robot = arm.regressors.model.robot
    assert stated(robot) == []
    assert names(robot) == ()
    assert stated(replace(robot, flexible=(1, 2))) == []
    both = told(arm, {1: 2e5, 3: 9e4})
    assert stated(both) == [Stated(0, 1, 2e5), Stated(2, 3, 9e4)]
    assert stated(replace(both, flexible=(3,))) == [Stated(2, 3, 9e4)]
    assert names(both) == ("elasticity", "stiffness1", "damping1", "stiffness3", "damping3")
    loose = told(arm, {1: 2e5, 2: 3e5}, gap=1e-3)
    assert stated(loose) == [Stated(0, 1, 2e5), Stated(1, 2, 3e5, 1e-3)]
    assert names(loose) == ("elasticity", "stiffness1", "damping1", "backlash2", "stiffness2", "damping2", "gap2")


def compared(scene: Scene) -> tuple[Array, Array]:
    """Columns (c x M) and what the model leaves (M), joints by their torque, in rows after the swings of the start.

    Slow rows are left out: close to standstill the plant's friction is not the model's.
    """
    late = slice(round(1.5 / scene.period), None)
    moving = rows(np.abs(scene.motion.qd)[:, late]) > 0.3 * np.sqrt(np.mean(scene.motion.qd**2, axis=1))[:, None]
    scale = np.sqrt(np.mean(scene.tau**2, axis=1))[:, None]
    made, left = rows(columns(scene)[:, :, late]), rows((scene.tau - scene.model_torque)[:, late])
    return (made / scale)[:, moving], (left / scale)[moving]


@pytest.mark.parametrize("way", [fourier(4, period=5.0, periods=2), point_to_point(4, 10.0)])
def test_links_swing_together_as_the_plant_s_do(way: Trajectory, arm: Known) -> None:
    """Three elastic joints of the simulated robot, of which the model knows the stiffness and not the damping; beside
    it stays what it leaves of the rigid robot.
    """
    stiffness = {j: one.stiffness / SOFT for j, one in enumerate(arm.robot.chain, 1)}
    made, left = compared(scene_of(arm, make_run(arm.robot, way, soft(ARM), sensors=CLEAN), stiffness))
    _, rigid = compared(scene_of(arm, make_run(arm.robot, way, sensors=CLEAN), stiffness))
    x = np.linalg.lstsq(made.T, left, rcond=None)[0]
    assert np.linalg.norm(rigid) < 0.2 * np.linalg.norm(left)
    assert np.linalg.norm(left - x @ made) < 0.15 * np.linalg.norm(left) + np.linalg.norm(rigid)
    assert x[0] == pytest.approx(1.0, abs=0.1)
    assert np.max(np.abs(x[1::2])) < 0.1


def test_a_gap_of_the_file_is_crossed(arm: Known) -> None:
    gap = 4e-4
    hidden = Effect("backlash", 2, gap)
    run = make_run(arm.robot, fourier(2, period=10.0, periods=1, before=2.0), [hidden], sensors=CLEAN)
    stiffness = hidden.value("stiffer", arm.robot) * arm.robot.chain[1].stiffness
    scene = scene_of(arm, run, {2: stiffness}, gap)
    made = rows(columns(scene)[:, 1])
    left = rows((scene.tau - scene.model_torque)[1])
    moving = rows(np.abs(scene.motion.qd)[1]) > 0.1 * np.sqrt(np.mean(scene.motion.qd[1] ** 2))
    x = np.linalg.lstsq(made[:, moving].T, left[moving], rcond=None)[0]
    assert np.linalg.norm((left - x @ made)[moving]) < 0.5 * np.linalg.norm(left[moving])
    assert x[0] == pytest.approx(1.0, abs=0.2)


def test_the_torque_that_plays_is_the_columns_by_what_the_values_say(arm: Known) -> None:
    """With the weights that a fit of the columns has, and nothing where the values do not say that it shows."""
    run = make_run(arm.robot, fourier(4, period=5.0, periods=2), soft(ARM), sensors=CLEAN)
    scene = scene_of(arm, run, {j: one.stiffness / SOFT for j, one in enumerate(arm.robot.chain, 1)})
    assert not torque(scene).any()
    said = {**scene.values, "elasticity": 0.7, **damped(1, 0.1), **damped(2, 0.02), "stiffness3": 0.1}
    usual = columns(replace(scene, values=said))[0]
    np.testing.assert_allclose(torque(replace(scene, values=said)), 0.7 * usual, rtol=1e-9)
    loose = scene_of(arm, run, {2: 2e5}, gap=4e-4)
    assert not torque(loose).any()
    said = {**scene.values, "backlash2": 0.9, **damped(2, 0.1)}
    usual = columns(replace(loose, values=said))[0]
    np.testing.assert_allclose(torque(replace(loose, values=said)), 0.9 * usual, rtol=1e-9)


def test_columns_are_nothing_before_the_model_has_values(arm: Known) -> None:
    run = make_run(arm.robot, fourier(4, period=5.0, periods=1), sensors=CLEAN)
    scene = scene_of(arm, run, {1: 2e5, 2: 3e5}, gap=1e-3)
    for values in ({}, dict.fromkeys(arm.values, 0.0)):
        assert not columns(replace(scene, values=values)).any()
    assert columns(scene).any(axis=(1, 2)).all()


def test_a_gap_whose_link_swings_faster_than_the_samples_adds_nothing(tmp_path: Path) -> None:
    """A link slow enough fills the same columns."""
    text = ARM_OF_ONE.replace("joints:\n", "flexible: [1]\njoints:\n", 1)
    gap = "  - {effect: joint_elasticity, joint: 1, values: {gap: 1 mrad}}\n"
    for stiffness, follows in ((1e4, True), (1e9, False)):
        regressors, sources = recorded(
            tmp_path, [hidden("")] * 2, text + gap + parameters_text({"s": {"k1": stiffness}})
        )
        found = diagnosis_of(sources, regressors)
        assert found.verdict == NOTHING
        told = "the drive train of joint 1 is too stiff for the samples to follow, and taken as rigid"
        assert (told in found.notes) != follows
        scene = found.search.bank.scenes[0]
        assert columns(scene).any(axis=(1, 2)).all() == follows


def test_values_move_by_what_the_columns_weigh() -> None:
    old = {"stiffness1": 0.1, "damping1": -0.2, "XX1": 3.0}
    new = {"XX1": 4.0, "elasticity": 0.5, "stiffness1": 0.05, "damping1": 5.0, "gap2": 0.1, "backlash2": 2.0}
    result = moved(old, new)
    assert result["XX1"] == 4.0
    assert result["stiffness1"] == pytest.approx(0.2)
    assert result["damping1"] == pytest.approx(0.1)
    assert result["gap2"] == pytest.approx(0.05)
    assert moved(old, {**new, "elasticity": 0.01})["stiffness1"] == 0.1


def test_only_what_a_drive_train_may_differ_in_is_known_beforehand() -> None:
    assert precision("elasticity") == precision("backlash2") == 0.0
    assert 0 < precision("damping3") < precision("stiffness3") < precision("gap1")


def found(folder: Path, elastic: bool, hidden: tuple[Effect, ...] = ()) -> Diagnosis:
    """Of an arm whose file states the stiffness of every joint, 5 % wrong."""
    robot = ROBOTS[ARM]
    text = robot_file(robot).replace("joints:\n", "flexible: [1, 2, 3]\njoints:\n", 1)
    for j, one in enumerate(robot.chain, 1):
        text += f"      k{j}: {{value: {1.05 * one.stiffness / SOFT!r}, unit: N m/rad}}\n"
    path = folder / "arm.yaml"
    path.write_text(text, encoding="utf-8")
    own = [*own_effects(robot), *(soft(ARM) if elastic else [])]
    sources = []
    for seed in range(1, 5):
        way = fourier(seed, period=5.0, periods=3) if seed % 2 else point_to_point(seed, 15.0)
        sources.append(str(folder / f"{seed}.csv"))
        write_csv(make_run(robot, way, hidden, seed=seed, own=own), Path(sources[-1]))
    description = read(path)
    regressors, recipe = Regressors(description), recipes.recipe_of(robot.name)
    runs = [load(source, description, recipe.columns) for source in sources]
    ready = [prepared(one, recipe, regressors) for one in runs]
    return diagnose(regressors, ready, roles(runs[:3], runs[3:], [], tested=False))


def test_elastic_joints_that_the_file_states_are_no_discrepancy(tmp_path: Path) -> None:
    one = found(tmp_path, elastic=True)
    assert (one.verdict, one.findings) == (NOTHING, ())
    assert any("the drive trains of joints 1 to 3 are elastic in the robot's file" in note for note in one.notes)
    assert not any("stiffer than stated" in note for note in one.notes)
    assert one.search.values["elasticity"] == pytest.approx(1.0, abs=0.1)
    assert one.search.values["stiffness2"] == pytest.approx(-np.log(1.05), abs=0.03)


@pytest.mark.long
def test_rigid_joints_that_the_file_calls_elastic_are_told(tmp_path: Path) -> None:
    one = found(tmp_path, elastic=False)
    assert (one.verdict, one.findings) == (NOTHING, ())
    assert any("these drive trains are stiffer than stated" in note for note in one.notes)


@pytest.mark.long
def test_another_effect_is_found_beside_elastic_joints(tmp_path: Path) -> None:
    one = found(tmp_path, True, (Effect("stribeck", 2, 0.75 * ROBOTS[ARM].chain[1].coulomb),))
    assert one.verdict == NAMED
    assert [(each.hypothesis.effect, each.joints) for each in one.findings] == [("stribeck_friction", (2,))]
