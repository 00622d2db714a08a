"""Diagnoses of one link in a vertical plane, with and without a torque that its file does not know."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import unescape
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

from generator.robot.readers import read
from identification import recipes
from identification.dataset import load
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.command import Request, diagnosed
from identification.diagnosis.diagnosis import Diagnosis, diagnose
from identification.diagnosis.mending.mended import Mended, mended
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.runs.roles import Roles
from identification.observation import Regressors
from identification.report.diagnose.report import report
from tests.recorded import Array, Recorded, fourier

#: A torque [N m] over the position [rad] and the speed [rad/s].
Hidden = Callable[[Array, Array], Array]

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
    regressors, sources = recorded(folder, [torque(hidden)] * 3)
    *runs, last = (ready(one, regressors) for one in sources)
    roles = Roles((sources[0],), (sources[1],), (sources[2],), tuple(sources[:2]))
    found = diagnose(regressors, runs, roles, test=[last])
    after = mended(folder / "arm.yaml", found, None, folder / "out") if hidden == "stribeck" else None
    return Case(found, after, report(found, after))


def recorded(
    folder: Path,
    hidden: Sequence[Hidden],
    arm: str = ARM,
    truth: Mapping[str, float] = TRUTH,
    noise: float = NOISE,
    *,
    stays: float = STAYS,
    draws: int = 1,
    seconds: float = 40.0,
    rate: float = 100.0,
    slowest: float = 0.1,
) -> tuple[Regressors, list[str]]:
    """The arm, and a run file for each torque that its file does not know, of so many ``seconds`` at a ``rate`` [Hz],
    with sines from the ``slowest`` one [Hz] on; ``draws`` is the seed of the noise.
    """
    (folder / "arm.yaml").write_text(arm)
    robot = read(folder / "arm.yaml")
    regressors, draw = Regressors(robot), np.random.default_rng(draws)
    sources = []
    for seed, one in enumerate(hidden, 1):
        t, motion = fourier(robot, seconds, rate, seed, slowest)
        tau = regressors.torques(truth, motion)[0] + one(motion.q[0], motion.qd[0])
        tau += lfilter([1], [1, -stays], noise * draw.normal(size=len(t)))
        sources.append(str(Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(folder / f"{seed}.csv")))
    return regressors, sources


def rewritten(source: str, change: Callable[[Array, Array, Array], tuple[Array, Array, Array]]) -> None:
    """The run file with other times [s], positions [rad] and torques [N m] (N each) of the arm."""
    t, q, tau = change(*Recorded.read(source).columns.values())
    Recorded({"t": t, "q1": q, "tau1": tau}).save(Path(source))


def ready(source: str, regressors: Regressors) -> Prepared:
    """A run as a diagnosis looks at it."""
    robot = regressors.model.robot
    recipe = recipes.recipe_of(robot.name)
    return prepared(load(source, robot, recipe.columns), recipe, regressors)


def diagnosis_of(sources: Sequence[str], regressors: Regressors, known: str | None = None) -> Diagnosis:
    """Of runs of which the last one validates and none tests; ``known`` is a set of the robot's, or all is fitted."""
    runs = [ready(source, regressors) for source in sources]
    prior = None if known is None else prior_of(regressors.model, known)
    return diagnose(regressors, runs, Roles(tuple(sources[:-1]), (sources[-1],), (), tuple(sources)), prior)


def answered(path: Path, wanted: Request, out: Path) -> tuple[Diagnosis, Mended | None]:
    """What the command finds of the robot file ``path``, and the mended robot, with files in ``out`` and no page."""
    found, new, _ = diagnosed(path, read(path), wanted, out, lambda *about: {})
    return found, new


def torque(hidden: str) -> Hidden:
    """What ``stribeck`` friction makes, and with ``asymmetry`` viscous friction that is larger one way."""

    def of(q: Array, qd: Array) -> Array:
        result = np.zeros_like(qd)
        if "stribeck" in hidden:
            result += 6.0 * np.sign(qd) * np.exp(-((qd / 0.15) ** 2))
        if "asymmetry" in hidden:
            result += 8.0 * np.maximum(qd, 0.0)
        return np.asarray(result)

    return of


def bumps(size: float, width: float) -> Hidden:
    """Torques of a ``size`` [N m] at two places, up and down, each of a ``width`` [rad], which no law makes."""

    def of(q: Array, qd: Array) -> Array:
        return np.asarray(size * (np.exp(-(((q - 0.5) / width) ** 2)) - np.exp(-(((q + 0.3) / width) ** 2))))

    return of
