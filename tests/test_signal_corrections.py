"""Section ``signals`` of a robot file on recorded runs: what was true is known, what is recorded is made from it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError, Place
from generator.robot.description import Robot
from generator.robot.readers import read
from identification import corrections
from identification.dataset import Run, load

Array = NDArray[np.float64]

ROBOT = """\
name: slide_and_wrist
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: 0, d: 0, theta: 0, r: q1}
  - {j: 2, sigma: 0, alpha: pi/2, d: 0, theta: q2, r: 0}
  - {j: 3, sigma: 0, alpha: 0, d: 0.3 m, theta: q3, r: 0}
drives:
  gear_ratios: [200, 80, -50]
  coupling: {convention: row, N32: 1/4}
  torque_constants: {unit: N m/A, use: cold, cold: [0.5, 1, 2]}
DRIFT
effects: [{effect: viscous_friction, joints: all}]
"""
N = np.array([[200.0, 0, 0], [0, 80, 0], [0, 12.5, -50]])
KT = np.array([[0.5], [1.0], [2.0]])
T = np.arange(2000) / 500.0


def positions(t: Array) -> Array:
    return np.stack([0.2 * np.sin(t), 0.5 * np.cos(1.3 * t), 0.8 * np.sin(0.7 * t + 1)])


def currents(t: Array) -> Array:
    """True currents [A]."""
    return np.stack([3 * np.sin(5 * t), 2 * np.cos(7 * t + 0.3), 4 * np.sin(3 * t) + 1])


def robot(folder: Path, signals: str, drift: str = "") -> Robot:
    path = folder / "robot.yaml"
    path.write_text(ROBOT.replace("DRIFT\n", drift) + (f"signals: {{{signals}}}\n" if signals else ""))
    return read(path)


@dataclass(frozen=True)
class Recorded:
    folder: Path
    effort: str = "i"

    def run(self, of: Robot, q: Array, i: Array, part: str = "", **more: Array) -> Run:
        values = {"i": i, "taum": KT * i, "tau": N.T @ (KT * i)}[self.effort]
        blocks = {"q": q, self.effort: values, **more}
        names = ["t", *(f"{stem}{k + 1}" for stem in blocks for k in range(3))]
        path = self.folder / "run.csv"
        np.savetxt(
            path, np.column_stack([T, *(x.T for x in blocks.values())]), delimiter=",", header=",".join(names),
            comments="",
        )  # fmt: skip
        return load(f"{path}{part}", of)


@pytest.fixture(params=["i", "taum", "tau"])
def recorded(request: pytest.FixtureRequest, tmp_path: Path) -> Recorded:
    return Recorded(tmp_path, request.param)


def test_offset_gain_and_delay_are_taken_back(recorded: Recorded) -> None:
    of = robot(
        recorded.folder,
        "position_offset: [3 mm, 20 mrad, 0 rad], torque_gain: [1.1, 0.9, 1], torque_delay: [0 s, 3 ms, 4.5 ms]",
    )
    late = T[None] - np.array([[0], [3e-3], [4.5e-3]])
    logged = np.stack([row[k] for k, row in enumerate(currents(one) for one in late)]) / [[1.1], [0.9], [1]]
    run = recorded.run(of, positions(T) - [[0.003], [0.02], [0]], logged)
    kept = T[:-3]
    np.testing.assert_allclose(run.q, positions(kept), atol=1e-12)
    expected = N.T @ (KT * currents(kept))
    np.testing.assert_allclose(run.tau, expected, atol=1e-8 * np.abs(expected).max())


def test_steps_of_efforts_grow_with_the_torques(tmp_path: Path) -> None:
    """Of a slide with a motor of its own, and of two coupled joints."""
    of = robot(tmp_path, "torque_gain: [1.25, 0.5, 2], torque_delay: [0 s, 0 s, 3 ms]")
    step = np.array([[0.01], [0.02], [0.04]])
    run = Recorded(tmp_path).run(of, positions(T), step * np.round(currents(T) / step))
    assert run.coarse is not None
    each = N * KT * [[1.25], [0.5], [2.0]] * step
    np.testing.assert_allclose(run.coarse.of_joints, np.abs(each).max(axis=0), rtol=1e-6)


def test_the_ends_of_what_is_allowed_are_allowed(tmp_path: Path) -> None:
    ends = "torque_delay: [0.1 s, -0.1 s, 0 s], torque_gain: [0.3, 3, 1], link_delay: 100 ms"
    signals = robot(tmp_path, ends).signals
    assert [float(one) for one in (*signals.torque_delay, *signals.torque_gain)] == [0.1, -0.1, 0, 0.3, 3, 1]


def test_a_negative_delay_is_one_of_positions(recorded: Recorded) -> None:
    of = robot(recorded.folder, "torque_delay: [-3 ms, 0 s, 2 ms]")
    logged = np.stack([currents(T + 3e-3)[0], currents(T)[1], currents(T - 2e-3)[2]])
    run = recorded.run(of, positions(T), logged)
    kept = T[2:-1]
    assert run.start == pytest.approx(T[2])
    np.testing.assert_allclose(run.q, positions(kept), atol=1e-12)
    expected = N.T @ (KT * currents(kept))
    np.testing.assert_allclose(run.tau, expected, atol=2e-9 * np.abs(expected).max())


def test_without_the_section_nothing_changes(recorded: Recorded) -> None:
    run = recorded.run(robot(recorded.folder, ""), positions(T), currents(T))
    assert run.samples == len(T)
    assert run.warmth is None
    np.testing.assert_allclose(run.tau, N.T @ (KT * currents(T)), atol=1e-9)


def test_link_positions_come_at_their_own_time(tmp_path: Path) -> None:
    run = Recorded(tmp_path).run(robot(tmp_path, "link_delay: 3 ms"), positions(T), currents(T), qs=positions(T - 3e-3))
    assert run.samples == len(T) - 2
    found = np.stack([run.others[f"qs{k}"] for k in (1, 2, 3)])
    np.testing.assert_allclose(found, positions(T[:-2]), atol=1e-8)
    np.testing.assert_allclose(run.tau, N.T @ (KT * currents(T[:-2])), atol=1e-9)


def test_currents_at_their_limit_leave_their_joints_out(recorded: Recorded) -> None:
    of = robot(recorded.folder, "current_limit: [10 A, 10 A, 4.5 A]")
    run = recorded.run(of, positions(T), currents(T))
    beyond = np.abs(currents(T)[2]) >= 4.5
    assert run.unusable is not None
    assert not run.unusable[0].any()
    for joint in (1, 2):  # motor 3 acts on both joints of the wrist
        np.testing.assert_array_equal(run.unusable[joint], beyond)
    assert 0.05 < beyond.mean() < 0.5


def test_marks_move_with_the_delay(tmp_path: Path) -> None:
    of = robot(tmp_path, "current_limit: [10 A, 10 A, 4.5 A], torque_delay: 4 ms")
    late = currents(T - 4e-3)
    run = Recorded(tmp_path).run(of, positions(T), late)
    assert run.unusable is not None
    true = np.abs(currents(T)[2]) >= 4.5
    assert (run.unusable[2] >= true[: run.samples]).all()
    assert run.unusable[2].sum() <= true.sum() + 20


def test_the_torque_constants_drift_with_the_warmth(recorded: Recorded) -> None:
    of = robot(recorded.folder, "warm_up_time: [1 s, 2 s, 4 s]", "  torque_drift: [-1/10, 0, 1/20]\n")
    warmth = 1 - np.exp(-T / np.array([[1.0], [2.0], [4.0]]))
    logged = currents(T) / (1 + np.array([[-0.1], [0], [0.05]]) * warmth)
    run = recorded.run(of, positions(T), logged)
    np.testing.assert_allclose(run.tau, N.T @ (KT * currents(T)), atol=1e-9)
    assert run.warmth is not None
    np.testing.assert_allclose(run.warmth, warmth, atol=1e-12)


def test_a_part_of_a_run_is_as_warm_as_the_whole_run_there(tmp_path: Path) -> None:
    of = robot(tmp_path, "warm_up_time: 2 s, warm_rise: 20 K")
    timed = Recorded(tmp_path).run(of, positions(T), currents(T), "@2:")
    assert timed.warmth is not None
    np.testing.assert_allclose(timed.warmth[0, 0], 1 - np.exp(-1), atol=1e-9)
    np.testing.assert_allclose(timed.elapsed, T[-timed.samples :], atol=1e-9)
    temperature = 25 + 5 * T[None] + np.zeros((3, 1))
    measured = Recorded(tmp_path).run(of, positions(T), currents(T), "@2:", temp=temperature)
    assert measured.warmth is not None
    np.testing.assert_allclose(measured.rises["temp1"], 5 * measured.elapsed, atol=1e-9)
    np.testing.assert_allclose(measured.warmth[1], (measured.start + timed.period * np.arange(timed.samples)) * 5 / 20)


def test_a_recording_may_begin_long_after_a_cold_start(tmp_path: Path) -> None:
    """Before it each drive was loaded as in the mean; a temperature tells a rise in the recording alone."""
    of = robot(tmp_path, "warm_up_time: [1 s, 2 s, 4 s], warm_torque: [1000000 N m, 1000000 N m, 3 N m]")
    (tmp_path / "run.yaml").write_text("since_cold: 500 ms\n")
    run = Recorded(tmp_path).run(of, positions(T), currents(T))
    part = (KT * currents(T))[2] / 3
    before = (1 - np.exp(-0.5 / 4)) * np.mean(part**2)
    assert run.warmth is not None
    np.testing.assert_allclose(run.warmth[:2], 1 - np.exp(-(T + 0.5) / np.array([[1.0], [2.0]])), atol=1e-12)
    np.testing.assert_allclose(run.warmth[2], heat(part, 2e-3, 4.0, before), atol=2e-3)
    np.testing.assert_allclose(run.elapsed, T, atol=1e-12)
    of, temperature = robot(tmp_path, "warm_rise: 20 K"), 25 + 5 * T[None] + np.zeros((3, 1))
    measured = Recorded(tmp_path).run(of, positions(T), currents(T), temp=temperature)
    assert measured.warmth is not None
    np.testing.assert_allclose(measured.warmth[0], 5 * T / 20, atol=1e-12)


def test_without_a_word_on_the_warmth_it_is_asked_for(tmp_path: Path) -> None:
    of = robot(tmp_path, "warm_up_time: [1000000 s, 2 s, 2 s]", "  torque_drift: [-1/10, 0, 1/20]\n")
    with pytest.raises(InputError, match=r"how warm the drive of joint 1 is.*expected warm_up_time.*column temp1"):
        Recorded(tmp_path).run(of, positions(T), currents(T))


def test_each_drive_goes_by_its_temperature_or_by_time(tmp_path: Path) -> None:
    """A rise that no drive reaches says nothing of its warmth."""
    of = robot(tmp_path, "warm_up_time: [1 s, 2 s, 4 s], warm_rise: [1000000 K, 20 K, 1000000 K]")
    rise = 3 * T
    for rises, second in (({"temp1": rise, "temp2": rise}, rise / 20), ({"temp1": rise}, 1 - np.exp(-T / 2))):
        found = corrections.warmth(rises, T, N.T @ currents(T), of, Place("run"))
        np.testing.assert_allclose(found, [1 - np.exp(-T), second, 1 - np.exp(-T / 4)], atol=1e-12)


def heat(motor: Array, period: float, time: float, before: float = 0.0) -> Array:
    """Of a motor's torque in parts of the usual one, by many small steps."""
    w, found = before, []
    for part in motor:
        found.append(w)
        for _ in range(20):
            w += period / 20 / time * (part**2 - w)
    return np.array(found)


