"""The search on matrices whose answer is known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.columns.orders import likely_orders
from identification.diagnosis.search.invisible import invisible
from identification.diagnosis.search.selection import Selection
from identification.diagnosis.search.weighing import Weighing
from identification.diagnosis.search.whole_orders import UNSURE
from tests.diagnosis.drawn_data import COUNT, RUNS, TRAIN, VALIDATE, Data, fixed, names, search
from tests.matrices import hypothesis, several

Array = NDArray[np.float64]


def crowd(data: Data, count: int = 30) -> list[Hypothesis]:
    return [fixed(f"other{i}", data.column()) for i in range(count)]


@pytest.mark.parametrize("seed", range(20))
def test_noise_is_given_no_name(seed: int) -> None:
    data = Data(seed)
    assert search(data.bank(0.0, crowd(data))) == []


@pytest.mark.parametrize("seed", range(5))
def test_what_is_there_is_found_and_nothing_else(seed: int) -> None:
    data = Data(100 + seed)
    right = data.column()
    (found,) = search(data.bank(0.4 * right, [*crowd(data), fixed("right", right)]))
    evidence = found.evidence
    assert evidence.variant.hypothesis.effect == "right"
    assert evidence.coefficients == pytest.approx([0.4], abs=0.1)
    # Drop, size and validation as sums over the columns themselves.
    W = np.concatenate([data.base[r] for r in TRAIN], axis=1).T
    y = np.concatenate(
        [(np.tensordot([3.0, -1.0, 0.5], data.base[r], 1) + 0.4 * right[r] + data.noise[r]) for r in TRAIN]
    )
    x = np.concatenate([right[r] for r in TRAIN])
    before, after = W, np.column_stack([W, x])
    solutions = [np.linalg.lstsq(A, y, rcond=None)[0] for A in (before, after)]
    misfits = [float(np.sum((y - A @ s) ** 2)) for A, s in zip((before, after), solutions, strict=True)]
    assert evidence.drop == pytest.approx(misfits[0] - misfits[1])
    assert evidence.size == pytest.approx(np.sqrt(evidence.drop / len(y)))
    r = VALIDATE[0]
    held = np.tensordot([3.0, -1.0, 0.5], data.base[r], 1) + 0.4 * right[r] + data.noise[r]
    own = np.column_stack([data.base[r].T, right[r]])
    predicted = [surprise(held, own[:, : A.shape[1]], A, s) for A, s in zip((before, after), solutions, strict=True)]
    assert evidence.validation == pytest.approx(predicted[0] - predicted[1])


def surprise(y: Array, own: Array, fitted: Array, solution: Array) -> float:
    """Square of a prediction's error in parts of what it may be: that of the noise, 1, and that of the parameters."""
    e = y - own @ solution
    V = np.eye(len(y)) + own @ np.linalg.inv(fitted.T @ fitted) @ own.T
    return float(e @ np.linalg.solve(V, e))


def test_without_a_run_that_validates_each_is_predicted_by_the_others() -> None:
    data = Data(300)
    right = data.column()
    bank = data.bank(0.4 * right, [fixed("right", right)])
    everything = (*TRAIN, *VALIDATE)
    (evidence,) = Weighing(bank, everything, (), None).evidence([])
    y = [np.tensordot([3.0, -1.0, 0.5], data.base[r], 1) + 0.4 * right[r] + data.noise[r] for r in everything]
    A = [np.column_stack([data.base[r].T, right[r]]) for r in everything]
    expected = 0.0
    for out in range(len(everything)):
        others = [k for k in range(len(everything)) if k != out]
        for count, sign in ((3, 1.0), (4, -1.0)):
            fitted = np.concatenate([A[k][:, :count] for k in others])
            solution = np.linalg.lstsq(fitted, np.concatenate([y[k] for k in others]), rcond=None)[0]
            expected += sign * surprise(y[out], A[out][:, :count], fitted, solution)
    assert evidence.validation == pytest.approx(expected)


