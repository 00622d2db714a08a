"""Residuals as they are told."""

from __future__ import annotations

from identification.residuals import Residual, Residuals
from identification.suspicion import beyond


def test_a_joint_without_rows_has_no_residual() -> None:
    """Nothing unexplained would be praise."""
    each = {2: Residual(10, 1.0, 20.0, 10.0), 0: Residual(0, 0.0, 0.0, 0.0), 1: Residual(10, 0.0, 5.0, 4.0)}
    assert Residuals(each).by_joint() == "- 0.0 10.0"
    assert Residuals(each).by_joint(".2g") == "- 0 10"


def test_what_is_left_of_no_torque_is_no_praise() -> None:
    assert Residual(10, 1.0, 0.0, 0.0).relative == Residual(10, 1.0, 0.0, 0.0).relative_to_mean == float("inf")
    assert Residual(10, 0.0, 0.0, 0.0).relative == Residual(10, 0.0, 0.0, 0.0).relative_to_mean == 0.0


def test_joints_that_are_tested_far_worse_are_told() -> None:
    def leaving(parts: list[float]) -> Residuals:
        return Residuals({k: Residual(10, part, 20.0, 100.0) for k, part in enumerate(parts)})

    (told,) = beyond(leaving([2.0, 2.0, 9.0]), leaving([5.9, 24.0, 20.0]), (1, 2, 4))
    assert "far worse on joint 2 (2 % of its spread fitted, 24 % tested):" in told
    assert not beyond(leaving([2.0, 2.0]), leaving([9.0, 1.0]), (1, 2))


def test_joints_that_no_fitted_run_shows_are_told() -> None:
    """Whatever is left of them: their fitted residual is none."""
    none = Residual(0, 0.0, 0.0, 0.0)
    train = Residuals({0: Residual(10, 2.0, 20.0, 100.0), 1: none, 2: none})
    test = Residuals({0: Residual(10, 2.0, 20.0, 100.0), 1: Residual(10, 346.2, 20.0, 100.0), 2: none})
    (told,) = beyond(train, test, (1, 3, 4))
    assert told.startswith("the fitted runs have no rows of joint 3: 346 % of its torque's spread is unexplained")
