"""Residuals as they are told."""

from __future__ import annotations

from identification.residuals import Residual, Residuals


def test_a_joint_without_rows_has_no_residual() -> None:
    """Nothing unexplained would be praise."""
    each = {2: Residual(10, 1.0, 20.0, 10.0), 0: Residual(0, 0.0, 0.0, 0.0), 1: Residual(10, 0.0, 5.0, 4.0)}
    assert Residuals(each).by_joint() == "- 0.0 10.0"
    assert Residuals(each).by_joint(".2g") == "- 0 10"