def test_a_drive_is_heated_by_what_its_motor_is_recorded_to_do(tmp_path: Path) -> None:
    of = robot(tmp_path, "warm_up_time: 2 s, warm_torque: [2 N m, 1000000 N m, 3 N m]")
    assert [corrections.by_heat(of, k) for k in range(3)] == [True, False, True]
    found = Recorded(tmp_path).run(of, positions(T), currents(T)).warmth
    motor = KT * currents(T)
    assert found is not None
    assert found[0] == pytest.approx(heat(motor[0] / 2, 2e-3, 2.0), abs=2e-4)
    assert found[1] == pytest.approx(1 - np.exp(-T / 2), abs=1e-12)
    assert found[2] == pytest.approx(heat(motor[2] / 3, 2e-3, 2.0), abs=2e-3)
    part = Recorded(tmp_path).run(of, positions(T), currents(T), "@2:").warmth
    assert part is not None
    before = (1 - np.exp(-1)) * np.mean((motor[0, 1000:] / 2) ** 2)
    assert part[0] == pytest.approx(heat(motor[0, 1000:] / 2, 2e-3, 2.0, before), abs=2e-4)


@pytest.mark.parametrize(
    ("entry", "rise"), [("warm_up_time: 2 s, warm_torque: 0.2 N m", 0.0), ("warm_rise: 20 K", 15.0)]
)
def test_a_drive_too_warm_for_its_drift_is_refused(entry: str, rise: float, tmp_path: Path) -> None:
    """A torque constant of another sign would turn torques round."""
    of, cold = (robot(tmp_path, entry, f"  torque_drift: [0, {drift}, 0]\n") for drift in ("-1/2", "1/2"))
    temperature = 25 + rise * T[None] + np.zeros((3, 1))
    with pytest.raises(
        corrections.TooWarm, match=r"^.*run\.csv:1:1: the drive of joint 2 comes to a warmth of [\d.]+ by"
    ) as told:
        Recorded(tmp_path).run(of, positions(T), currents(T), temp=temperature)
    assert told.value.joint == 2
    Recorded(tmp_path).run(cold, positions(T), currents(T), temp=temperature)


