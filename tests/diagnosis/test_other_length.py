"""Lengths that the robot's file states wrongly: the right ones are found, and the repaired file has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved_sets
from identification import recipes
from identification.dataset import load
from identification.diagnosis.columns.hypothesis import LENGTH
from identification.diagnosis.columns.lengths import hypotheses
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis, diagnose
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.roles import roles
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion, Regressors
from identification.residuals import rms
from tests.diagnosis.diagnosed_arm import answered, ready
from tests.plant.effect import Effect
from tests.plant.machine import Machine
from tests.plant.robot import Robot
from tests.plant.robot_file import PRIOR, robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier
from tests.recorded import TRUTH, TWO_LINKS, Array, parameters_text

#: Where d and r stand in the plant's joints.
FIELDS = {"d": 1, "r": 3}


def longer(robot: Robot, joint: int, field: str, by: float) -> Robot:
    """The robot with another length of a joint (from 1)."""
    dh = list(robot.chain[joint - 1].dh)
    dh[FIELDS[field]] += by
    chain = [*robot.chain]
    chain[joint - 1] = replace(chain[joint - 1], dh=tuple(dh))  # type: ignore[arg-type]
    return replace(robot, chain=tuple(chain))


def logs(robot: Robot, hidden: Sequence[Effect], folder: Path) -> list[str]:
    """Files of five runs."""
    sources = [str(folder / f"{seed}.csv") for seed in range(1, 6)]
    for seed, source in enumerate(sources, 1):
        write_csv(make_run(robot, fourier(seed, period=5.0, periods=3), hidden, seed=seed), Path(source))
    return sources


def torques(robot: Robot, motion: Motion) -> Array:
    """Of the plant's rigid bodies and rotors (n x N)."""
    return Machine(robot, ()).rigid_torques(*(x.T for x in motion.signals)).T


def columns_of(regressors: Regressors, motion: Motion) -> Array:
    """Torques (p x n x N) per unit of each base parameter."""
    result = np.zeros((len(regressors.names), *motion.q.shape))
    for k, (names, rows) in enumerate(zip(regressors.structure, regressors.base(motion), strict=True)):
        result[[regressors.names.index(name) for name in names], k] = rows
    return result


def told(
    name: str, joint: int, field: str, by: float, prior: str | None, folder: Path
) -> tuple[Diagnosis, Sequence[str]]:
    """What is told of the plant ``name`` by a file in which a length of a joint is another; a new file is in ``out``.
    The last two of the runs it has not seen.
    """
    sources = logs(ROBOTS[name], [], folder)
    path = folder / "arm.yaml"
    path.write_text(robot_file(longer(ROBOTS[name], joint, field, by)), encoding="utf-8")
    found, new = answered(path, Request(sources[:2], [], sources[2:3], prior), folder / "out")
    assert new is not None
    assert found.verdict == NAMED
    return found, sources


@pytest.mark.parametrize(
    ("name", "joint", "field", "by", "prior"),
    [
        ("three_axis", 2, "d", 0.1, PRIOR),
        pytest.param("small_wrist", 3, "d", 0.04, None, marks=pytest.mark.long),
        pytest.param("three_axis", 3, "d", -0.15, PRIOR, marks=pytest.mark.long),
    ],
)
def test_another_length_is_found_and_written(
    name: str, joint: int, field: str, by: float, prior: str | None, tmp_path: Path
) -> None:
    found, _ = told(name, joint, field, by, prior, tmp_path)
    assert [(one.hypothesis.kind, one.hypothesis.key) for one in found.findings] == [
        (LENGTH, (f"length_{field}", joint))
    ]
    value = found.findings[0].parameters[f"{field}{joint}_longer"]
    assert value.value == pytest.approx(-by, abs=2.5 * value.std)
    assert value.std < 0.2 * abs(by)
    robot = read(tmp_path / "out" / f"{name}.yaml")
    written = float(getattr(robot.joints[joint - 1], field))
    assert written == pytest.approx(ROBOTS[name].chain[joint - 1].dh[FIELDS[field]] + by + value.value, abs=1e-6)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "joint", "field", "by"), [("three_axis", 2, "d", 0.1), ("small_wrist", 4, "r", -0.04)]
)
def test_with_the_length_found_fresh_runs_show_nothing_more(
    name: str, joint: int, field: str, by: float, tmp_path: Path
) -> None:
    _, sources = told(name, joint, field, by, PRIOR, tmp_path)
    robot = read(tmp_path / "out" / f"{name}.yaml")
    regressors, recipe = Regressors(robot), recipes.recipe_of(name)
    fresh = [load(source, robot, recipe.columns) for source in sources[3:]]
    again = diagnose(
        regressors,
        [prepared(one, recipe, regressors) for one in fresh],
        roles(fresh[:1], fresh[1:], [], tested=False),
    )
    assert (again.verdict, again.findings) == (NOTHING, ())


