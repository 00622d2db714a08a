"""The report of a diagnosis: what it says in words is what was hidden, and its numbers are those of the result."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from generator.robot.readers import read
from identification import recipe as recipes
from identification.dataset import load
from identification.diagnosis.diagnosis import NAMED, NOTHING, UNEXPLAINED, Diagnosis, diagnose
from identification.diagnosis.mending import Mended, mended
from identification.diagnosis.noise_floor import noise_floor
from identification.diagnosis.prepared import prepared
from identification.diagnosis.roles import Roles
from identification.observation import Regressors
from identification.report.diagnose.report import report
from identification.report.diagnose.subject import Subject
from identification.report.numbers import plain
from tests.recorded import Array, Recorded, fourier
from tests.reports import Page

#: One link in a vertical plane.
ARM = """\
name: arm
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0, limits: [-160 deg, 160 deg]}
effects:
  - {effect: viscous_friction, joint: 1}
  - {effect: coulomb_friction, joint: 1}
  - {effect: offset, joint: 1}
"""
TRUTH = {"ZZ1": 9.0, "MX1": 11.0, "MY1": 0.6, "Fv1": 14.0, "Fc1": 9.0, "Off1": 1.5}
#: Deviation of what drives the noise [N m], and how much of it stays from one sample to the next.
NOISE, STAYS = 0.4, 0.8


@dataclass(frozen=True)
class Case:
    """A diagnosis with its page as text, and what became of the robot."""

    found: Diagnosis
    after: Mended | None
    page: bytes

    @property
    def words(self) -> str:
        """The text of the page before the charts' script, without tags."""
        body = self.page.decode().split("<main>")[1].split("</main>")[0]
        plain = re.sub(r"<script.*?</script>|<[^>]+>", " ", body, flags=re.DOTALL)
        return re.sub(r"\s+", " ", unescape(plain))


def case(folder: Path, hidden: str) -> Case:
    """Three runs, the last one untouched, with a torque in them that the file does not know."""
    (folder / "arm.yaml").write_text(ARM)
    robot = read(folder / "arm.yaml")
    regressors, draw = Regressors(robot), np.random.default_rng(1)
    sources = []
    for seed in (1, 2, 3):
        t, motion = fourier(robot, 40.0, 100.0, seed)
        tau = regressors.torques(TRUTH, motion)[0] + torque(hidden, motion.q[0], motion.qd[0])
        tau += lfilter([1], [1, -STAYS], NOISE * draw.normal(size=len(t)))
        sources.append(str(Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(folder / f"{seed}.csv")))
    recipe = recipes.recipe_of(robot.name)
    runs = [prepared(load(one, robot, recipe.columns), recipe, regressors) for one in sources[:2]]
    found = diagnose(regressors, runs, Roles((sources[0],), (sources[1],), (sources[2],)))
    after = mended(folder / "arm.yaml", found, None, folder / "out") if hidden == "stribeck" else None
    return Case(found, after, report(found, after))


def torque(hidden: str, q: Array, qd: Array) -> Array:
    if hidden == "stribeck":
        return np.asarray(6.0 * np.sign(qd) * np.exp(-((qd / 0.15) ** 2)))
    if hidden == "bump":
        return np.asarray(6.0 * np.exp(-(((q - 0.3) / 0.03) ** 2)))
    return np.zeros_like(q)


@pytest.fixture(scope="module")
def named(tmp_path_factory: pytest.TempPathFactory) -> Case:
    return case(tmp_path_factory.mktemp("named"), "stribeck")


def test_the_words_name_effect_joint_and_how_sure_it_is(named: Case) -> None:
    assert named.found.verdict == NAMED
    one = named.found.findings[0]
    assert one.hypothesis.effect == "stribeck_friction"
    assert f"The model lacks {one.hypothesis.title} on joint 1" in named.words
    value = one.parameters["Fst1"].value
    assert value is not None
    assert f"Fst1 = {plain(value, 4)} ± " in named.words
    assert f"It is {one.status}" in named.words
    assert "of the gap between the two, in squares, is closed" in named.words


def test_the_untouched_run_is_measured_against_noise(named: Case) -> None:
    subject = Subject(named.found, named.after)
    one = subject.tried[1]
    (_, before, after), k = subject.tested[0], 0
    for played, size in ((before, one.before), (after, one.after)):
        rows = before.kept[k] & after.kept[k]
        assert size == pytest.approx(float(np.sqrt(np.mean((played.measured - played.model)[k, rows] ** 2))))
    assert one.closed is not None
    assert one.closed > 0.9
    assert one.after == pytest.approx(one.floor, rel=0.2)


def test_the_noise_floor_is_that_of_the_noise_made(named: Case) -> None:
    """The rms of what a first-order filter leaves of white noise, below the decimation's corner."""
    rate = 20.0
    f = np.linspace(0, 0.8 * rate / 2, 2000)
    density = 2 * NOISE**2 / 100.0 / np.abs(1 - STAYS * np.exp(-2j * np.pi * f / 100.0)) ** 2
    made = math.sqrt(float(np.trapezoid(density, f)))
    assert noise_floor(named.found.found.bank, 0, rate) == pytest.approx(made, rel=0.15)


def test_every_section_of_a_finding_is_there(named: Case) -> None:
    for title in (
        "Where: lack of fit of each joint", "Where: residual over position, speed, load, time", "What is missing",
        "Where: spectrum of the residual", "Ranking of the candidates", "From the start to the noise",
        "Before and after on untouched runs", "What changed in the robot file", "Parameters of the new model",
        "Invisible on this data", "Runs and method",
    ):  # fmt: skip
        assert title in named.words, title
    assert "stribeck_friction, joint: 1" in named.words
    page = Page(named.page)
    assert all(trace["y"] for one in page.charts for trace in one["data"])
    assert named.after is not None
    assert page.rows["Fst1"][0] == pytest.approx(named.after.fit.values["Fst1"])
    assert report(named.found, named.after) == named.page


def test_a_right_model_is_said_to_be_right(tmp_path: Path) -> None:
    one = case(tmp_path, "nothing")
    assert one.found.verdict == NOTHING
    assert "The model explains these runs" in one.words
    assert "What is missing" not in one.words
    assert "Before and after on untouched runs" not in one.words


def test_what_no_effect_explains_is_said_to_be_unexplained(tmp_path: Path) -> None:
    one = case(tmp_path, "bump")
    assert one.found.verdict == UNEXPLAINED
    assert "Something is missing in the model that no effect of the library explains: joint 1" in one.words
