"""What speaks for a hypothesis, where a part of the data or the end of a shape would speak for another."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from identification.dataset import load
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.more_than_noise import more_than_noise
from identification.diagnosis.search.selection import Selection
from identification.diagnosis.search.weighing import Weighing
from identification.recipes import Recipe
from tests.diagnosis.drawn_data import RUNS, TRAIN, VALIDATE, Data, fixed, names, search
from tests.matrices import WHITE, hypothesis
from tests.recorded import TRUTH, Array, recorded, two_links


@pytest.mark.parametrize(("true", "found"), [(0.1, set()), (1.0, {"shaped"})])
def test_what_has_vanished_is_another_effect(true: float, found: set[str]) -> None:
    """Though the search goes on anywhere in the range."""
    data = Data(12)
    x = data.column()
    shape = ShapeRange("v", "1", 0.4, 3.2, 4, step=0.3, vanishing=True)
    law = np.stack([2.0 * np.exp(-((x[r] - np.log(true)) ** 2) / 8) for r in range(RUNS)])
    hidden = hypothesis("shaped", lambda r, given: np.exp(-((x[r] - np.log(given["v"])) ** 2) / 8), [shape])
    assert names(search(data.bank(law, [hidden]))) == found


def test_more_than_noise_is_left_until_it_is_explained() -> None:
    """A half of the noise, a quarter of its power."""
    data = Data(8)
    column = data.column()
    one = data.bank(0.5 * column, [fixed("a", column)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    assert more_than_noise(weighing, [], range(one.dof), 0.1)
    assert not more_than_noise(weighing, [], range(one.dof), 0.4)
    assert not more_than_noise(weighing, one.variants, [0], 0.1)
    assert not more_than_noise(weighing, [], [], 0.0)


def test_nothing_is_gained_by_what_single_runs_hardly_show() -> None:
    """What the model all but takes up is taken as unseen: in all runs together, or in none of them."""
    data = Data(13)
    rest = data.column()
    steep = np.array([0.0096, 0.0096, 0.0125])[:, None] * rest
    column = data.base[:, 0] + steep
    effect = 60.0 * column
    one = data.bank(effect, [fixed("steep", column)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    gain = weighing.gain(one.variants[0], [])
    assert gain == pytest.approx(60.0**2 * float(np.sum(steep[2] ** 2)), rel=0.3)


def test_a_joint_has_one_balancer() -> None:
    """Though two together would do better: no robot file has them."""
    data = Data(14)
    first, second = data.column(), data.column()
    offered = [fixed("gas_balancer", first), fixed("spring_balancer", second)]
    assert names(search(data.bank(3.0 * first + 2.8 * second, offered))) == {"gas_balancer"}


def test_what_is_at_its_bounds_hides_none_of_the_others() -> None:
    """Evidence beside two, one of them without a column, is that beside the other."""
    data = Data(15)
    first, second, none = data.column(), data.column(), data.column()
    one = data.bank(3.0 * first, [fixed("first", first), fixed("second", second), fixed("none", none)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    a, b, c = one.variants
    alone = weighing.of(b, [a])
    beside = weighing.of(b, [a, c.only([])])
    assert beside.drop == pytest.approx(alone.drop)
    assert beside.why_not == alone.why_not


@pytest.mark.parametrize(("more", "found"), [(0.02, {"viscous_friction", "coulomb_friction"}), (2.0, {"rare"})])
def test_two_common_effects_stand_in_the_place_of_a_rare_one(more: float, found: set[str]) -> None:
    """That explains by itself what they do together, and hardly more."""
    data = Data(16)
    viscous, coulomb, law = data.column(), data.column(), data.column()
    rare = viscous + coulomb + more * law
    common = [fixed("viscous_friction", viscous), fixed("coulomb_friction", coulomb)]
    one = data.bank(3.0 * rare, [*common, fixed("rare", rare)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    chosen = Selection(weighing).search([one.variants[2]])
    assert names(chosen) == found


def test_an_effect_is_as_large_as_on_the_joints_on_which_it_acts(tmp_path: Path) -> None:
    """What it makes of another joint, as a wrong ratio does by the positions, leaves its size as it is."""
    of = two_links(tmp_path)
    source = recorded(of, TRUTH, 20.0, 200.0, 1).save(tmp_path / "run.csv")
    run = prepared(load(str(source), of.model.robot, resting=True), Recipe(), of)
    scene = Scene(run.sampled, of, TRUTH)
    kink = np.abs(scene.motion.q[1] - scene.motion.q[1].mean())

    def size(part: float) -> float:
        torque = np.stack([part * kink, kink])
        mine = replace(run, tau=run.tau + 3.0 * run.decimated(torque))
        bank = Bank([mine, mine], [scene, replace(scene)])
        variant = bank.add(
            Hypothesis("kink", "kink", 2, (Coefficient("kink2", "N m", None, None),), lambda *_: torque[None]), {}
        )
        assert variant is not None
        bank.whiten([[WHITE] * 2] * 2)
        found = Weighing(bank, [0], [1], None).of(variant, [])
        left = np.array([one @ one for one in beside_the_model(bank, found.coefficients[0])])
        own = left[list(variant.coordinates)]
        sizes = np.sqrt(left.sum() * own / own.sum() / bank.rows(0)[list(variant.coordinates)])
        assert [found.sizes[k] for k in variant.coordinates] == pytest.approx(sizes.tolist(), rel=0.01)
        return found.size

    alone = size(0.0)
    assert alone > 0.3
    assert size(0.03) == pytest.approx(alone, rel=0.15)
    # Of what joint 1 has of it the model takes up the less.
    assert size(0.3) < alone


def beside_the_model(bank: Bank, value: float) -> list[Array]:
    """Of the first run's joints, what least squares over the base columns leave of the last column times a value."""
    rows = []
    for k in range(bank.dof):
        numbers, white = bank.white(0, k)
        of = np.zeros((bank.count, white.shape[1]))
        of[numbers] = white[:-1]
        rows.append(of)
    W = np.concatenate(rows, axis=1)
    size = np.linalg.norm(W[:-1], axis=1)
    A = (W[:-1] / np.where(size > 0, size, 1.0)[:, None]).T
    left = value * (W[-1] - A @ np.linalg.lstsq(A, W[-1], rcond=1e-5)[0])
    return np.split(left, [rows[0].shape[1]])