@pytest.mark.parametrize("told", [True, False])
def test_a_column_is_what_another_length_makes_that_base_parameters_do_not(told: bool, tmp_path: Path) -> None:
    """Of the plant's own rigid bodies, whatever standard parameters make the base parameters; of lengths that are zero
    where these are known.
    """
    true, step = ROBOTS["three_axis"], 1e-4
    (source, *_) = logs(true, [], tmp_path)
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(true), encoding="utf-8")
    robot = read(path)
    values = resolved_sets(Regressors(robot).model)[PRIOR]
    regressors = Regressors(robot if told else replace(robot, parameter_sets={}))
    sampled = ready(source, regressors).sampled
    motion = sampled.motion.at(np.arange(0, sampled.motion.samples, 50))
    scene = Scene(replace(sampled, motion=motion), regressors, values)
    rows = np.stack([column.reshape(-1) for column in columns_of(regressors, motion)], axis=1)
    lengths = hypotheses(regressors.model)
    keys = [("length_d", 2), ("length_r", 2), ("length_d", 3)]
    assert [one.key for one in lengths] == [key for key in keys if told or key != ("length_r", 2)]
    for one in lengths:
        field, joint = one.effect.removeprefix("length_"), one.joint
        both = [torques(longer(true, joint, field, by), motion) for by in (step, -step)]
        wanted = (both[0] - both[1]).reshape(-1) / (2 * step)
        found = one.columns(scene, {})[0].reshape(-1)
        for column in (wanted, found):
            column -= rows @ np.linalg.lstsq(rows, column, rcond=1e-9)[0]
        assert rms(found - wanted) < 2e-3 * max(rms(wanted), 1.0), one.key


DIRECT = TWO_LINKS.replace("d: d2,", "d: 0.5 m,")
TURNED = TWO_LINKS.replace("d: d2,", "d: -d2,").replace("d2: 0.5 m", "d2: -0.5 m")
HALVED = TWO_LINKS.replace("d: d2,", "d: d2/2,").replace("d2: 0.5 m", "d2: {nominal: 1 m, symbolic: true}")
TWICE = TWO_LINKS.replace("d: 0.4 m", "d: d2")
SYMBOLIC = TWO_LINKS.replace("d2: 0.5 m", "d2: {nominal: 0.5 m, symbolic: true}")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (TWO_LINKS, "  d2: 0.47 m\n"),
        (SYMBOLIC, "  d2: {nominal: 0.47 m, symbolic: true}\n"),
        (TURNED, "  d2: -0.47 m\n"),
        (HALVED, "  d2: {nominal: 0.94 m, symbolic: true}\n"),
        (DIRECT, "d: 0.47 m, theta: q2"),
        (TWICE, "d: 0.47 m, theta: q2"),
    ],
)
def test_a_length_is_written_where_it_stands_and_no_other_changes(text: str, line: str) -> None:
    new = repaired(text + parameters_text({"known": TRUTH}), "x", [Addition(LENGTH, "length_d", (2,), {"d": -0.03})])
    assert line in new.text
    assert new.text.count("0.5 m") == (1 if text in (TWICE, DIRECT) else 0)
    assert new.notes == ("the length d of joint 2 is 0.47 m in the robot file, not 0.5 m",)
