"""Questions to Gram matrices against least squares on the columns themselves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from identification.diagnosis.columns.normal_equations import FAR, Normal, Prior, bounded, directions, inverse

Array = NDArray[np.float64]

P, C, N = 4, 5, 300


@pytest.fixture(scope="module")
def columns() -> tuple[Array, Array, Array]:
    """Base columns W (N x p), candidates (N x c) of which parts lie in W's range, torque."""
    draw = np.random.default_rng(1)
    W = draw.normal(size=(N, P)) * [1.0, 1e3, 1e-2, 5.0]
    candidates = draw.normal(size=(N, C)) + W @ draw.normal(size=(P, C)) / [1.0, 1e3, 1e-2, 5.0][0]
    y = W @ [1.0, 2e-3, 50.0, -1.0] + 0.4 * candidates[:, 0] - 0.2 * candidates[:, 3] + draw.normal(size=N)
    return W, candidates, y


def normal(columns: tuple[Array, Array, Array], prior: Prior | None = None) -> Normal:
    W, candidates, y = columns
    everything = np.column_stack([W, candidates, y])
    return Normal(everything.T @ everything, P, N, prior)


def squares(A: Array, y: Array) -> float:
    """What least squares leaves."""
    x = np.linalg.lstsq(A, y, rcond=None)[0]
    return float(np.sum((y - A @ x) ** 2))


def prior() -> Prior:
    """Correlated, of the first three base parameters."""
    root = np.array([[0.3, 0.0, 0.0], [1e-4, 2e-4, 0.0], [2.0, 1.0, 5.0]])
    precision = np.zeros((P, P))
    precision[:3, :3] = np.linalg.inv(root @ root.T)
    return Prior(np.array([0.8, 1.5e-3, 45.0, 0.0]), precision)


def rows(one: Prior) -> tuple[Array, Array]:
    """A prior as rows of a matrix and their right-hand side."""
    values, vectors = np.linalg.eigh(one.precision[:3, :3])
    A = np.zeros((3, P))
    A[:, :3] = np.sqrt(values)[:, None] * vectors.T
    return A, A @ one.mean


