"""Limits of many turns or metres: the self-test stays where single precision has digits to compare."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.reference import sample
from generator.robot.readers import read
from tests.commands import command

CRANE = """\
name: crane
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0, limits: [-1e6 deg, 1e6 deg]}
  - {j: 2, sigma: 1, alpha: pi/2, d: 0.3 m, theta: 0, r: q2, limits: [20 m, 3000 m]}
  - {j: 3, sigma: 0, alpha: pi/2, d: 0.2 m, theta: q3, r: 0, limits: [-1e6 rad, -1 rad]}
effects:
  - {effect: viscous_friction, joints: all}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "crane.yaml"
    path.write_text(CRANE)
    return path


def test_positions_are_drawn_within_the_limits_and_near_zero(file: Path) -> None:
    for seed in range(20):
        q = sample.positions(read(file), seed)
        assert -6.5 <= q[0] <= 6.5
        assert 20 <= q[1] <= 25
        assert -7.5 <= q[2] <= -1


def test_the_self_test_passes_in_both_precisions(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("generate", file, "--out", tmp_path, "--self-test", capsys=capsys)
    assert done.status == 0, done.err
    assert "comparisons passed in float" in done.out
