"""Runs with torques of another sign or unit than the rest are refused, not explained."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.dataset import load
from identification.diagnosis import plausibility
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.command import Request
from identification.diagnosis.plausibility import of_one_sign
from identification.diagnosis.runs.prepared import Prepared, prepared
from identification.diagnosis.runs.scene import Scene
from identification.inverse_model import identify
from identification.recipes import Recipe
from identification.suspicion import misread
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, answered, recorded, torque
from tests.recorded import TRUTH as LINKS
from tests.recorded import Recorded, as_recorded, fourier, two_links

#: What the arm's file knows beforehand.
_UNITS = {"ZZ1": "kg m2", "MX1": "kg m", "MY1": "kg m", "Fv1": "N m s/rad", "Fc1": "N m", "Off1": "N m"}
_VALUES = "".join(f"      {name}: {{value: {value}, unit: {_UNITS[name]}}}\n" for name, value in TRUTH.items())
SET = f"parameters:\n  known:\n    description: d\n    source: s\n    values:\n{_VALUES}"


def diagnose(folder: Path, factors: list[float], prior: str | None = None, dry: bool = False) -> None:
    """Of runs whose torques are multiplied by ``factors``, with a set of the true parameters as ``prior``."""
    _, sources = recorded(folder, [torque("")] * len(factors), ARM + SET)
    for source, factor in zip(sources, factors, strict=True):
        run = Recorded.read(source)
        run.with_columns(tau1=factor * run.columns["tau1"]).save(Path(source))
    path = folder / "arm.yaml"
    answered(path, Request(sources, prior=prior, dry=dry), folder / "out")


def test_a_run_with_torques_of_another_sign_is_refused(tmp_path: Path) -> None:
    message = r"2.csv:1:1: the torques have another sign than those of the other runs, expected one sign"
    with pytest.raises(InputError, match=message):
        diagnose(tmp_path, [1.0, -1.0, 1.0, 1.0])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("dry", [False, True])
def test_the_sign_of_a_run_that_tests_is_looked_at_too(dry: bool, tmp_path: Path) -> None:
    """The last of three runs tests, or is fitted like the others where nothing is tested."""
    with pytest.raises(InputError, match=r"3.csv:1:1: the torques have another sign than those of the other runs"):
        diagnose(tmp_path, [1.0, 1.0, -1.0], dry=dry)
    fitted, test = [[tmp_path / name] for name in ("1.csv", "3.csv")]
    with pytest.raises(InputError, match=r"3.csv:1:1: the torques have another sign than those that are fitted"):
        identify(read(tmp_path / "arm.yaml"), fitted, test)


@pytest.mark.parametrize("factor", [pytest.param(0.5, marks=pytest.mark.long), 2.0])
def test_a_run_that_tests_with_torques_of_another_size_is_no_mistake(factor: float, tmp_path: Path) -> None:
    diagnose(tmp_path, [1.0, 1.0, factor])
    fitted, test = [[tmp_path / name] for name in ("1.csv", "3.csv")]
    assert identify(read(tmp_path / "arm.yaml"), fitted, test).full.test is not None


def test_runs_of_which_most_stays_unexplained_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"1.csv:1:1: the model of arm leaves \d+ % of the torques unexplained"):
        diagnose(tmp_path, [1.0, 1000.0])


def test_torques_that_all_have_the_other_sign_are_refused(tmp_path: Path) -> None:
    message = "1.csv:1:1: all friction and inertia that the torques show alone is negative, expected torques of the dri"
    with pytest.raises(InputError, match=message):
        diagnose(tmp_path, [-1.0, -1.0])
    with pytest.raises(InputError, match=message):
        identify(read(tmp_path / "arm.yaml"), [tmp_path / "1.csv"])


@pytest.mark.parametrize("dry", [False, True])
def test_torques_of_another_sign_than_what_was_known_are_refused(dry: bool, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"1.csv:1:1: the torques have another sign than the known parameters"):
        diagnose(tmp_path, [-1.0], "known", dry)


def test_torques_of_one_joint_that_have_the_other_sign_are_refused(tmp_path: Path) -> None:
    """The other joint's are as they should be."""
    regressors, draw, sources = two_links(tmp_path), np.random.default_rng(3), []
    robot = regressors.model.robot
    for seed in (1, 2):
        t, motion = fourier(robot, 10.0, 250.0, seed)
        tau = regressors.torques(LINKS, motion) + 0.3 * draw.normal(size=motion.q.shape)
        turned = tau * np.array([[1.0], [-1.0]])
        sources.append(str(as_recorded(regressors, t, motion.q, turned).save(tmp_path / f"{seed}.csv")))
    message = "1.csv:1:1: all friction and inertia that the torques of joint 2 show alone is negative"
    with pytest.raises(InputError, match=message):
        answered(tmp_path / "two_links.yaml", Request(sources), tmp_path / "out")
    with pytest.raises(InputError, match=message):
        identify(robot, [Path(one) for one in sources])


