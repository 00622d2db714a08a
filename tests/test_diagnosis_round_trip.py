"""Diagnose, robot file, code, diagnose again on fresh runs: a slide, and an arm of seven axes."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.robot.readers import read
from identification import recipe as recipes
from identification.dataset import load
from identification.diagnosis.command import Request, diagnosed
from identification.diagnosis.diagnosis import NAMED, NOTHING, diagnose
from identification.diagnosis.prepared import prepared
from identification.diagnosis.roles import roles
from identification.observation import Regressors
from tests.plant.effect import Effect
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier


@pytest.mark.parametrize(
    ("name", "law", "joint", "named"),
    [("scara_like", "stribeck", 3, "stribeck_friction"), ("seven_axis", "position_friction", 4, "position_friction")],
)
def test_what_was_found_and_added_is_not_found_again(
    name: str, law: str, joint: int, named: str, tmp_path: Path
) -> None:
    arm = ROBOTS[name]
    hidden = Effect(law, joint, 0.75 * arm.chain[joint - 1].coulomb)
    sources = [str(tmp_path / f"{seed}.csv") for seed in range(1, 6)]
    for seed, source in enumerate(sources, 1):
        write_csv(make_run(arm, fourier(seed, period=5.0, periods=3), [hidden], seed=seed), Path(source))
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(arm), encoding="utf-8")
    wanted = Request(sources[:1], sources[1:2], sources[2:3])
    found, new, _ = diagnosed(path, read(path), wanted, tmp_path / "out", lambda *about: {})
    assert found.verdict == NAMED
    assert [(one.hypothesis.effect, one.joints) for one in found.findings] == [(named, (joint,))]
    assert new is not None
    assert (tmp_path / "out" / new.generated / "c" / f"{name}.c").is_file()

    robot = read(tmp_path / "out" / f"{name}.yaml")
    regressors, recipe = Regressors(robot), recipes.recipe_of(name)
    fresh = [load(source, robot, recipe.columns) for source in sources[3:]]
    again = diagnose(
        regressors, [prepared(one, recipe, regressors) for one in fresh], roles(fresh[:1], fresh[1:], [], tested=False)
    )
    assert (again.verdict, again.findings) == (NOTHING, ())
