"""Robots with an effect that has no real value at some positions: their files come, or one line says why."""

from __future__ import annotations

from decimal import localcontext
from pathlib import Path

import pytest

from generator.derivation import derive
from generator.reference import sample
from generator.reference.arithmetic import CONTEXT, decimals
from generator.reference.joint_effects import acting
from generator.robot.readers import read
from tests.commands import command

#: Two joints without limits, a polytrope on the first.
TWO_LINKS = """
name: two_links
gravity: [0 m/s2, -9.81 m/s2, 0 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: 0, d: 0.75 m, theta: q2, r: 0}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: gas_balancer, joint: 1, values: {d21: 1 m, d22: 0.5 m, phi: 180 deg, l0: 0.35 m, exponent: 1.3}}
"""
#: A turret on a rail, whose second axis is elastic and carries an isotherm.
RAIL = """
name: rail
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: 0, d: 0, theta: 0, r: q1, limits: [0 m, 2 m]}
  - {j: 2, sigma: 0, alpha: pi/2, d: 0.2 m, theta: q2, r: 0}
  - {j: 3, sigma: 2, alpha: 0, d: 0.6 m, theta: 0, r: 0, tool: true}
drives: {gear_ratios: [20, 100]}
effects:
  - {effect: load_friction, joint: 2}
  - {effect: gas_balancer, joint: 2, values: {d21: 0.8 m, d22: 0.3 m, phi: -90 deg, l0: 0.15 m}}
flexible: [2]
"""
ROBOTS = {"two links": TWO_LINKS, "rail": RAIL}


@pytest.fixture(params=ROBOTS)
def file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    path = tmp_path / "arm.yaml"
    path.write_text(ROBOTS[request.param])
    return path


def test_the_files_come_and_pass_their_self_test(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("generate", file, "--out", tmp_path / "out", "--self-test", capsys=capsys)
    assert done.status == 0, done.err
    assert "comparisons passed in double" in done.out
    (page,) = tmp_path.glob("out/*/review/review.html")
    assert "nan" not in page.read_text(encoding="utf-8")


def test_effects_have_values_at_the_positions_drawn_and_close_by(file: Path) -> None:
    robot = read(file)
    for seed in range(20):
        q = sample.positions(robot, seed)
        assert q == sample.positions(robot, seed)
        with localcontext(CONTEXT):
            for bent in (-0.05, 0.0, 0.05):
                assert all(one.is_defined(decimals([x + bent for x in q])) for one in acting(robot))


def test_parameters_are_told_apart_where_few_positions_are_defined(tmp_path: Path) -> None:
    names = []
    for chamber in ("9 m", "0.01 m"):
        (tmp_path / "arm.yaml").write_text(TWO_LINKS.replace("l0: 0.35 m", f"l0: {chamber}"))
        names.append([base.name for base in derive(read(tmp_path / "arm.yaml"), names=()).grouping.base])
    assert names[0] == names[1]


# One is refused by the groupings, the other by the self-test, which stays away from the chamber's end.
@pytest.mark.parametrize("chamber", ["1e-5 m", "1e-3 m"])
def test_a_chamber_that_leaves_no_room_is_named(
    chamber: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(TWO_LINKS.replace("l0: 0.35 m", f"l0: {chamber}"))
    done = command("generate", path, "--out", tmp_path / "out", capsys=capsys)
    assert done.status == 2
    assert done.err.splitlines()[-1] == (
        f"error: {path}:9:14: effect gas_balancer has a real value at hardly any position of joint 1, "
        "expected values with which it has one where the joint moves"
    )
    assert not (tmp_path / "out").exists()