@pytest.mark.parametrize(
    ("way", "away", "hint"),
    [
        ((1.0, 1.0), (0.0, 0.0), None),
        (
            (1.0, -1.0),
            (0.0, 0.0),
            "with positions and torques of joint 2 the other way less is left of",
        ),
        (
            (1.0, 1.0),
            (np.pi / 2, 0.0),
            "with positions of joint 1 -90 deg away less is left of x.csv: are zeros and signs",
        ),
    ],
)
def test_a_joint_that_is_read_wrong_is_told(
    way: tuple[float, float], away: tuple[float, float], hint: str | None, tmp_path: Path
) -> None:
    """A zero of the last joint is none of the model's."""
    regressors = two_links(tmp_path)
    t, motion = fourier(regressors.model.robot, 10.0, 250.0, 1)
    tau = regressors.torques(LINKS, motion) + 0.05 * np.random.default_rng(3).normal(size=motion.q.shape)
    turn, zero = np.array(way)[:, None], np.array(away)[:, None]
    path = as_recorded(regressors, t, turn * motion.q + zero, turn * tau).save(tmp_path / "x.csv")
    run = prepared(load(str(path), regressors.model.robot, resting=True), Recipe(), regressors)
    notes = misread(run.sampled, regressors)
    assert [note[: len(hint)] for note in notes] == [hint] if hint else notes == []


@pytest.mark.parametrize(("turned", "held"), [(True, False), (False, False), (False, True)])
def test_one_joint_is_of_the_other_sign_where_its_friction_and_inertia_say_so(
    turned: bool, held: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An arm that something unknown ``held`` up has torques that are the other way, too, and is none of that.

    The columns of the runs are made once.
    """
    made: list[Bank] = []

    def counted(runs: Sequence[Prepared], scenes: Sequence[Scene]) -> Bank:
        made.append(Bank(runs, scenes))
        return made[-1]

    monkeypatch.setattr(plausibility, "Bank", counted)
    links = two_links(tmp_path)
    t, motion = fourier(links.model.robot, 20.0, 200.0, 1)
    tau = links.torques(LINKS, motion)
    if held:
        tau[1] -= 2 * links.torques(dict.fromkeys(links.names, 0.0) | {"MX2": LINKS["MX2"]}, motion)[1]
    if turned:
        tau = tau * [[1.0], [-1.0]]
    tau = tau + 0.01 * tau.std(axis=1, keepdims=True) * np.random.default_rng(4).normal(size=tau.shape)
    source = as_recorded(links, t, motion.q, tau).save(tmp_path / "a.csv")
    runs = [prepared(load(str(source), links.model.robot, {}), Recipe(), links)]
    mean = np.array([LINKS[name] for name in links.names])
    prior = Prior(mean, np.diag(1 / (0.05 * mean) ** 2))
    alone = r"a.csv:1:1: all friction and inertia that the torques of joint 2 show alone"
    with pytest.raises(InputError, match=alone) if turned else nullcontext():
        of_one_sign(runs, links, prior)
    assert len(made) == 1
