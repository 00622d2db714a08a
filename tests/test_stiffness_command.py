"""``counterpoise stiffness``: blocked outputs and steps of force, simulated apart from the code under test."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.force_steps import force_steps
from identification.locked_output import LockedOutput, locked_output
from identification.stiffness_results import document
from tests.commands import command
from tests.recorded import Recorded
from tests.stiff_arm import IA, KT, LOCKED, RATE, ROBOT, STRAIGHT, TURNED, K, N, blocked, pressed, steps

# -- blocked output -----------------------------------------------------------------------------------------------


def test_blocked_output_without_noise(tmp_path: Path) -> None:
    found = locked_output(ROBOT, 2, [blocked(tmp_path / "a.csv", noise=0.0)])
    for name in ("k2", "Offk2"):
        assert found.values[name].value == pytest.approx(LOCKED[name], rel=2e-3)
    assert found.values["Fvm2"].value == pytest.approx(LOCKED["Fvm2"], rel=0.1)
    # What the residual needs stays, however well the stiffness is known beside it.
    assert set(found.essential) == set(LOCKED)


def test_a_torque_at_its_limit_is_left_out_of_a_blocked_output(tmp_path: Path) -> None:
    path = Path(blocked(tmp_path / "a.csv", noise=0.0))
    columns = dict(Recorded.read(path).columns)
    columns["tau2"] = np.minimum(columns["tau2"], np.quantile(columns["tau2"], 0.9))
    found = locked_output(ROBOT, 2, [str(Recorded(columns).save(path))])
    assert found.values["k2"].value == pytest.approx(LOCKED["k2"], rel=2e-3)
    assert any("tau2 is cut off for" in note for note in found.notes)


def test_a_motor_slower_than_a_fifth_of_its_largest_speed_tells_nothing(tmp_path: Path) -> None:
    """Friction that sticks there, a quarter of what winds the drive train up, leaves the stiffness as it is."""
    path = Path(blocked(tmp_path / "a.csv", noise=0.0))
    columns = dict(Recorded.read(path).columns)
    speed = np.gradient(columns["q2"], columns["t"])
    sticks = np.abs(speed) < 0.18 * np.abs(speed).max()
    columns["tau2"] += np.where(sticks, 1000 * np.sign(columns["q2"] + 1.5), 0.0)
    found = locked_output(ROBOT, 2, [str(Recorded(columns).save(path))])
    assert found.values["k2"].value == pytest.approx(LOCKED["k2"], rel=2e-3)


@pytest.mark.parametrize("colour", [pytest.param(0.0, marks=pytest.mark.long), 0.95])
def test_blocked_output_lies_within_its_stated_uncertainty(colour: float, tmp_path: Path) -> None:
    """Also where noise lasts for a fifth of a second, beside motions of seconds."""

    def deviation(found: LockedOutput, name: str) -> float:
        one = found.values[name]
        assert one.value is not None
        return (one.value - LOCKED[name]) / one.std

    path = tmp_path / "a.csv"
    all_of = [
        locked_output(ROBOT, 2, [blocked(path, seed, noise=40.0 * (1 - colour), colour=colour)]) for seed in range(20)
    ]
    deviations = [deviation(one, name) for one in all_of for name in ("k2", "Fvm2")]
    assert 0.8 <= np.mean(np.abs(deviations) < 2) <= 1
    assert np.std(deviations) == pytest.approx(1.0, abs=0.35)


def test_the_balancer_is_subtracted_where_the_link_stands(tmp_path: Path) -> None:
    """Its closed form there: F0 l0 / L times the lever arm (report eq. 28, 35, 36)."""
    d21, d22, phi, l0 = 0.9669, 0.2062, -1.6293, 0.5
    q = float(locked_output(ROBOT, 2, [blocked(tmp_path / "a.csv", noise=0.0)]).runs[0][0].q[1].mean())

    def length(at: float) -> float:
        return float(np.sqrt(d21**2 + d22**2 + 2 * d21 * d22 * np.cos(phi + at)))

    arm = -d21 * d22 * np.sin(phi + q) / length(q)
    torque = 2.45e4 * l0 / (l0 - length(q) + length(0.0)) * arm
    path = blocked(tmp_path / "a.csv", noise=0.0, balancer=torque)
    found = locked_output(ROBOT, 2, [path], {"F02": 2.45e4})
    assert found.removed[0] == pytest.approx(torque, rel=1e-6)
    assert found.values["Offk2"].value == pytest.approx(LOCKED["Offk2"], rel=2e-3)


# -- steps of force -----------------------------------------------------------------------------------------------


def test_force_steps_without_noise(tmp_path: Path) -> None:
    """All but axis 6, though in the first pose the control moves axis 5 without any torque on it."""
    found = steps(tmp_path, noise=1e-3)
    assert found.components == ("fx", "fy", "fz")
    for j in range(1, 6):
        assert found.stiffness[f"k{j}"].value == pytest.approx(K[j - 1], rel=2e-3), j
        assert found.constants[f"kt{j}"].value == pytest.approx(KT[j - 1], rel=5e-3), j
    assert found.stiffness["k6"].value is None
    assert found.stiffness["k6"].refused == "fx fy fz has no lever arm about joint 6 in any pose"


def test_currents_at_their_limit_are_left_out_of_torque_constants(tmp_path: Path) -> None:
    limited = pressed(tmp_path / "straight.csv", STRAIGHT, noise=1e-3, orient=True)
    columns = dict(Recorded.read(limited).columns)
    lowest, highest = columns["i2"].min(), columns["i2"].max()
    columns["i2"] = np.minimum(columns["i2"], lowest + 0.8 * (highest - lowest))
    limited = str(Recorded(columns).save(Path(limited)))
    found = force_steps(ROBOT, [limited], {f"Ia{j}": value for j, value in enumerate(IA, 1)})
    assert any("i2 is cut off for" in note for note in found.notes)
    assert found.constants["kt2"].value == pytest.approx(KT[1], rel=0.01)


def test_one_component_through_the_wrists_centre_shows_the_arm_alone(tmp_path: Path) -> None:
    runs = [
        pressed(tmp_path / "a.csv", STRAIGHT, orient=True),
        pressed(tmp_path / "b.csv", TURNED),
    ]
    found = force_steps(ROBOT, runs, {})
    assert [name for name, one in found.stiffness.items() if one.value is None] == ["k4", "k5", "k6"]
    assert any("without the rotors' acceleration" in note for note in found.notes)
    for j in (1, 2, 3):
        assert found.stiffness[f"k{j}"].value == pytest.approx(K[j - 1], rel=5e-3), j


@pytest.mark.parametrize("resolution", [1e-6, 5e-6])
def test_encoders_that_rest_at_a_step_are_no_cut_off_signals(tmp_path: Path, resolution: float) -> None:
    found = force_steps(ROBOT, [pressed(tmp_path / "a.csv", STRAIGHT, noise=0.3, resolution=resolution)])
    for j in (2, 3):
        assert found.stiffness[f"k{j}"].value == pytest.approx(K[j - 1], rel=0.02)


def test_force_steps_lie_within_their_stated_uncertainty(tmp_path: Path) -> None:
    deviations = []
    for seed in range(6):
        found = steps(tmp_path, seed)
        for truth, values in ((K, found.stiffness), (KT, found.constants)):
            named = zip(truth, values.values(), strict=True)
            deviations += [(one.value - true) / one.std for true, one in named if one.value is not None]
    assert len(deviations) >= 54
    assert 0.86 <= np.mean(np.abs(deviations) < 2) <= 1


def test_results_and_robot_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    steps(tmp_path)
    runs = [tmp_path / "straight.csv", tmp_path / "turned.csv"]
    words = ["--pressed", "--data", *runs, "--prior", "twin", "--out", tmp_path / "steps"]
    done = command("stiffness", "kr500", *words, capsys=capsys)
    assert done.status == 0, done.err
    assert "note: k6 cannot be told: fx fy fz has no lever arm about joint 6 in any pose" in done.out
    results = json.loads((tmp_path / "steps" / "results.json").read_text())
    assert results["parameters"]["k6"]["identifiable"] is False
    assert results["parameters"]["k2"]["value"] == pytest.approx(K[1], rel=0.02)
    again = read(tmp_path / "steps" / "kr500.yaml").parameter_sets["identified_stiffness"]
    assert again.values["k2"].value == pytest.approx(results["parameters"]["k2"]["value"], rel=1e-5)
    assert again.other_values["kt3"].unit == "N m/A"
    path = blocked(tmp_path / "a.csv")
    done = command("stiffness", "kr500", "--locked", "2", "--data", path, "--out", tmp_path / "locked", capsys=capsys)
    assert done.status == 0, done.err
    results = json.loads((tmp_path / "locked" / "results.json").read_text())
    (rows,) = locked_output(ROBOT, 2, [path]).rows
    assert results["condition"] == pytest.approx(np.linalg.cond(rows[:, :-1]), rel=1e-6)
    assert results["parameters"]["k2"]["value"] == pytest.approx(LOCKED["k2"], rel=0.05)
    assert results["essential"]["parameters"]["k2"]["essential"] is True


def with_columns(path: str, signs: str, sign: float) -> str:
    """A run with columns whose names begin with one of ``signs`` times a ``sign``."""
    run = Recorded.read(path)
    other = {name: sign * values for name, values in run.columns.items() if name[:-1] in signs.split()}
    return str(run.with_columns(**other).save(Path(path)))


def test_another_sign_of_force_torque_or_current_makes_no_stiffness(tmp_path: Path) -> None:
    turned = with_columns(pressed(tmp_path / "wrench.csv", TURNED, axes="xyz"), "f", -1.0)
    with pytest.raises(InputError, match=r"can be told: the joint turns against the force; is the wrench's sign right"):
        force_steps(ROBOT, [turned])
    turned = with_columns(blocked(tmp_path / "a.csv"), "tau", -1.0)
    with pytest.raises(InputError, match=r"a.csv:1:1: k2 comes out negative: .* expected torque and position"):
        locked_output(ROBOT, 2, [turned])
    turned = with_columns(pressed(tmp_path / "currents.csv", TURNED, axes="xyz"), "i", -1.0)
    found = force_steps(ROBOT, [turned])
    assert found.stiffness["k2"].value == pytest.approx(K[1], rel=0.05)
    assert any(note.startswith("all torque constants come out negative: are the wrench or") for note in found.notes)


def test_a_run_in_which_the_blocked_motor_rests_is_told(tmp_path: Path) -> None:
    one, resting = blocked(tmp_path / "a.csv"), blocked(tmp_path / "b.csv", 1)
    run = Recorded.read(resting)
    still = np.full_like(run.columns["t"], -1.5)
    run.with_columns(q2=still, tau2=300.0 + run.columns["tau3"]).save(Path(resting))
    found = locked_output(ROBOT, 2, [one, resting])
    told = "b.csv: the motor of joint 2 hardly turns: this run tells nothing of k2"
    assert [note.endswith(told) for note in found.notes if "hardly" in note] == [True]
    assert not any("hardly turns" in note for note in locked_output(ROBOT, 2, [one]).notes)


def test_what_a_blocked_output_does_not_tell_is_refused_by_name(tmp_path: Path) -> None:
    """The viscous friction of a motor that turns slowly, in noise that is larger than its torque."""
    found = locked_output(ROBOT, 2, [blocked(tmp_path / "a.csv", noise=2000.0)])
    results = document(found)
    lost = [name for name, one in found.values.items() if one.refused]
    assert lost == ["Fvm2"]
    for name in lost:
        assert results["parameters"][name]["refused"].startswith("relative std")
        assert any(note.startswith(f"{name} cannot be told: relative std") for note in results["notes"])


def test_a_motor_that_turns_one_way_does_not_tell_friction_from_offset(tmp_path: Path) -> None:
    """Refused by name with the reason, while the stiffness is told."""
    path = Path(blocked(tmp_path / "a.csv", noise=0.0))
    columns = dict(Recorded.read(path).columns)
    x, w = columns["q2"] + 1.5, 2 * np.pi * 0.15
    ramp = 2.5e-3 * w * columns["t"]
    columns["q2"] += ramp
    a = -w * w * x
    columns["tau2"] = 900 * a + 8e3 * np.gradient(columns["q2"], columns["t"]) + 60 + 1.9e6 * (x + ramp)
    found = locked_output(ROBOT, 2, [f"{Recorded(columns).save(path)}@0:15"])
    assert found.values["k2"].value == pytest.approx(LOCKED["k2"], rel=2e-3)
    results = document(found)
    for name in ("Fcm2", "Offk2"):
        assert found.values[name].value is None
        assert f"{name} cannot be told: no motion in the data shows it alone" in results["notes"]


def test_of_one_wave_alone_inertia_is_not_told_from_stiffness(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"k2 cannot be told from Iam2 along this motion, expected .* several frequen"):
        locked_output(ROBOT, 2, [blocked(tmp_path / "a.csv", second=0.0)])


def test_runs_that_show_no_stiffness_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, here = blocked(tmp_path / "a.csv"), tmp_path
    pressed(here / "straight.csv", STRAIGHT)
    t = np.arange(3000) / RATE
    free = {f"q{j}": 0.2 * np.sin(t + j) for j in range(1, 7)} | {f"tau{j}": np.cos(t + j) for j in range(1, 7)}
    Recorded({"t": t} | free).save(here / "free.csv")
    Recorded({"t": t} | free | {"fz": t}).save(here / "fz.csv")
    cases = [
        (("--locked", "7", "--data", path), "kr500 has no moving joint 7, expected 1, 2, 3, 4, 5, 6"),
        (("--locked", "1", "--data", here / "free.csv"), "joint 1 moves by 0.4 rad, expected a blocked output"),
        (("--locked", "3", "--data", path), "k3 cannot be told: relative std"),
        (("--locked", "2", "--data", f"{path}@0:0.5"), "expected at least"),
        (("--pressed", "--data", path), "there are no columns of the wrench, expected one at least of fx fy fz"),
        (("--pressed", "--data", here / "fz.csv"), "joint 1 moves by 0.4 rad, expected a robot pressed on a stop"),
        (
            ("--pressed", "--data", path, "--prior", "twim"),
            "kr500 has no parameter set 'twim', expected perhaps 'twin'",
        ),
        (("--data", path), "one of the arguments --locked --pressed --link-encoders is required"),
    ]
    for words, error in cases:
        done = command("stiffness", "kr500", *words, "--out", here / "out", capsys=capsys)
        assert (done.status, error in done.err) == (2, True), done.err


def test_poses_with_currents_and_with_torques_go_together(tmp_path: Path) -> None:
    """Torque constants are then those of the file."""
    currents = pressed(tmp_path / "straight.csv", STRAIGHT, 1, 1e-3)
    torques = pressed(tmp_path / "turned.csv", TURNED, 2, 1e-3, "xyz")
    columns = dict(Recorded.read(torques).columns)
    tau = N.T @ (KT[:, None] * np.stack([columns.pop(f"i{j}") for j in range(1, 7)]))
    Recorded(columns | {f"tau{j}": one for j, one in enumerate(tau, 1)}).save(Path(torques))
    found = force_steps(ROBOT, [currents, torques])
    assert not found.constants
    assert found.stiffness["k1"].value == pytest.approx(K[0], rel=0.02)


def test_a_run_that_is_there_twice_is_refused(tmp_path: Path) -> None:
    one, other = blocked(tmp_path / "a.csv"), pressed(tmp_path / "b.csv", STRAIGHT)
    with pytest.raises(InputError, match=r"its samples from 0 s to .* s fit in a.csv"):
        locked_output(ROBOT, 2, [one, one])
    with pytest.raises(InputError, match=r"its samples from 0 s to .* s fit in b.csv"):
        force_steps(ROBOT, [other, other])
