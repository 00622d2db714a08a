"""``counterpoise gains``: drive gains of a simulated arm within their stated uncertainty, and gains refused by name."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.drive_gains import DriveGains, drive_gains
from identification.motor_rows import motor_rows
from identification.observation import Regressors
from identification.recipes import read as recipe_of
from identification.sidecar import Payload
from tests.commands import command
from tests.lifter import KT, PAYLOAD, N, currents, found, lifter, saved, truth
from tests.recorded import Recorded


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Regressors:
    return lifter(tmp_path_factory.mktemp("arm"))


def test_motor_rows_turn_the_coupling_to_the_models_side(arm: Regressors, tmp_path: Path) -> None:
    one = found(arm, tmp_path, noise=0.0).empty[0]
    names = arm.names
    chi = np.array([truth(arm)[name] for name in names])
    of_motors = list(motor_rows(one, arm, N, names))
    assert [rows.motor for rows in of_motors] == [0, 1, 2]
    for rows in of_motors:
        assert len(rows.i) > 50
        assert KT[rows.motor] * rows.i == pytest.approx(rows.B @ chi, abs=2e-3 * float(np.abs(rows.i).max()))


def test_without_noise_the_gains_are_the_true_ones(arm: Regressors, tmp_path: Path) -> None:
    result = found(arm, tmp_path, noise=0.0)
    assert not result.refused
    for m, value in enumerate(KT):
        assert result.constants[m][0] == pytest.approx(value, rel=5e-3)
        assert result.gain(m)[0] == pytest.approx(N[m, m] * value, rel=5e-3)
        assert result.payload_share[m] == pytest.approx(0.001, rel=0.01)


def test_true_values_lie_within_the_stated_uncertainty(arm: Regressors, tmp_path: Path) -> None:
    """Sixteen seeds, three gains and two of the payload's first moments: about 95 % within two standard deviations."""
    deviations = []
    for seed in range(16):
        result = found(arm, tmp_path, noise=0.05, seed=seed)
        deviations += [(result.constants[m][0] - KT[m]) / result.constants[m][1] for m in range(3)]
        deviations += [
            (result.parameters[n][0] - v) / result.parameters[n][1] for n, v in (("MXL", 1.5), ("MYL", -0.8))
        ]
    inside = np.mean(np.abs(deviations) < 2)
    assert 0.86 <= inside <= 0.999
    assert np.std(deviations) == pytest.approx(1.0, abs=0.25)


def test_a_vertical_axis_that_moves_slowly_is_refused_by_name(arm: Regressors, tmp_path: Path) -> None:
    """Its torque is friction alone then: no known mass shows in it. The others do not suffer."""
    folder = tmp_path
    recipe = folder / "slow.yaml"
    recipe.write_text("dynamics: 0.3\nstandstill: 0.002\n")
    a, b = (currents(arm, number, loaded, slow=12.0) for number, loaded in ((1, False), (2, True)))
    empty, loaded = saved(folder / "a.csv", *a, 0.02, 1), saved(folder / "b.csv", *b, 0.02, 2)
    result = drive_gains(
        arm.model.robot, [empty], [loaded], Payload("L", {"M": 20.0}), {}, recipe_of(recipe), regressors=arm
    )
    assert list(result.refused) == [0]
    assert "does not show in its torque" in result.refused[0]
    for m in (1, 2):
        value, std = result.constants[m]
        assert value == pytest.approx(KT[m], abs=4 * std)
        assert std < 0.05 * value


def test_a_payload_that_is_not_exact_enough_shows_no_gain(arm: Regressors, tmp_path: Path) -> None:
    """A mass of 20 kg is known within 7.5 %, and so is each gain; within 15 % it is none."""
    found(arm, tmp_path)
    empty, loaded = ([str(tmp_path / name)] for name in ("a.csv", "b.csv"))
    payload, robot = Payload("L", {"M": 20.0}), arm.model.robot
    result = drive_gains(robot, empty, loaded, payload, {"M": 1.5}, regressors=arm)
    assert not result.refused
    for value, std in result.constants.values():
        assert std / value == pytest.approx(0.075, rel=0.1)
    problem = "no drive gain of lifter can be told: what is known of the payload is not exact enough"
    with pytest.raises(InputError, match=f"--payload-std:1:1: {problem}"):
        drive_gains(robot, empty, loaded, payload, {"M": 3.0}, regressors=arm)


