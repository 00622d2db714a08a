"""Recordings of real robots, where they are at hand: effects that were taken out of the robot file are named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.resources import find_robot
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, Diagnosis
from identification.diagnosis.mending.mended import Mended
from identification.diagnosis.runs.played import together
from tests.at_hand import RECORDINGS
from tests.commands import ROOT
from tests.diagnosis.diagnosed_arm import answered
from tests.real_recordings import TEST, TRAIN, A, B, data

pytestmark = RECORDINGS.needed


def without(robot: str, folder: Path, *effects: str) -> Path:
    """The robot's file without some of its effects, and without the values of a gas balancer that is one of them."""
    path, kept, skipping = folder / f"{robot}.yaml", [], False
    for line in (ROOT / "robots" / f"{robot}.yaml").read_text(encoding="utf-8").splitlines():
        item = line.lstrip().startswith("- ")
        skipping = any(f"effect: {one}" in line for one in effects) if item else skipping and line.startswith("    ")
        if not skipping and not ("gas_balancer" in effects and line.lstrip().startswith("F02:")):
            kept.append(line)
    path.write_text("\n".join(kept) + "\n", encoding="utf-8")
    return path


def diagnosis(path: Path, wanted: Request) -> tuple[Diagnosis, Mended | None]:
    found, new = answered(path, wanted, path.parent / "out")
    return found, new


def left(new: Mended | None) -> tuple[float, float]:
    """||e||/||Y - mean(Y)|| of the runs that test in %, before and after."""
    assert new is not None
    before, after = (together(played).total.relative_to_mean for played in (new.before, new.after))
    return before, after


#: What a joint's friction is named, besides the viscous one: none is Coulomb's alone just after a reversal.
DRY = ("coulomb_friction", "dahl_friction", "lugre_friction")
#: What is named as well of which nobody knows whether it is true.
OPEN = {("torque_delay", (6,)), ("torque_gain", (6,))}


def with_digits(source: Path, folder: Path, digits: int) -> Path:
    """The recording with so many significant digits."""
    names = source.open(encoding="utf-8").readline().strip()
    path = folder / source.name
    rows = np.loadtxt(source, delimiter=",", skiprows=1)
    np.savetxt(path, rows, f"%.{digits}g", delimiter=",", header=names, comments="")
    return path


@pytest.mark.long
@pytest.mark.parametrize("digits", [9, 8, 7])
def test_friction_payload_and_balancer_of_a_heavy_arm_are_named(digits: int, tmp_path: Path) -> None:
    """About 150 kg are mounted, which the set does not know. The last digits change how links bounce in gaps that are
    only tried, and must not change what is named.
    """
    path = without("kr300", tmp_path, "viscous_friction", "coulomb_friction", "gas_balancer")
    runs = [str(with_digits(Path(one), tmp_path, digits)) for one in data(A, B)]
    found, new = diagnosis(path, Request(runs, prior="a_priori"))
    assert found.verdict == NAMED
    named = {(one.hypothesis.effect, one.joints): one for one in found.findings}
    balancer = {key for key in named if key[0] in ("gas_balancer", "spring_balancer")}
    assert {joints for _, joints in balancer} == {(2,)}
    assert len(balancer) == 1
    friction = {key for key in named if key[0] in (*DRY, "viscous_friction")}
    dry = [joints for effect, joints in friction if effect in DRY]
    assert sorted(dry) == sorted(joints for effect, joints in friction if effect not in DRY)
    assert sorted(dry) == [(joint,) for joint in range(1, 7)]
    assert set(named) - OPEN == friction | {("payload", (1, 2, 3, 4, 5, 6))} | balancer
    (one,) = (named[key] for key in balancer)
    assert "gas_balancer" in {one.hypothesis.effect, *(other.effect for other in one.alternatives)}
    before, after = left(new)
    assert before > 100
    assert after < 9


def test_a_free_fit_says_that_it_cannot_see_the_balancer(tmp_path: Path) -> None:
    found, _ = diagnosis(without("kr300", tmp_path, "gas_balancer"), Request(data(A, B), dry=True))
    assert ("gas_balancer", 2) in {(one.effect, one.joint) for one in found.invisible}


@pytest.mark.long
def test_a_coupled_wrist_is_named(tmp_path: Path) -> None:
    found, new = diagnosis(without("tx40", tmp_path, "coupled_rotor"), Request(data(TRAIN), test=data(TEST)))
    (one,) = (one for one in found.findings if one.hypothesis.effect == "coupled_rotor")
    assert one.joints == (5, 6)
    before, after = left(new)
    assert before > 12
    assert after < 8


def late(source: Path, folder: Path, seconds: float) -> Path:
    """The recording with the torques of its motors later by so much."""
    names = source.open(encoding="utf-8").readline().strip().split(",")
    columns = np.loadtxt(source, delimiter=",", skiprows=1).T
    for k in (k for k, name in enumerate(names) if name.startswith(("i", "taum"))):
        columns[k] = np.interp(columns[0] - seconds, columns[0], columns[k])
    path = folder / source.name
    np.savetxt(path, columns.T, "%.10g", delimiter=",", header=",".join(names), comments="")
    return path


@pytest.mark.long
def test_late_torques_of_short_runs_are_late_and_nothing_else(tmp_path: Path) -> None:
    """Rows are too few to fit each motor at every delay, and noise is told from few of them."""
    run = late(RECORDINGS.path / "tx40" / "run.csv", tmp_path, 0.02)
    path = tmp_path / "tx40.yaml"
    path.write_bytes(find_robot("tx40").read_bytes())
    train, test = (run.with_name(Path(name).name) for name in (TRAIN, TEST))
    found, _ = diagnosis(path, Request([str(train)], test=[str(test)]))
    (one,) = found.findings
    assert one.hypothesis.key == ("torque_delay", 0)
    assert one.parameters["torque_delay"].value == pytest.approx(0.02, abs=0.004)