def test_two_that_hide_each_other_are_found_together() -> None:
    """Nearly opposite columns: either alone explains next to nothing."""
    data = Data(7)
    common, apart = data.column(), data.column()
    one, other = common + 0.15 * apart, common - 0.15 * apart
    one, other = one / one.std(), other / other.std()
    effect = 2.0 * one - 2.0 * other
    found = search(data.bank(effect, [fixed("one", one), fixed("other", other), *crowd(data, 10)]))
    assert names(found) == {"one", "other"}


def shaped(base: Callable[[int, float], Array], points: tuple[float, ...]) -> Hypothesis:
    shape = ShapeRange("v", "1", min(points), max(points), points=points)
    return hypothesis("shaped", lambda r, given: base(r, given["v"]), [shape])


def test_a_shape_is_refined_between_the_tried_ones() -> None:
    data = Data(8)
    x = np.abs(data.column())

    def law(r: int, v: float) -> Array:
        return np.asarray(np.exp(-x[r] / v))

    effect = np.stack([2.0 * law(r, 0.29) for r in range(RUNS)])
    (found,) = search(data.bank(effect, [shaped(law, (0.05, 0.15, 0.45, 1.35))]))
    assert found.evidence.variant.shape["v"] == pytest.approx(0.29, rel=0.25)
    assert abs(np.log(found.evidence.variant.shape["v"] / 0.29)) < abs(np.log(0.45 / 0.29))


def test_a_steep_valley_is_followed_though_one_value_is_farther_than_the_other() -> None:
    """Three steps of one for each of the other: a step of both would leave it, be it as short as it may."""
    data = Data(23)
    plain, steep, flat = data.column(), data.column(), data.column()

    def law(r: int, shape: Mapping[str, float]) -> Array:
        return np.asarray(plain[r] + 10 * (shape["a"] - 3 * shape["b"]) * steep[r] + shape["b"] * flat[r])

    ranges = [ShapeRange(name, "1", -10.0, 10.0, log=False, step=1.0) for name in ("a", "b")]
    true = {"a": 4.5, "b": 1.5}
    starting = replace(hypothesis("shaped", law, ranges), starts=({"a": 0.0, "b": 0.0},))
    (found,) = search(data.bank(np.stack([4.0 * law(r, true) for r in range(RUNS)]), [starting]))
    assert found.evidence.variant.shape == pytest.approx(true, rel=0.05)


def test_shapes_that_lean_on_each_other_are_refined_together() -> None:
    """A valley that runs across both values, which steps of one at a time do not follow."""
    data = Data(17)
    x = data.draw.uniform(0.2, 2.0, size=(RUNS, COUNT))

    def law(r: int, shape: Mapping[str, float]) -> Array:
        return np.asarray(x[r] ** shape["a"] * np.exp(-shape["a"] * shape["b"] * x[r]))

    points = {"a": (0.5, 2.0, 8.0), "b": (0.3, 1.2, 5.0)}
    grids = [ShapeRange(name, "1", min(some), max(some), points=some) for name, some in points.items()]
    true = {"a": 3.1, "b": 0.8}
    effect = np.stack([8.0 * law(r, true) for r in range(RUNS)])
    (found,) = search(data.bank(effect, [hypothesis("shaped", law, grids)]))
    assert found.evidence.variant.shape == pytest.approx(true, rel=0.1)


def test_effects_that_overlap_are_refined_beside_each_other() -> None:
    """The shape that is best alone is not the one that is best beside another effect."""
    data = Data(21)
    x = data.draw.uniform(0.0, 5.0, size=(RUNS, COUNT))

    def law(r: int, place: float) -> Array:
        return np.asarray(np.exp(-((x[r] - place) ** 2)))

    def offer(name: str, points: tuple[float, ...]) -> Hypothesis:
        shape = ShapeRange("place", "1", min(points), max(points), log=False, points=points)
        return hypothesis(name, lambda r, given: law(r, given["place"]), [shape])

    effect = np.stack([2.0 * law(r, 1.3) + 2.0 * law(r, 2.9) for r in range(RUNS)])
    offered = [offer("left", (0.5, 1.1, 1.7)), offer("right", (2.5, 3.1, 3.7))]
    found = {one.evidence.variant.hypothesis.effect: one.evidence.variant for one in search(data.bank(effect, offered))}
    assert found["left"].shape["place"] == pytest.approx(1.3, abs=0.1)
    assert found["right"].shape["place"] == pytest.approx(2.9, abs=0.1)


