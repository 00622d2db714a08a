"""Columns that are swapped or of the wrong sign, of joints or of motors: refused and named, where a run can tell."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from identification.diagnosis.command import Request
from identification.drive_train import constants, coupling
from identification.inverse_model import identify
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, Recorded, recorded


@pytest.mark.parametrize("change", ["torques", "positions"])
def test_swapped_columns_are_found_out(change: str, links: Regressors, tmp_path: Path) -> None:
    run = recorded(links, TRUTH, seed=7, noise=0.03)
    stem = {"torques": "tau", "positions": "q"}[change]
    columns = {f"{stem}1": run.columns[f"{stem}2"], f"{stem}2": run.columns[f"{stem}1"]}
    path = run.with_columns(**columns).save(tmp_path / f"swapped_{change}.csv")
    with pytest.raises(InputError, match=f"the {change} of joints 1 and 2 look swapped"):
        identify(links.model.robot, [path], regressors=links)


def test_those_of_a_run_that_tests_are_found_out(links: Regressors, tmp_path: Path) -> None:
    right, wrong = (recorded(links, TRUTH, seed=seed, noise=0.03) for seed in (7, 8))
    wrong = wrong.with_columns(tau1=wrong.columns["tau2"], tau2=wrong.columns["tau1"])
    paths = [run.save(tmp_path / f"{name}.csv") for name, run in (("right", right), ("wrong", wrong))]
    message = r"wrong.csv:1:1: the torques of joints 1 and 2 look swapped"
    with pytest.raises(InputError, match=message):
        identify(links.model.robot, paths[:1], paths[1:], regressors=links)
    file = Path(links.model.robot.place.file)
    wanted = Request([str(paths[0])], test=[str(paths[1])])
    with pytest.raises(InputError, match=message):
        answered(file, wanted, tmp_path / "out")


def test_a_diagnosis_refuses_them_before_it_looks_for_anything(
    links: Regressors, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runs = [recorded(links, TRUTH, seed=seed, noise=0.03) for seed in (7, 8)]
    swapped = runs[1].with_columns(q1=runs[1].columns["q2"], q2=runs[1].columns["q1"])
    paths = [run.save(tmp_path / f"{name}.csv") for name, run in (("right", runs[0]), ("wrong", swapped))]
    file = Path(links.model.robot.place.file)
    with pytest.raises(InputError, match=r"wrong.csv:1:1: the positions of joints 1 and 2 look swapped"):
        answered(file, Request(paths), tmp_path / "out")
    assert "columns of every candidate" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("change", "stems"), [("torques", ("i",)), ("torques", ("taum",)), ("positions", ("qm",)), ("columns", ("qm", "i"))]
)
def test_swapped_columns_of_motors_are_found_out(
    change: str, stems: Sequence[str], links: Regressors, tmp_path: Path
) -> None:
    """Ratios, constants and the coupling of the two are not alike: what is read of the joints is a mixture."""
    robot = links.model.robot
    run, N = recorded(links, TRUTH, seed=7, noise=0.01).columns, coupling(robot)
    motors = N @ np.stack([run["q1"], run["q2"]]), np.linalg.solve(N.T, np.stack([run["tau1"], run["tau2"]]))
    effort = "taum" if "taum" in stems else "i"
    if effort == "i":
        motors = motors[0], motors[1] / constants(robot)[:, None]
    columns = {f"{stem}{k}": x for stem, two in zip(("qm", effort), motors, strict=True) for k, x in enumerate(two, 1)}
    for stem in stems:
        columns[f"{stem}1"], columns[f"{stem}2"] = columns[f"{stem}2"], columns[f"{stem}1"]
    path = Recorded({"t": run["t"], **columns}).save(tmp_path / f"swapped_motors_{'_'.join(stems)}.csv")
    with pytest.raises(
        InputError, match=f"the {change} of motors 1 and 2 look swapped, expected columns in the motors'"
    ):
        identify(robot, [path], regressors=links)


def test_columns_of_a_short_run_are_not_doubted(links: Regressors, tmp_path: Path) -> None:
    """Of 2.5 s some thirty rows are independent, by which 13 parameters explain what they like."""
    short, long = (
        run.with_columns(tau1=run.columns["tau2"], tau2=run.columns["tau1"]).save(tmp_path / f"swapped_{seconds:g}.csv")
        for seconds in (2.5, 25.0)
        for run in [recorded(links, TRUTH, duration=seconds, seed=7, noise=0.03)]
    )
    identify(links.model.robot, [short], regressors=links)
    with pytest.raises(InputError, match="look swapped"):
        identify(links.model.robot, [long], regressors=links)


#: Two joints' torques tell which of two signs differ, their friction which is wrong.
FRICTION = "all friction and inertia that the torques of joint {} show alone is negative"


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("tau1", FRICTION.format(1)),
        ("tau2", FRICTION.format(2)),
        ("q1", FRICTION.format(1)),
        ("q2", "the positions of joint 2 look of the wrong sign"),
    ],
)
def test_a_column_of_the_wrong_sign_is_found_out(name: str, told: str, links: Regressors, tmp_path: Path) -> None:
    run = recorded(links, TRUTH, seed=7, noise=0.03)
    path = run.with_columns(**{name: -run.columns[name]}).save(tmp_path / "turned.csv")
    with pytest.raises(InputError, match=f"turned.csv:1:1: {told}, expected torques of the drives, and pos"):
        identify(links.model.robot, [path], regressors=links)


@pytest.mark.parametrize(
    ("name", "factor", "told"), [("tau1", 1e3, ("large", "small")), ("tau2", 1e3, ("small", "large"))]
)
def test_a_column_in_another_unit_is_found_out(
    name: str, factor: float, told: Sequence[str], links: Regressors, tmp_path: Path
) -> None:
    """Of two joints the one is as much too large as the other one is too small."""
    run = recorded(links, TRUTH, seed=7, noise=0.03)
    path = run.with_columns(**{name: factor * run.columns[name]}).save(tmp_path / "milli.csv")
    each = [f"the torques of joint {joint} look 1000 times too {one}" for joint, one in enumerate(told, 1)]
    with pytest.raises(InputError, match=f"milli.csv:1:1: {' or '.join(each)}, expected all efforts in their units"):
        identify(links.model.robot, [path], regressors=links)


@pytest.mark.parametrize("factor", [0.003, 0.01, 300.0])
def test_another_factor_is_no_unit(factor: float, links: Regressors, tmp_path: Path) -> None:
    run = recorded(links, TRUTH, seed=7, noise=0.03)
    path = run.with_columns(tau2=factor * run.columns["tau2"]).save(tmp_path / "scaled.csv")
    told = ""
    try:
        identify(links.model.robot, [path], regressors=links)
    except InputError as refused:
        told = str(refused)
    assert "1000 times" not in told


def test_a_column_of_noise_is_none_in_another_unit(links: Regressors, tmp_path: Path) -> None:
    run = recorded(links, TRUTH, seed=7, noise=0.03)
    nothing = 0.03 * np.random.default_rng(1).normal(size=len(run.columns["t"]))
    found = identify(links.model.robot, [run.with_columns(tau2=nothing).save(tmp_path / "noise.csv")], regressors=links)
    assert any("joint 2" in note and "unexplained" in note for note in found.notes)