def test_the_drop_of_a_candidate_is_that_of_least_squares(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    S = normal(columns).schur
    for i in range(C):
        drop = squares(W, y) - squares(np.column_stack([W, candidates[:, i]]), y)
        assert S[i, -1] ** 2 / S[i, i] == pytest.approx(drop, rel=1e-8)


def test_the_drop_beside_chosen_columns_is_that_of_least_squares(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    chosen = [P + 0, P + 3]
    S = normal(columns).beside(chosen)
    fixed = np.column_stack([W, candidates[:, [0, 3]]])
    for i in (1, 2, 4):
        drop = squares(fixed, y) - squares(np.column_stack([fixed, candidates[:, i]]), y)
        assert S[i, -1] ** 2 / S[i, i] == pytest.approx(drop, rel=1e-7, abs=1e-9)
    assert not S[[0, 3]].any()
    assert S[-1, -1] == pytest.approx(squares(fixed, y), rel=1e-9)


@pytest.mark.parametrize(("part", "free", "known"), [(1e-1, False, False), (3e-3, True, False), (1e-4, True, True)])
def test_what_little_is_left_of_a_column_tells_more_where_parameters_are_known(
    columns: tuple[Array, Array, Array], part: float, free: bool, known: bool
) -> None:
    W, candidates, y = columns
    out = candidates - W @ np.linalg.lstsq(W, candidates, rcond=None)[0]
    within = W[:, [0] * C] / np.linalg.norm(W[:, 0]) + part * out / np.linalg.norm(out, axis=0)
    hardly = np.diag(np.full(P, 1e-12))
    one_of_them = np.where(np.arange(P) == 0, hardly, 0.0)
    every, one = (Prior(np.zeros(P), precision) for precision in (hardly, one_of_them))
    for prior_, expected in ((None, free), (one, free), (every, known)):
        assert [normal((W, within, y), prior_).hides(P + i) for i in range(C)] == [expected] * C


@pytest.mark.parametrize("known", [False, True])
def test_more_candidates_are_told_as_if_they_had_been_there(columns: tuple[Array, Array, Array], known: bool) -> None:
    W, candidates, y = columns
    less = normal((W, candidates[:, :2], y), prior() if known else None)
    whole = normal(columns, prior() if known else None)
    assert less.schur.shape == (3, 3)
    for more in (less.grown(whole.gram), normal((W, candidates[:, :2], y), whole.prior).grown(whole.gram)):
        np.testing.assert_allclose(more.schur, whole.schur, rtol=1e-9, atol=1e-9 * np.abs(whole.schur).max())


@pytest.mark.parametrize("rank", [1e-10, 1e-8])
@pytest.mark.parametrize("angle", [1.0, 2.5, 1e-3, 1e-6, 0.0])
def test_two_columns_are_inverted_as_many_are(angle: float, rank: float) -> None:
    """Beside a third one that has nothing to do with them."""
    columns = np.array([[3.0, 0.0, 0.0], [20 * np.cos(angle), 20 * np.sin(angle), 0.0], [0.0, 0.0, 1.0]])
    A = columns @ columns.T
    np.testing.assert_allclose(inverse(A[:2, :2], rank), inverse(A, rank)[:2, :2], rtol=1e-8)


def test_the_solution_its_covariance_and_misfit(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    chosen = [P + 1, P + 4]
    A = np.column_stack([W, candidates[:, [1, 4]]])
    one = normal(columns)
    x, covariance = one.solution(chosen)
    assert x == pytest.approx(np.linalg.lstsq(A, y, rcond=None)[0], rel=1e-8)
    assert np.sqrt(np.diag(covariance)) == pytest.approx(np.sqrt(np.diag(np.linalg.inv(A.T @ A))), rel=1e-6)
    assert one.misfit(chosen, x) == pytest.approx(squares(A, y), rel=1e-9)


def test_a_prior_is_rows_more(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    more, right = rows(prior())
    A = np.column_stack([np.vstack([W, more]), np.append(candidates[:, 2], np.zeros(3))])
    one = normal(columns, prior())
    x, covariance = one.solution([P + 2])
    expected = np.linalg.lstsq(A, np.append(y, right), rcond=None)[0]
    assert x == pytest.approx(expected, rel=1e-7)
    assert covariance == pytest.approx(np.linalg.inv(A.T @ A), rel=1e-9, abs=1e-12)
    assert one.misfit([P + 2], x) == pytest.approx(float(np.sum((y - A[:N] @ expected) ** 2)), rel=1e-9)
    drop = squares(A[:, :P], np.append(y, right)) - squares(A, np.append(y, right))
    S = one.schur
    assert S[2, -1] ** 2 / S[2, 2] == pytest.approx(drop, rel=1e-7)


def test_more_parameters_may_be_known_beside_others() -> None:
    precision = np.array([[4.0, 1.0], [1.0, 2.0]])
    whole = Prior(np.array([1.0, -1.0]), precision).beside([0.0, 9.0])
    assert whole.mean.tolist() == [1.0, -1.0, 0.0, 0.0]
    assert np.array_equal(
        whole.precision, np.block([[precision, np.zeros((2, 2))], [np.zeros((2, 2)), np.diag([0, 9])]])
    )
    assert whole.known.tolist() == [True, True, False, True]


def test_a_shifted_prior_lets_its_direction_go() -> None:
    one = prior()
    direction, value, std = np.array([1.0, 0.0, 20.0, 0.0]), 0.7, 0.5
    shifted = one.shifted(direction, value, std)
    assert shifted.mean == pytest.approx(one.mean + direction * value)
    covariance = np.linalg.inv(one.precision[:3, :3]) + std**2 * np.outer(direction, direction)[:3, :3]
    assert shifted.precision[:3, :3] == pytest.approx(np.linalg.inv(covariance), rel=1e-8)


def test_held_coefficients_stay(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    left = y - 0.25 * candidates[:, 1]
    one = replace(normal(columns), preset={P + 1: 0.25})
    x, covariance = one.solution([P + 1])
    assert x[-1] == 0.25
    assert x[:P] == pytest.approx(np.linalg.lstsq(W, left, rcond=None)[0], rel=1e-8)
    assert not covariance[-1].any()
    assert one.misfit([P + 1], x) == pytest.approx(squares(W, left), rel=1e-8)


def test_others_are_weighed_beside_what_is_held(columns: tuple[Array, Array, Array]) -> None:
    W, candidates, y = columns
    left, beside = y - 0.25 * candidates[:, 1], np.column_stack([W, candidates[:, 0]])
    one = replace(normal(columns), preset={P + 1: 0.25})
    chosen = [P, P + 1]
    S, whole = one.part([P + 3], chosen), one.beside(chosen)
    drop = squares(beside, left) - squares(np.column_stack([beside, candidates[:, 3]]), left)
    assert S[0, 1] ** 2 / S[0, 0] == pytest.approx(drop, rel=1e-8)
    assert S[-1, -1] == pytest.approx(squares(beside, left), rel=1e-8)
    assert whole[np.ix_([3, -1], [3, -1])] == pytest.approx(S, rel=1e-8)
    assert not whole[:2].any()


def test_a_direction_that_nothing_shows_is_left_at_zero() -> None:
    draw = np.random.default_rng(2)
    A = draw.normal(size=(50, 3))
    A = np.column_stack([A, A[:, 0] + A[:, 1]])
    x = inverse(A.T @ A) @ (A.T @ A @ [1.0, 2.0, 3.0, 0.0])
    assert A @ x == pytest.approx(A @ [1.0, 2.0, 3.0, 0.0], rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_bounds_hold_and_what_is_explained_is_told(seed: int) -> None:
    draw = np.random.default_rng(seed)
    A = draw.normal(size=(60, 3))
    y = A @ [0.5, 0.3, 0.01] + 0.5 * draw.normal(size=60)
    lower, upper = np.zeros(3), np.array([np.inf, 0.37, np.inf])
    x, drop = bounded(A.T @ A, A.T @ y, lower, upper, np.zeros(3))
    assert np.all(x >= lower)
    assert np.all(x <= upper)
    assert drop == pytest.approx(float(y @ y - np.sum((y - A @ x) ** 2)), abs=1e-9)
    # No better than the best within the bounds, and the best of the columns that are used.
    best = lsq_linear(A, y, (lower, upper))
    assert drop <= float(y @ y) - 2 * best.cost + 1e-9
    used = x != 0
    assert used.any()
    assert x[used] == pytest.approx(np.linalg.lstsq(A[:, used], y, rcond=None)[0], rel=1e-9)
    # None is left out where all are within their bounds.
    free = np.linalg.lstsq(A, y, rcond=None)[0]
    beyond = (free < lower) | (free > upper)
    assert (~used).any() == (beyond & ~used).any()


def test_a_column_of_which_nothing_is_left_is_not_used() -> None:
    x, drop = bounded(np.array([[1e-6]]), np.array([1.0]), np.array([-np.inf]), np.array([np.inf]), np.array([1e-4]))
    assert x.tolist() == [0.0]
    assert drop == 0.0


@pytest.mark.parametrize("seed", range(5))
def test_rounding_of_what_others_explain_is_no_direction(seed: int) -> None:
    """Ten columns that three others explain wholly, and five that they do not."""
    draw = np.random.default_rng(seed)
    others, real = draw.normal(size=(2000, 3)), draw.normal(size=(2000, 5))
    columns = np.hstack([real, others @ draw.normal(size=(3, 10))])
    solution, *_ = np.linalg.lstsq(others, columns, rcond=None)
    left = columns.T @ columns - columns.T @ others @ solution
    along = directions((left + left.T) / 2, 1e-7, np.sum(columns**2, axis=0))
    rows = (columns - others @ solution) @ along
    np.testing.assert_allclose(rows.T @ rows, np.eye(5), atol=1e-9)


@pytest.mark.parametrize("ratio", [0.1, 1.0, 3.0])
def test_a_value_is_far_from_a_known_one_by_the_deviations_of_their_difference(ratio: float) -> None:
    """Of runs that tell it ``ratio`` times as badly as it is known, alone and in a fit near the known value."""
    known = Prior(np.zeros(1), np.eye(1))
    for y in np.array([0.5, 2.0, -6.0]) * np.hypot(1.0, ratio):
        fit = Normal(np.array([[1.0, y], [y, y * y]]) / ratio**2, 1, 1, known)
        assert known.far(*fit.solution([])) == pytest.approx(abs(y) / np.hypot(1.0, ratio))


def test_a_value_that_runs_hardly_tell_is_not_far() -> None:
    known = Prior(np.zeros(3), np.diag([1.0, 1.0, 0.0]))
    far = known.far(np.array([0.99, 2.0, 9.0]), np.diag([1.0, np.inf, 1.0]))
    assert 0 < far[0] < FAR
    assert far[1:].tolist() == [0.0, 0.0]
