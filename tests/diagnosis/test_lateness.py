"""Delays as long as what the torque swings by: no small change of a torque, and no model is right without them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from generator.robot.readers import read
from identification.corrections import earlier, recorded_motor_torques
from identification.diagnosis.candidates.torque_delay import _quieter
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis
from identification.diagnosis.columns.lateness import Lateness, closer, delay_of, latenesses
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis
from identification.diagnosis.runs.scene import Scene
from identification.drive_train import coupling
from identification.observation import Motion, Regressors
from identification.outcome import Value
from tests.diagnosis.diagnosed_arm import ARM, diagnosis_of, ready
from tests.diagnosis.diagnosed_arm import TRUTH as LINK
from tests.recorded import TRUTH, TWO_LINKS, Array, Recorded, fourier

RATE = 250.0
#: Frequency [Hz] of what both links swing by beside a slow motion.
SWING = 14.0


def swinging(t: Array, slow: Motion) -> Motion:
    """A slow motion with a small quick one, whose torque is the larger."""
    w = 2 * np.pi * SWING
    phase = np.array([[0.3], [1.1]]) + w * t
    size = np.array([[0.004], [0.006]])
    return replace(
        slow,
        q=slow.q + size * np.sin(phase),
        qd=slow.qd + size * w * np.cos(phase),
        qdd=slow.qdd - size * w**2 * np.sin(phase),
    )


def late_by(folder: Path, delays: tuple[int, int], text: str = TWO_LINKS, stated: int = 0) -> Diagnosis:
    """Of two links whose motors are recorded late by so many milliseconds, of which the file does not know, or says
    other ones.
    """
    said = f"signals: {{torque_delay: [{stated} ms, {stated} ms]}}\n" if stated else ""
    (folder / "two_links.yaml").write_text(text + said)
    (folder / "late.yaml").write_text(f"{text}signals: {{torque_delay: [{delays[0]} ms, {delays[1]} ms]}}\n")
    robot, true, draw = read(folder / "two_links.yaml"), read(folder / "late.yaml"), np.random.default_rng(3)
    regressors, sources = Regressors(robot), []
    for number in range(3):
        t, slow = fourier(robot, 30.0, RATE, number)
        motion = swinging(t, slow)
        motors = np.linalg.solve(coupling(robot).T, regressors.torques(TRUTH, motion))
        motors = recorded_motor_torques(motors, true, 1 / RATE, None) + 0.02 * draw.normal(size=motors.shape)
        q = coupling(robot) @ motion.q
        columns = {"t": t, "qm1": q[0], "qm2": q[1], "taum1": motors[0], "taum2": motors[1]}
        sources.append(str(Recorded(columns).save(folder / f"{number}.csv")))
    return diagnosis_of(sources, regressors)


@pytest.mark.parametrize("delay", [16, -20])
@pytest.mark.long
def test_all_torques_are_late_by_a_quarter_of_a_period(delay: int, tmp_path: Path) -> None:
    found = late_by(tmp_path, (delay, delay))
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.key == ("torque_delay", 0)
    assert one.parameters["torque_delay"].value == pytest.approx(1e-3 * delay, abs=2e-4)


@pytest.mark.long
@pytest.mark.parametrize("motor", [1, 2])
def test_one_motor_is_late_by_a_quarter_of_a_period(motor: int, tmp_path: Path) -> None:
    """It drives a joint that another motor drives as well, of which nothing is late."""
    delays = (18 * (motor == 1), 18 * (motor == 2))
    found = late_by(tmp_path, delays, TWO_LINKS.replace("N21: 5", "N21: 60"))
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.key == ("torque_delay", motor)
    assert one.parameters[f"torque_delay{motor}"].value == pytest.approx(0.018, abs=3e-4)


@pytest.mark.long
@pytest.mark.parametrize(
    ("delays", "joints"),
    [
        ((12, -8), (1, 2)),
        ((16, -16), (1, 2)),
        ((16, 22), (0, 1)),
    ],
)
def test_motors_are_late_by_unlike_times(delays: tuple[int, int], joints: tuple[int, int], tmp_path: Path) -> None:
    """Each by its own, or one beyond a delay of all: neither is what the other one's law lacks."""
    found = late_by(tmp_path, delays, TWO_LINKS.replace("N21: 5", "N21: 60"))
    assert found.verdict == NAMED
    assert tuple(sorted(one.hypothesis.joint for one in found.findings)) == joints
    told = {name: value.value or 0.0 for one in found.findings for name, value in one.parameters.items()}
    for motor, delay in enumerate(delays, 1):
        whole = told.get("torque_delay", 0.0) + told.get(f"torque_delay{motor}", 0.0)
        assert whole == pytest.approx(1e-3 * delay, abs=3e-4)


@pytest.mark.long
def test_torques_are_late_by_more_than_is_stated(tmp_path: Path) -> None:
    (one,) = late_by(tmp_path, (4, 4), stated=-3).findings
    assert one.hypothesis.key == ("torque_delay", 0)
    assert one.hypothesis.title == "delay between torque and position of all joints beyond the stated one"
    assert one.parameters["torque_delay"].value == pytest.approx(7e-3, abs=2e-4)