def test_a_temperature_tells_more_than_the_heat(tmp_path: Path) -> None:
    of = robot(tmp_path, "warm_up_time: 2 s, warm_torque: 2 N m, warm_rise: 20 K")
    found = corrections.warmth({"temp1": 5 * T}, T, N.T @ (KT * currents(T)), of, Place("run"))
    assert found is not None
    np.testing.assert_allclose(found[0], T / 4, atol=1e-12)
    assert found[1] == pytest.approx(heat(currents(T)[1] / 2, 2e-3, 2.0), abs=5e-4)


def test_only_drives_that_drift_need_a_temperature(tmp_path: Path) -> None:
    of = robot(tmp_path, "warm_rise: [20 K, 20 K, 1000000 K]", "  torque_drift: [0, -1/10, 0]\n")
    found = corrections.warmth({"temp2": 5 * T}, T, N.T @ currents(T), of, Place("run"))
    assert found is not None
    np.testing.assert_allclose(found[1], T / 4, atol=1e-12)
    assert np.isnan(found[[0, 2]]).all()
    motor = corrections.true_torques(N.T @ currents(T), of, 2e-3, found)
    np.testing.assert_allclose(np.linalg.solve(N.T, motor), currents(T) * [T**0, 1 - 0.1 * T / 4, T**0], atol=1e-9)
    with pytest.raises(InputError, match=r"how warm the drive of joint 2 is.*expected a column temp2, or warm_up_time"):
        Recorded(tmp_path).run(of, positions(T), currents(T))


