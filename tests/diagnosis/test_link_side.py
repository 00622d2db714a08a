"""The link beyond a drive train: its drag, the split between it and the rotor, and swings that settle beside the model.

The simulated robot integrates its drive trains as differential equations and shares no code with the diagnosis.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any, cast

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.candidates import backlash, elasticity
from identification.diagnosis.columns.bank import Bank, Variant
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.columns.whitening import Colour
from identification.diagnosis.runs.link_side import LinkSides, Train, link_side, without_drive_train
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.rotor import rotor_inertia, rotor_is_told
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.settling import settled, swinging
from identification.diagnosis.search.tried import at_end
from identification.diagnosis.search.weighing import Weighing
from identification.observation import Regressors
from identification.recipes import Recipe
from tests.diagnosis.diagnosed import CLEAN, Found, Known, known, with_robot
from tests.diagnosis.soft_arm import COMPLIANCE, NAME, ROTOR
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier
from tests.recorded import TRUTH as LINKS
from tests.recorded import TWO_LINKS

GAP = 4e-4


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(ROBOTS[NAME], tmp_path_factory.mktemp("robot"))


@pytest.fixture(scope="module")
def loose(robot: Known) -> Scene:
    """A run with play in the first drive train."""
    way = fourier(2, period=10.0, periods=1, before=2.0)
    return robot.scene(make_run(ROBOTS[NAME], way, [Effect("backlash", 1, GAP)], sensors=CLEAN))


@pytest.fixture(scope="module")
def soft(robot: Known) -> Scene:
    """A run with a soft first drive train, of a robot of which no parameter set tells the rotors."""
    way = fourier(2, period=10.0, periods=1, before=2.0)
    effect = Effect("joint_flexibility", 1)
    return untold(
        robot.scene(make_run(ROBOTS[NAME], way, [effect.sized(COMPLIANCE)], sensors=replace(CLEAN, noise=0.01)))
    )


def untold(scene: Scene) -> Scene:
    return with_robot(scene, replace(scene.robot, parameter_sets={}))


def offered(scene: Scene, joint: int, candidate: ModuleType = backlash) -> Hypothesis:
    (found,) = [one for one in candidate.hypotheses([scene]) if one.joint == joint]
    return found


def test_a_link_is_dragged_as_its_inertia_grows(loose: Scene) -> None:
    """d/dt (M qd) holds M' qd: what the load changes by with the speed is the inertia's rate."""
    side = link_side(loose, 0, ROTOR)
    rate = loose.derivative(side.inertia)
    assert np.ptp(rate) > 0.1 * float(np.mean(side.inertia))
    np.testing.assert_allclose(side.drag[50:-50], rate[50:-50], atol=0.02 * float(np.abs(rate).max()))


@pytest.mark.parametrize("samples", [8, 12, 40])
def test_a_link_swings_as_it_does_in_time_at_few_samples_a_period(samples: int, loose: Scene) -> None:
    """Under a load of a third of its frequency it swings by itself, w^2 = k/M, and with the load."""
    inertia, size, still = 4.0, 30.0, np.zeros(loose.motion.samples)
    w, t = 2 * np.pi / (samples * loose.period), loose.period * np.arange(len(still))
    side = replace(
        link_side(loose, 0, ROTOR),
        load=size * np.cos(w / 3 * t),
        by_acceleration=np.tile(still + inertia, (4, 1)),
        by_speed=still[None],
    )
    k = inertia * w**2
    moved = side.deflection(Train(k, 0.0))
    first = slice(1, 30 * samples)
    waves = np.array([np.cos(w * t), np.sin(w * t), np.cos(w / 3 * t), np.sin(w / 3 * t)])[:, first]
    sizes, *_ = np.linalg.lstsq(waves.T, moved.q[0, first], rcond=None)
    np.testing.assert_allclose(sizes @ waves, moved.q[0, first], atol=5e-3 * size / k)
    np.testing.assert_allclose(sizes[2:], [-size / (k - k / 9), 0.0], atol=1e-3 * size / k)
    assert np.hypot(*sizes[:2]) > 0.1 * size / k
    faster = -sizes * np.repeat([w**2, w**2 / 9], 2)
    np.testing.assert_allclose(moved.qdd[0, first], faster @ waves, atol=5e-3 * size / inertia)


@pytest.mark.parametrize(
    ("gap", "x", "follows"),
    [(GAP, 3.8, True), (GAP, 4.2, False), (0.0, 7.0, True), (0.0, 8.0, False), (0.0, 40.0, False)],
)
def test_a_link_is_played_only_where_the_samples_follow_it(gap: float, x: float, follows: bool, loose: Scene) -> None:
    """``x`` is k h^2 / M where the link's inertia M is least, for a tenth of the run a third of what it is."""
    side = link_side(loose, 0, rotor_inertia(loose, 0))
    inertia = side.by_acceleration.copy()
    inertia[0, : side.load.size // 10] /= 3
    side = replace(side, by_acceleration=inertia)
    train = Train(x * side.inertia.min() / loose.period**2, 0.01, gap)
    e = side.deflection(train).q[0]
    most = np.abs(side.load).max() / train.stiffness + gap
    assert np.abs(e).max() < 100 * most if follows else np.isnan(e).all()


def test_a_link_without_inertia_is_not_played(loose: Scene) -> None:
    side = link_side(loose, 0, rotor_inertia(loose, 0))
    with_none = replace(side, by_acceleration=side.by_acceleration - side.inertia.min())
    assert np.isnan(with_none.deflection(Train(100.0, 0.1)).q[0]).all()


def test_the_rotors_share_moves_load_and_inertia(loose: Scene) -> None:
    first, anew = link_side(loose, 0, ROTOR), link_side(loose, 0, 0.8 * ROTOR)
    moved = LinkSides(first).along(loose, 0.8 * ROTOR)
    assert np.mean(moved.inertia) > np.mean(first.inertia)
    train = Train(1e5, 0.1, GAP)
    for name in ("load", "by_position", "by_speed", "by_acceleration"):
        np.testing.assert_allclose(getattr(moved, name), getattr(anew, name), atol=1e-6, err_msg=name)
    np.testing.assert_allclose(moved.deflection(train).q, anew.deflection(train).q, atol=1e-9)


@pytest.mark.long
def test_a_rotor_is_searched_where_it_is_grouped_with_its_link(loose: Scene) -> None:
    """What the file says of it is where the search begins; where it says nothing, several shares are tried."""
    told = offered(loose, 1)
    assert told.shapes[0].name == "Iam"
    assert "Iam" not in told.given
    assert all(one["Iam"] == pytest.approx(ROTOR) for one in told.variants)
    (inertia,) = [one for one in told.shapes if one.name == "Iam"]
    assert inertia.low < ROTOR < inertia.high
    sought = offered(untold(loose), 1)
    assert {one["Iam"] for one in sought.variants} != {ROTOR}
    assert all(inertia.low < one["Iam"] < 1.1 * inertia.high for one in sought.variants)


@pytest.mark.parametrize(("name", "value"), [("ZZ1R", 1.0), ("ZZ1R", -1.0), ("ZZ2R", 0.5), ("MX2R", -1.5)])
def test_a_rotor_of_which_nothing_is_known_is_half_of_the_least_inertia(name: str, value: float, loose: Scene) -> None:
    """Whatever the base parameters are: those of a free fit need not be possible."""
    scene = replace(untold(loose), values={**loose.values, name: value * loose.values[name]})
    rotor = rotor_inertia(scene, 0)
    assert rotor == pytest.approx(0.5 * float(link_side(scene, 0, 0.0).inertia.min()))
    assert float(link_side(scene, 0, rotor).inertia.min()) == pytest.approx(rotor)


def test_a_rotor_that_the_file_lacks_is_in_the_base_parameters_all_the_same(loose: Scene) -> None:
    """Where they hold it: with its link as with the file's, and taken from the same ones."""
    effects = tuple(use for use in loose.robot.effects if use.effect != "rotor_inertia")
    bare = Regressors(replace(loose.robot, effects=effects, parameter_sets={}))
    with_rotors = untold(loose).regressors
    assert bare.rotors[0] == pytest.approx({"ZZ1R": 1.0})
    assert [bool(one) for one in bare.rotors] == [
        any(f"Ia{number}" in terms and len(terms) > 1 for terms in with_rotors.model.grouping.numeric().values())
        for number in loose.robot.numbers
    ]
    lacking = replace(loose, regressors=bare, values={name: loose.values.get(name, 0.0) for name in bare.names})
    side, told = link_side(lacking, 0, ROTOR), link_side(untold(loose), 0, ROTOR)
    np.testing.assert_allclose(side.inertia, told.inertia, rtol=1e-9)
    assert rotor_inertia(lacking, 0) == pytest.approx(rotor_inertia(untold(loose), 0))


def test_a_rotor_that_was_found_as_an_effect_is_no_share_of_the_link(loose: Scene) -> None:
    scene = replace(untold(loose), beside=Found({"Ia1": 2.5}))
    assert rotor_inertia(scene, 0) == 2.5
    assert rotor_is_told(scene, 0)
    side = link_side(scene, 0, 2.5)
    np.testing.assert_array_equal(side.with_rotor(1.0).load, side.load)


def test_how_a_soft_link_swings_tells_the_rotors_share(soft: Scene) -> None:
    """From half of the inertia, beside base parameters that hold both."""
    found = offered(soft, 1, elasticity)
    assert [one.name for one in found.shapes] == ["Iam", "k", "damping"]
    assert all(one["Iam"] != pytest.approx(ROTOR, rel=0.1) for one in found.variants)
    one = prepared(soft.sampled.run, Recipe(), soft.regressors)
    bank = Bank([one, one], [replace(soft, sampled=one.sampled)] * 2)
    begun = [bank.add(found, shape) for shape in found.variants]
    bank.whiten([[Colour((np.ones(1),), (0.05,))] * bank.dof] * 2)
    weighing = Weighing(bank, [0], [1], None)
    start = weighing.best_shape([one for one in begun if one is not None], []).variant
    (settled_train,), _, acting = settled(weighing, [start])
    assert settled_train.shape["Iam"] == pytest.approx(ROTOR, rel=0.1)
    assert settled_train.shape["k"] == pytest.approx(1 / COMPLIANCE, rel=0.05)
    assert acting.coefficients["compliance1"] == pytest.approx(COMPLIANCE, rel=0.05)


@pytest.mark.parametrize(("gap", "closed"), [(4e-4, False), (2e-5, True)])
def test_a_gap_that_opens_less_than_the_drive_train_gives_way_is_none(gap: float, closed: bool, loose: Scene) -> None:
    """Elasticity alone does as much, and has no gap to fit beside."""
    one = offered(loose, 1)
    (low,) = [each.low for each in one.shapes if each.name == "gap"]
    assert low < 1e-5
    assert at_end(Variant(one, {**one.variants[0], "gap": gap, "k": 2e3}, (), (0,))) == closed


@pytest.mark.parametrize(
    ("errors", "off"), [pytest.param((0.0,), 0.03, marks=pytest.mark.long), (backlash.ERRORS, 0.05)]
)
def test_swings_settle_beside_the_base_parameters(
    errors: tuple[float, ...], off: float, loose: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From a rotor and inertias that are wrong both come near the truth, and the gap with them: nearer if the torque is
    no mean over errors of the load, of which this run has none.
    """
    monkeypatch.setattr(backlash, "ERRORS", errors)
    one = prepared(loose.sampled.run, Recipe(), loose.regressors)
    wrong = {name: value * (1.03 if name == "ZZ1R" else 1.0) for name, value in loose.values.items()}
    scene = replace(loose, sampled=one.sampled, values=wrong)
    told = offered(loose, 1)
    truth = told.variants[0]
    bank = Bank([one, one], [scene, replace(scene)])
    shape = {**truth, "Iam": 0.98 * ROTOR, "gap": 1.1 * GAP}
    start = bank.add(told, shape)
    assert start is not None
    assert swinging([start])
    bank.whiten([[Colour((np.ones(1),), (1.0,))] * bank.dof] * 2)
    (found,), values, acting = settled(Weighing(bank, [0], [1], None), [start])
    assert values["ZZ1R"] == pytest.approx(loose.values["ZZ1R"], rel=0.005)
    assert found.shape["Iam"] == pytest.approx(ROTOR, rel=0.01)
    assert found.shape["gap"] == pytest.approx(GAP, rel=off)
    assert acting.coefficients["gap1"] == pytest.approx(GAP, rel=0.05)


@pytest.mark.parametrize("stated", [True, False])
def test_a_rotor_is_taken_from_what_holds_it(stated: bool, tmp_path: Path) -> None:
    """One that was found beside a file without the effect is in no base parameter; what a file's holds is there."""
    path = tmp_path / "two_links.yaml"
    rotors = "  - {effect: rotor_inertia, joints: all}\n"
    path.write_text(TWO_LINKS if stated else TWO_LINKS.replace(rotors, ""))
    regressors = Regressors(read(path))
    ((holds, per_inertia),) = regressors.rotors[0].items()
    values = {name: LINKS.get(name, 9.0) for name in regressors.names}
    beside, none = (
        replace(scene, beside=found)
        for scene in [Scene(cast(Any, None), regressors, values)]
        for found in (Found({"Ia1": 2.0}), None)
    )
    for scene, taken in ((none, True), (beside, stated)):
        left = without_drive_train(scene, 0, 2.0)[holds]
        assert left == pytest.approx(values[holds] - 2.0 * per_inertia * taken)