@pytest.mark.long
def test_torques_that_are_as_late_as_is_stated_are_nothing(tmp_path: Path) -> None:
    assert late_by(tmp_path, (4, 4), stated=4).verdict == NOTHING


def test_nothing_is_late_where_nothing_is(tmp_path: Path) -> None:
    assert late_by(tmp_path, (0, 0)).verdict == NOTHING


def test_a_delay_is_as_uncertain_as_coloured_noise_leaves_it(tmp_path: Path) -> None:
    """Rows of such noise tell of one another: white ones would tell the delay three times as closely."""
    (tmp_path / "arm.yaml").write_text(ARM)
    regressors, draw = Regressors(read(tmp_path / "arm.yaml")), np.random.default_rng(0)
    delay, off = 0.03, []
    for _ in range(12):
        scenes = []
        for number in (1, 2):
            t, motion = fourier(regressors.model.robot, 30.0, 100.0, number)
            tau = earlier(regressors.torques(LINK, motion), [-delay], 0.01)
            noise = lfilter([1], [1, -0.8], draw.normal(size=tau.shape))
            source = Recorded({"t": t, "q1": motion.q[0], "tau1": (tau + 0.7 * noise / noise.std())[0]})
            run = ready(str(source.save(tmp_path / f"{number}.csv")), regressors)
            scenes.append(Scene(run.sampled, regressors, LINK))
        found = delay_of(latenesses(scenes).own)
        assert found is not None
        assert found.std is not None
        off.append(((found.value or 0.0) - delay) / found.std)
    assert 0.5 < np.sqrt(np.mean(np.square(off))) < 1.7


def test_all_motors_at_once_tell_their_delay_more_closely(tmp_path: Path) -> None:
    """Than each by itself: they have parameters in common."""
    (tmp_path / "two_links.yaml").write_text(TWO_LINKS)
    robot, draw = read(tmp_path / "two_links.yaml"), np.random.default_rng(1)
    regressors, delay, apart, at_once = Regressors(robot), 0.004, [], []
    for number in range(6):
        t, motion = fourier(robot, 20.0, 125.0, number)
        tau = regressors.torques(TRUTH, motion)
        tau = earlier(tau, [-delay, -delay], 0.008) + 0.002 * tau.std() * draw.normal(size=tau.shape)
        columns = {"t": t, "q1": motion.q[0], "q2": motion.q[1], "tau1": tau[0], "tau2": tau[1]}
        run = ready(str(Recorded(columns).save(tmp_path / "a.csv")), regressors)
        late = latenesses([Scene(run.sampled, regressors, TRUTH)])
        for told, kept in ((closer(late.own, delay), apart), (closer(late.together, delay), at_once)):
            assert told is not None
            kept.append([(told.value or 0.0) - delay, told.std])
    (far, wide), (off, std) = np.array(apart).T, np.array(at_once).T
    assert np.mean(std) < 0.85 * np.mean(wide)
    assert np.mean(off**2) < 0.5 * np.mean(far**2)
    assert 0.4 < np.sqrt(np.mean((off / std) ** 2)) < 1.8
    assert closer(late.together, 5 * delay) is None
    assert closer([None], delay) is None


def profile(delay: float, depth: float) -> Lateness:
    """Of 1000 rows of noise and of a torque that swings by ``depth`` of its power, late by ``delay``."""
    delays = 0.001 * np.arange(-30, 31)
    left = 1000.0 * (1 + depth * (1 - np.cos(2 * np.pi * SWING * (delays - delay))))
    return Lateness(delays, (), np.empty((0, len(delays))), left, 1000, 1.0)


def test_a_delay_is_told_between_samples_and_beyond_one_that_is_known() -> None:
    found, more = delay_of([profile(0.0093, 3.0)]), delay_of([profile(0.0093, 3.0)], 0.02)
    assert found is not None
    assert more is not None
    assert found.value == pytest.approx(0.0093, abs=1e-4)
    assert more.value == pytest.approx(0.0093 - 0.02, abs=1e-4)


def test_beyond_the_delay_that_is_known_there_is_none() -> None:
    """Though delays are tried a millisecond apart, and a sharp valley costs more between them."""
    known = delay_of([profile(0.0093, 300.0)])
    assert known is not None
    assert known.value is not None
    assert delay_of([profile(0.0093, 300.0)], known.value) is None


@pytest.mark.parametrize("unlike", [[profile(0.009, 0.1)], [profile(0.0, 3.0)], [profile(0.035, 3.0)], [None], []])
def test_no_delay_is_told_that_leaves_little_less_or_lies_at_the_end(unlike: list[Lateness | None]) -> None:
    assert delay_of(unlike) is None