def test_what_several_payloads_owe_is_independent(arm: Regressors, tmp_path: Path) -> None:
    """Against gains from sidecars that tell one mass or the other 0.1 kg larger and smaller."""
    found(arm, tmp_path)
    empty, loaded = str(tmp_path / "a.csv"), [str(tmp_path / name) for name in ("b.csv", "c.csv")]
    t, motion, _ = currents(arm, 3, False)
    tau = arm.torques(truth(arm), motion) + np.array([1.5 * PAYLOAD @ W for W in arm.payload(motion)])
    saved(Path(loaded[1]), t, motion, np.linalg.solve(N.T, tau) / KT[:, None], 0.02, 7)

    def gains(*masses: float) -> DriveGains:
        for name, mass in zip("bc", masses, strict=True):
            (tmp_path / f"{name}.yaml").write_text(f"payload: {{name: {name.upper()}, M: {mass} kg}}\n")
        return drive_gains(arm.model.robot, [empty], loaded, payload_std={"M": 0.1}, regressors=arm)

    masses = ((20.1, 30.0), (19.9, 30.0), (20.0, 30.1), (20.0, 29.9))
    ends = [np.array([gains(*pair).constants[m][0] for m in range(3)]) for pair in masses]
    by_value = np.hypot(ends[0] - ends[1], ends[2] - ends[3]) / 2 / KT
    share = gains(20, 30).payload_share
    assert [share[m] for m in range(3)] == pytest.approx(by_value, rel=0.05)