@pytest.mark.parametrize(("order", "named"), [(60.0, {"ripple"}), (60.15, set())])
def test_an_order_that_is_no_whole_number_is_another_effect(order: float, named: set[str]) -> None:
    data = Data(23)
    q = data.draw.uniform(-0.7, 0.7, size=(RUNS, COUNT))
    shape = ShapeRange("order", "1", 59.0, 61.0, points=(59.0, 60.0, 61.0), whole=True, exact=True)
    ripple = hypothesis("ripple", lambda r, given: np.cos(given["order"] * q[r] + 0.3), [shape])
    one = data.bank(2.0 * np.cos(order * q + 0.3), [ripple])
    found = search(one)
    assert names(found) == named
    assert all(choice.evidence.variant.shape["order"] == order for choice in found)


def test_a_ripple_that_is_not_as_strong_everywhere_keeps_its_whole_order() -> None:
    """Far above the noise whatever its law lacks tells of an order beside it, by a part that no order would make."""
    data = Data(23)
    q = data.draw.uniform(-0.7, 0.7, size=(RUNS, COUNT))
    (found,) = search(data.bank(30.0 * np.cos(60 * q + 0.3) + 0.75 * q * np.sin(60 * q + 0.3), [rippling(q, (60.0,))]))
    assert found.evidence.variant.shape["order"] == 60.0
    assert search(data.bank(30.0 * np.cos(60.15 * q + 0.3), [rippling(q, (60.0,))])) == []


def rippling(q: Array, points: tuple[float, ...]) -> Hypothesis:
    """Cosine and sine of a whole order of positions q (RUNS x COUNT)."""
    shape = ShapeRange("order", "1", 1.0, max(points), points=points, whole=True, exact=True)

    def columns(scene: Any, given: Mapping[str, float]) -> Array:
        phase = given["order"] * q[scene.number]
        return np.stack([np.cos(phase), np.sin(phase)])[:, None]

    both = (Coefficient("c", "1"), Coefficient("s", "1"))
    return Hypothesis("ripple", "ripple", 1, both, columns, shapes=(shape,))


def test_the_whole_order_beside_a_tried_one_is_found() -> None:
    """On a short way the peak is broad, and noise may put it beside the order."""
    data = Data(24)
    q = data.draw.uniform(-0.2, 0.2, size=(RUNS, COUNT))
    (found,) = search(data.bank(2.0 * np.cos(40 * q + 0.3), [rippling(q, (41.0, 90.0))]))
    assert found.evidence.variant.shape["order"] == 40.0


@pytest.mark.parametrize(("way", "sure"), [(1.0, True), (0.05, False)])
def test_a_short_way_leaves_the_order_open(way: float, sure: bool) -> None:
    """Cosine and sine take up any order nearby where the joint hardly turns."""
    data = Data(25)
    q = data.draw.uniform(-way, way, size=(RUNS, COUNT))
    (found,) = search(data.bank(3.0 * np.cos(60 * q + 0.3), [rippling(q, (60.0,))]))
    assert (found.odds > UNSURE) == sure


@pytest.mark.parametrize(("share", "named"), [(1.0, {"drift"}), (0.0, set())])
def test_what_scales_a_torque_scales_all_of_it(share: float, named: set[str]) -> None:
    """What was found fades in both cases, the model's own torque in one of them."""
    data = Data(26)
    warmth = np.linspace(0.0, 1.0, COUNT)
    own, beside = data.column(), data.column()
    whole = fixed("drift", warmth * (own + beside))
    drift = replace(whole, of_model=lambda scene, shape: (warmth * own[scene.number])[None, None])
    one = data.bank(warmth * (share * own + beside), [drift])
    for scene in one.scenes:
        object.__setattr__(scene, "model_torque", own[scene.number])  # type: ignore[attr-defined]
        object.__setattr__(scene, "torque", own[scene.number] + beside[scene.number])  # type: ignore[attr-defined]
    assert names(search(one)) == named


