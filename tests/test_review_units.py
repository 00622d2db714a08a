"""Units, bounds and rules on the review's pages where joints turn and slide."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.derivation import derive
from generator.robot.readers import read
from generator.symbolic.model import Model
from tests.reviewed import XHTML, files, model, page

SLIDE_AND_TURN = """\
name: slide_and_turn
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: pi/2, d: 0, theta: 0, r: q1}
  - {j: 2, sigma: 0, alpha: 0, d: 0, theta: q2, r: 0}
drives:
  gear_ratios: [-200, 100]
  torque_constants: {unit: N m/A, use: warm, warm: [0.8, 0.5]}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: [2]}
  - {effect: load_friction, joints: [2]}
flexible: [2]
"""


@pytest.fixture(scope="module")
def mixed(tmp_path_factory: pytest.TempPathFactory) -> Model:
    path = tmp_path_factory.mktemp("mixed") / "slide_and_turn.yaml"
    path.write_text(SLIDE_AND_TURN)
    return derive(read(path))


def words(of: Model) -> str:
    """The page's text, without its formulas."""
    body = page(of).find(f"{XHTML}body")
    assert body is not None
    return " ".join("".join(f"{text} " for text in body.itertext()).split()).replace("\u00a0", " ")


def test_an_effect_on_both_kinds_of_joint_has_both_units(mixed: Model) -> None:
    text = words(mixed)
    assert "viscous friction coefficient [N s/m on joint 1; N m s/rad on joint 2], ≥ 0." in text
    assert "Coulomb friction coefficient [N m], ≥ 0." in text


def test_a_slides_gear_ratio_and_drive_gain_have_its_units(mixed: Model) -> None:
    text = words(mixed)
    assert "drive gain 1 −200 rad/m −200 rad/m 0.8 −160 N/A 2 100 100 0.5 50 N m/A" in text.replace("− ", "−")
    assert "| 1 | -200 rad/m | -200, 0 | 0.8 |" in files(mixed)["groupings.md"]
    assert "| 2 | 100 | 0, 100 | 0.5 |" in files(mixed)["groupings.md"]


def test_a_spindles_gear_ratio_has_pi(tmp_path: Path) -> None:
    path = tmp_path / "slide_and_turn.yaml"
    path.write_text(SLIDE_AND_TURN.replace("-200, 100", "-2*pi/0.03, 100"))
    of = derive(read(path))
    text = words(of).replace("− ", "−")
    assert "−209.44 rad/m 0.8 −167.552 N/A 2 100 100 0.5" in text
    assert "π" in text
    assert "| 1 | -200*pi/3 rad/m | -200*pi/3, 0 | 0.8 |" in files(of)["groupings.md"]


def test_one_elastic_joint_is_one(mixed: Model) -> None:
    assert "Joint 2: an elastic coordinate between motor and joint" in words(mixed)
    assert "Elastic drive trains: joint 2." in files(mixed)["groupings.md"]
    assert "Elastic drive trains: joints 1 to 6." in files(model("kr500"))["groupings.md"]


def test_the_parameters_table_has_both_bounds(mixed: Model) -> None:
    cells = [[cell.text for cell in row.iter(f"{XHTML}td")] for row in page(mixed).iter(f"{XHTML}tr")]
    (bound,) = {row[-1] for row in cells if "friction per torque that the transmission carries" in row}
    assert bound == "≥\u00a00, ≤\u00a01"


def test_what_a_body_before_carries_is_not_told_to_be_unseen() -> None:
    gone = {one.name: one for one in model("scara").grouping.eliminated}
    assert "MX2R" in gone["MX3"].into
    assert gone["MX3"].rule == "this joint's motion does not show it: it acts as a part of the antecedent"
    assert not gone["XX1"].into
    assert gone["XX1"].rule == "the joints up to this one do not move the body in a way that shows it"