def test_a_delay_of_several_motors_is_told_by_more_than_one() -> None:
    alike, none, other = profile(0.0093, 3.0), profile(0.0, 3.0), profile(-0.0093, 3.0)
    found = delay_of([alike, alike, none])
    assert found is not None
    assert found.value == pytest.approx(0.007, abs=3e-4)
    assert delay_of([alike, none]) is None
    assert delay_of([alike, other]) is None


def test_of_delays_a_period_apart_that_leave_the_same_it_is_the_shortest() -> None:
    delays = 0.001 * np.arange(-100, 101)
    swing = 1 + 3.0 * (1 - np.cos(2 * np.pi * SWING * (delays - 0.016)))
    far = np.exp(-0.05 * (delays < -0.02))
    found = delay_of([Lateness(delays, (), np.empty((0, len(delays))), swing * far, 1000, 1.0)])
    assert found is not None
    assert found.value == pytest.approx(0.016, abs=1e-3)
    clear = delay_of([Lateness(delays, (), np.empty((0, len(delays))), swing * far**10, 1000, 1.0)])
    assert clear is not None
    assert clear.value == pytest.approx(0.016 - 1 / SWING, abs=1e-3)


def test_of_few_rows_a_ripple_near_none_hides_no_delay() -> None:
    """The square root of 150 rows, four times, is more than a delay must leave."""
    delays = 0.001 * np.arange(-30, 31)
    valley = 1 - 0.27 * np.exp(-(((delays - 0.012) / 0.004) ** 2)) - 0.01 * np.exp(-((delays / 0.001) ** 2))
    found = delay_of([Lateness(delays, (), np.empty((0, len(delays))), valley, 150, 1.0)])
    assert found is not None
    assert found.value == pytest.approx(0.012, abs=5e-4)


def test_motors_whose_rows_are_too_few_tell_one_delay_together(tmp_path: Path) -> None:
    """Five for each parameter are not in the rows of the motor that drives both links, but in those of both motors."""
    (tmp_path / "two_links.yaml").write_text(TWO_LINKS)
    robot, draw = read(tmp_path / "two_links.yaml"), np.random.default_rng(5)
    regressors, delay = Regressors(robot), 0.018
    t, slow = fourier(robot, 4.0, RATE, 1)
    motion = swinging(t, slow)
    motors = np.linalg.solve(coupling(robot).T, regressors.torques(TRUTH, motion))
    motors = earlier(motors, [-delay, -delay], 1 / RATE) + 0.02 * draw.normal(size=motors.shape)
    q = coupling(robot) @ motion.q
    columns = {"t": t, "qm1": q[0], "qm2": q[1], "taum1": motors[0], "taum2": motors[1]}
    run = ready(str(Recorded(columns).save(tmp_path / "short.csv")), regressors)
    late = latenesses([Scene(run.sampled, regressors, TRUTH)])
    assert late.own[0] is None
    assert None not in late.shared
    found = delay_of(late.shared)
    assert found is not None
    assert found.value == pytest.approx(delay, abs=1e-3)


def test_of_few_rows_noise_tells_no_delay() -> None:
    """What 13 parameters take of it differs from delay to delay."""
    delays = 0.001 * np.arange(-30, 31)
    valley = 1 - 0.35 * np.exp(-(((delays - 0.012) / 0.004) ** 2))
    names = tuple(f"X{number}" for number in range(13))
    assert delay_of([Lateness(delays, names, np.empty((13, len(delays))), valley, 65, 1.0)]) is None
    assert delay_of([Lateness(delays, names, np.empty((13, len(delays))), valley, 130, 1.0)]) is not None


def test_the_column_of_a_delay_is_of_the_torque_that_has_less_noise() -> None:
    """Clean, noisier than the model's, and beside a model's that is clean: what both have in common is the delay's."""
    draw, count = np.random.default_rng(0), 4000
    true = np.sin(0.01 * np.arange(count)) * np.ones((3, 1))
    noise = np.convolve(draw.normal(size=count), np.ones(40) / 40, "same")
    noise *= 0.6 / np.std(noise)
    recorded, modelled = true.copy(), true + noise
    recorded[1] += 2 * noise[::-1]
    modelled[2] = true[2]
    recorded[2] += 0.1 * noise
    assert _quieter(recorded, modelled).tolist() == [True, False, False]


@pytest.mark.parametrize(("held", "drop"), [(0.5, 3.0), (1.0, 4.0), (-0.5, 0.0)])
def test_what_is_held_is_weighed_as_it_is(held: float, drop: float) -> None:
    """2 b x - A x^2 with A = b = 4, which is most at 1; a value that raises the sum of squares explains nothing."""
    one = Hypothesis(
        "torque_delay",
        "",
        1,
        (Coefficient("torque_delay1", "s", -0.1, 0.1),),
        lambda *_: np.zeros((1, 1, 1)),
        preset={"torque_delay1": Value(held, 1e-3, "s")},
    )
    x, found = Variant(one, {}, (5,), (0,), (0,)).best(np.array([[4.0]]), np.array([4.0]), np.array([4.0]))
    assert x.tolist() == [held]
    assert found == pytest.approx(drop)