def test_a_limit_of_currents_needs_torque_constants(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    text = ROBOT.replace("DRIFT\n", "").replace("  torque_constants: {unit: N m/A, use: cold, cold: [0.5, 1, 2]}\n", "")
    path.write_text(text + "signals: {current_limit: 5 A}\n")
    with pytest.raises(InputError, match=r"current_limit without torque constants"):
        Recorded(tmp_path, "taum").run(read(path), positions(T), currents(T))


@pytest.mark.parametrize(
    "entry",
    ["warm_up_time: 0 s", "warm_rise: -1 K", "warm_torque: 0 N m", "warm_up_time: [1 s, 2 s]"],
)
def test_bad_warmth_is_refused(entry: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="warm_"):
        robot(tmp_path, entry)


def test_currents_alone_tell_the_same_warmth(tmp_path: Path) -> None:
    """Where torque constants are sought, those of the file still say what a motor's torque is."""
    of = robot(
        tmp_path, "warm_up_time: 2 s, warm_torque: [2 N m, 3 N m, 1000000 N m]", "  torque_drift: [-1/20, 0, 0]\n"
    )
    usual = Recorded(tmp_path).run(of, positions(T), currents(T))
    alone = load(str(tmp_path / "run.csv"), corrections.with_unit_constants(of), efforts=("i",))
    assert usual.warmth is not None
    assert alone.warmth is not None
    np.testing.assert_allclose(alone.warmth, usual.warmth, rtol=1e-9)
    np.testing.assert_allclose(np.linalg.solve(N.T, usual.tau), KT * np.linalg.solve(N.T, alone.tau), rtol=1e-9)


@pytest.mark.parametrize("part", ["", "@1:3"])
def test_a_temperature_that_is_unknown_where_the_recording_begins_is_refused(part: str, tmp_path: Path) -> None:
    """A part of it rises from there too."""
    of = robot(tmp_path, "warm_rise: 20 K", "  torque_drift: [-1/20, -1/10, 0]\n")
    temperature = 25 + T * np.ones((3, 1))
    temperature[1, 0] = np.nan
    with pytest.raises(InputError, match=r"run\.csv:2:\d+: temp2 is nan, expected a finite number"):
        Recorded(tmp_path).run(of, positions(T), currents(T), part, temp=temperature)