@pytest.mark.parametrize("alike", [True, False])
def test_what_tells_the_same_twice_must_agree(alike: bool) -> None:
    data = Data(28)
    column, other = data.column(), data.column()
    seen: list[float] = []

    def agrees(coefficients: Array, shape: Mapping[str, float]) -> bool:
        seen.append(float(coefficients[0]))
        return alike

    told_twice = replace(fixed("soft", column), agrees=agrees)
    found = names(search(data.bank(0.5 * column + 0.4 * other, [told_twice, fixed("other", other)])))
    assert found == ({"soft", "other"} if alike else {"other"})
    assert seen[-1] == pytest.approx(0.5, abs=0.1)


def test_peaks_over_the_way_are_not_hidden_by_standstill() -> None:
    """From place to place, with stops: where the joint stands friction leaves more than the ripple is."""
    draw = np.random.default_rng(27)
    places = draw.uniform(-0.9, 0.9, size=31)
    rise = (1 - np.cos(np.linspace(0.0, np.pi, 60))) / 2
    q = np.concatenate([np.append(a + (b - a) * rise, np.full(90, b)) for a, b in pairwise(places)])
    qd = np.gradient(q)
    left = 0.2 * np.cos(40 * q) + np.where(qd == 0, np.repeat(draw.normal(size=30), 150), 0.0)
    motion = SimpleNamespace(q=q[None], qd=qd[None], samples=q.size)
    scene: Any = SimpleNamespace(motion=motion, tau=left[None], model_torque=np.zeros((1, q.size)))
    assert 40.0 in likely_orders([scene], 0, 300)


def test_where_positions_are_counted_from_does_not_matter() -> None:
    """Neither to whether a spring is found nor to where its middle is."""
    for zero in (0.0, 3.0):
        data = Data(22)
        x = zero + data.draw.uniform(-1.0, 1.0, size=(RUNS, COUNT))
        points = tuple(zero + one for one in (-2.0, -1.0, 0.0, 1.0, 2.0))
        shape = ShapeRange("neutral", "rad", min(points), max(points), log=False, points=points)
        effect = 2.0 * (x - (zero - 0.4))
        offered = [hypothesis("spring", lambda r, given, x=x: x[r] - given["neutral"], [shape])]
        (found,) = search(data.bank(effect, offered))
        assert found.evidence.variant.shape["neutral"] - zero == pytest.approx(-0.4, abs=0.05)


def test_what_a_run_hardly_moves_must_not_show_there() -> None:
    """The validating run excites the effect a tenth as much: its gain is what that lets expect."""
    data = Data(18)
    column = data.column() * np.array([1.0, 1.0, 0.15])[:, None]
    one = data.bank(1.5 * column, [fixed("right", column)])
    (found,) = search(one)
    promised = found.evidence.drop * one.rows(2).sum() / sum(one.rows(r).sum() for r in TRAIN)
    assert found.evidence.validation < 0.1 * promised


def test_a_refinement_is_taken_where_the_runs_ask_for_it() -> None:
    data = Data(19)
    first, second = data.column(), data.column()
    parts = [Coefficient("c", "1"), Coefficient("c2", "1", refines=True)]
    offered = [several("wave", parts, [first, second])]
    (plain,) = search(data.bank(0.5 * first, offered))
    (both,) = search(data.bank(0.5 * first + 0.3 * second, offered))
    assert [one.name for one in plain.evidence.variant.coefficients] == ["c"]
    assert [one.name for one in both.evidence.variant.coefficients] == ["c", "c2"]
    (other,) = search(data.bank(0.2 * first + 0.5 * second, offered))
    assert [one.name for one in other.evidence.variant.coefficients] == ["c"]


def test_without_its_essential_coefficient_an_effect_is_another() -> None:
    data = Data(20)
    gain, growing = data.column(), data.column()
    drift = several("drift", [Coefficient("drift", "1", essential=True), Coefficient("start", "1")], [growing, gain])
    offered = [drift, fixed("gain", gain)]
    assert names(search(data.bank(0.5 * gain, offered))) == {"gain"}
    assert names(search(data.bank(0.5 * gain + 0.3 * growing, offered))) == {"drift"}
    assert search(data.bank(0.5 * gain, [drift])) == []