def test_results_and_robot_file(arm: Regressors, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found(arm, tmp_path)
    robot = Path(arm.model.robot.place.file)
    words = [
        "--empty",
        tmp_path / "a.csv",
        "--loaded",
        tmp_path / "b.csv",
        "--payload",
        "M=20",
        "--payload-std",
        "M=0.02",
    ]
    done = command("gains", robot, *words, "--out", tmp_path / "out", capsys=capsys)
    assert done.status == 0, done.err
    assert done.out.startswith("lifter: 3 of 3 drive gains\n")
    results = json.loads((tmp_path / "out" / "results.json").read_text())
    assert 1 < results["condition"] < 1e4
    assert results.keys() == {
        *("robot", "robot_sha256", "version", "method", "data", "condition", "separation", "gains_by_payload_percent"),
        *("parameters", "payloads", "residual", "notes"),
    }
    assert results["payloads"] == {"L": {"ML": {"value": 20, "std": 0.02, "unit": "kg"}}}
    one = results["parameters"]["g_tau1"]
    assert one["value"] == pytest.approx(-120 * KT[0], abs=4 * one["std"])
    assert (one["unit"], one["identifiable"]) == ("N m/A", True)
    assert one["relative_std_percent"] == pytest.approx(100 * one["std"] / abs(one["value"]))
    assert results["gains_by_payload_percent"]["kt2"] == pytest.approx(0.1, rel=0.01)
    assert len(results["data"]["loaded"][0]["sha256"]) == 64
    again = read(tmp_path / "out" / "lifter.yaml").parameter_sets["identified_with_gains"]
    assert again.other_values["g_tau2"].value == pytest.approx(results["parameters"]["g_tau2"]["value"], rel=1e-5)
    done = command(
        "compare", f"{tmp_path}/out/results.json", f"{tmp_path}/out/lifter.yaml:identified_with_gains", capsys=capsys
    )
    assert done.status == 0, done.err


def test_runs_that_show_no_gain_are_refused(
    arm: Regressors, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found(arm, tmp_path)
    torques = Recorded(
        {"t": np.arange(9.0)} | {f"{stem}{j}": np.arange(9.0) for stem in ("q", "tau") for j in (1, 2, 3)}
    )
    torques.save(tmp_path / "torques.csv")
    a, b, robot = tmp_path / "a.csv", tmp_path / "b.csv", Path(arm.model.robot.place.file)
    cases = [
        ((a, tmp_path / "torques.csv", "M=20"), "torques.csv:1:1: there are no columns of efforts, expected i1 to i3"),
        ((a, b), "b.csv:1:1: nothing tells the payload of this run, expected payload: {M: ... kg} in its sidecar"),
        ((a, b, "M=0"), "b.csv:1:1: nothing is known of payload L, expected its mass or first moments"),
        ((f"{a}@0:1", b, "M=20"), "expected at least"),
        ((a, b, "K=20"), "error: --payload:1:1: payload value 'K=20'"),
        (
            (a, b, "XZ=0.001"),
            "no drive gain of lifter can be told: the currents do not show what is known of the payload",
        ),
        (
            (f"{a}@0:5", f"{a}@5.01:10", "M=20"),
            "told: the currents do not show what is known of the payload, expected loaded runs",
        ),
    ]
    for (empty, loaded, *payload), error in cases:
        words = ["--empty", empty, "--loaded", loaded, *(["--payload", *payload] if payload else [])]
        done = command("gains", robot, *words, "--out", tmp_path / "out", capsys=capsys)
        assert (done.status, error in done.err) == (2, True), done.err
    for std, error in (
        ("MX=1", "--payload-std:1:1: MX of payload L is not known, expected a value MX=VALUE of which this is the std"),
        ("M=1e200", "error: --payload-std:1:1: M=1e+200, expected 20 at most"),
        ("MY=1e200", "error: --payload-std:1:1: MY=1e+200, expected 1e+12 at most"),
        ("name=L", "error: --payload-std:1:1: payload value 'name=L', expected NAME=VALUE of a known value"),
    ):
        words = ["--empty", a, "--loaded", b, "--payload", "M=20", "MY=0", "--payload-std", std]
        done = command("gains", robot, *words, "--out", tmp_path / "out", capsys=capsys)
        assert (done.status, error in done.err) == (2, True), done.err


def test_a_payload_that_the_sidecars_contradict_is_refused(arm: Regressors, tmp_path: Path) -> None:
    found(arm, tmp_path)
    (tmp_path / "b.yaml").write_text("payload: {M: 20 kg, MY: -0.8 kg m}\n")
    empty, loaded = ([str(tmp_path / name)] for name in ("a.csv", "b.csv"))
    for known in ({"M": 9.0}, {"M": 0.0}, {"XX": 0.3}):
        with pytest.raises(InputError, match="--payload:1:1: no run carries payload L with these values"):
            drive_gains(arm.model.robot, empty, loaded, Payload("L", known), regressors=arm)
    with pytest.raises(InputError, match="no run carries payload K"):
        drive_gains(arm.model.robot, empty, loaded, Payload("K", {"M": 20.0}), regressors=arm)
    alone, beside = (
        drive_gains(arm.model.robot, empty, loaded, payload, regressors=arm).constants
        for payload in (None, Payload("L", {"M": 20.0}))
    )
    assert alone == beside


def test_one_payload_with_two_values_is_refused(arm: Regressors, tmp_path: Path) -> None:
    runs = [saved(tmp_path / f"{s}.csv", *currents(arm, s, s > 0), 0.02, s) for s in range(3)]
    for path, mass in zip(runs[1:], (20, 21), strict=True):
        Path(path).with_suffix(".yaml").write_text(f"payload: {{M: {mass} kg}}\n")
    told = f"{runs[2]}:1:1: payload L has other values here, expected another name for another payload"
    with pytest.raises(InputError, match=f"^{re.escape(told)}$"):
        drive_gains(arm.model.robot, runs[:1], runs[1:], regressors=arm)


def test_a_loaded_run_without_its_payload_shows_no_gain(arm: Regressors, tmp_path: Path) -> None:
    empty, loaded = (saved(tmp_path / f"{s}.csv", *currents(arm, s, False), 0.02, s) for s in (1, 2))
    with pytest.raises(InputError, match="no drive gain of lifter can be told: the currents do not show what is known"):
        drive_gains(arm.model.robot, [empty], [loaded], Payload("L", {"M": 20.0}), regressors=arm)


def test_exchanged_runs_and_another_unit_of_the_mass_are_told(arm: Regressors, tmp_path: Path) -> None:
    a, b = (
        saved(tmp_path / f"{name}.csv", *currents(arm, seed, name == "b"), 0.02, seed)
        for seed, name in enumerate("ab", 1)
    )
    found = drive_gains(arm.model.robot, [b], [a], Payload("L", {"M": 20.0}), regressors=arm)
    told = "all torque constants come out negative: are the empty and the loaded runs exchanged"
    assert [note.startswith(told) for note in found.notes if "torque constant" in note] == [True]
    found = drive_gains(arm.model.robot, [a], [b], Payload("L", {"M": 20e3}), regressors=arm)
    (note,) = (note for note in found.notes if "torque constant" in note)
    told = r"motors (1, 2 and 3|1 to 3): (?P<least>\S+) to (?P<most>\S+) times the torque constant of the file; is what"
    sizes = re.match(told, note)
    assert sizes is not None, note
    times = 1000 * KT / (0.6, 0.6, 0.5)
    assert float(sizes["least"]) == pytest.approx(times.min(), rel=0.02)
    assert float(sizes["most"]) == pytest.approx(times.max(), rel=0.02)


def test_a_run_that_is_there_twice_is_refused(arm: Regressors, tmp_path: Path) -> None:
    """It would make the gains look better known than they are."""
    a, b = (
        saved(tmp_path / f"{name}.csv", *currents(arm, seed, name == "b"), 0.02, seed)
        for seed, name in enumerate("ab", 1)
    )
    for empty, loaded in (([a, a], [b]), ([a], [b, b])):
        with pytest.raises(InputError, match=r"its samples from 0 s to .* s fit in"):
            drive_gains(arm.model.robot, empty, loaded, Payload("L", {"M": 20.0}), regressors=arm)


def test_currents_of_another_run_are_refused(arm: Regressors, tmp_path: Path) -> None:
    """Those of one motor in the loaded run: no gain explains both runs, and the steps to one come to no end."""
    empty = saved(tmp_path / "a.csv", *currents(arm, 1, False), 0.02, 0)
    t, motion, i = currents(arm, 2, True)
    i[2] = currents(arm, 2, False)[2][2]
    loaded = saved(tmp_path / "b.csv", t, motion, i, 0.02, 1)
    with pytest.raises(InputError, match=r"b\.csv:1:1: no drive gain of lifter can be told: the currents contradict"):
        drive_gains(arm.model.robot, [empty], [loaded], Payload("L", {"M": 20.0}), {"M": 0.02}, regressors=arm)