@pytest.mark.parametrize("true", [0.01, 8.0])
def test_a_shape_at_the_end_of_what_was_tried_is_refused(true: float) -> None:
    data = Data(9)
    x = data.column()

    def law(r: int, v: float) -> Array:
        # Bells whose place is the shape: the best one is at or past the end.
        return np.asarray(np.exp(-((x[r] - np.log(v)) ** 2) / 8))

    effect = np.stack([2.0 * law(r, true) for r in range(RUNS)])
    one = data.bank(effect, [shaped(law, (0.2, 0.4, 0.8, 1.6))])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    assert Selection(weighing).search() == []


def test_what_differs_between_runs_does_not_pass_validation() -> None:
    data = Data(10)
    column = data.column()
    signs = np.array([1.0, 1.0, -1.0])
    one = data.bank(signs[:, None] * column, [fixed("drifting", column)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    (evidence,) = weighing.evidence([])
    assert evidence.drop > 1000
    assert evidence.validation < 0
    assert not evidence.passes
    assert "not fitted" in evidence.why_not
    assert Selection(weighing).search() == []


def test_physical_bounds_refuse_a_name() -> None:
    """Friction that pushes is none."""
    data = Data(12)
    column = data.column()
    assert search(data.bank(-0.5 * column, [fixed("friction", column, (0.0, None))])) == []
    assert names(search(data.bank(0.5 * column, [fixed("friction", column, (0.0, None))]))) == {"friction"}


def test_what_is_tiny_beside_the_noise_is_refused() -> None:
    data = Data(13)
    column = data.column()
    one = data.bank(0.045 * column, [fixed("tiny", column)])
    assert search(one) == []


def test_an_equal_one_is_listed_and_a_worse_one_is_not() -> None:
    data = Data(14)
    right = data.column()
    twin, worse = right + 1e-4 * data.column(), right + 0.7 * data.column()
    (found,) = search(data.bank(0.5 * right, [fixed("right", right), fixed("twin", twin), fixed("worse", worse)]))
    assert {found.evidence.variant.hypothesis.effect, *(e.variant.hypothesis.effect for e in found.alternatives)} == {
        "right",
        "twin",
    }


def test_what_the_model_takes_up_is_invisible_and_named_so() -> None:
    data = Data(15)
    hidden = data.base[:, 0] - 2 * data.base[:, 1] + 0.003 * data.column()
    seen = data.base[:, 0] + data.column()
    one = data.bank(0.3 * hidden, [fixed("hidden", hidden), fixed("seen", seen), fixed("nowhere", 0 * seen)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    assert [each.effect for each in invisible(weighing)] == ["hidden", "nowhere"]
    assert Selection(weighing).search() == []


def test_what_all_joints_have_alike_hides_none_that_one_joint_shows() -> None:
    data = Data(15)
    hidden, seen = data.base[:, 0] - 2 * data.base[:, 1], data.base[:, 0] + data.column()
    whole, alone = (replace(fixed(effect, hidden), joint=0) for effect in ("gain", "alone"))
    one = data.bank(0.3 * hidden, [whole, alone, fixed("gain", seen)])
    assert [each.effect for each in invisible(Weighing(one, TRAIN, VALIDATE, None))] == ["alone"]


def test_a_column_that_no_row_shows_makes_nothing_visible() -> None:
    """As the first moments of a payload along a vertical axis."""
    data = Data(15)
    hidden = data.base[:, 0] - 2 * data.base[:, 1]
    both = (Coefficient("c", "1"), Coefficient("nothing", "1"))
    pair = np.stack([hidden, 0 * hidden], axis=1)[:, :, None]
    one = data.bank(0.3 * hidden, [Hypothesis("pair", "pair", 1, both, lambda scene, _: pair[scene.number])])
    assert [each.effect for each in invisible(Weighing(one, TRAIN, VALIDATE, None))] == ["pair"]
