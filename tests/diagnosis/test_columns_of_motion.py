"""Columns of the motion alone, which are made once: other values of the model and what was found change nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from generator.effects.library import library
from identification.diagnosis.candidates import library as candidates
from identification.diagnosis.columns.bank import Bank, Lasting
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.scene import Scene
from identification.recipes import Recipe
from tests.diagnosis.diagnosed import CLEAN, Found, Known, known
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier

WAY = fourier(1, period=5.0, periods=1, before=1.0)


@pytest.fixture(scope="module", params=["small_wrist", "scara_like"])
def robot(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(ROBOTS[request.param], tmp_path_factory.mktemp("robot"))


def offered(scene: Scene) -> list[Hypothesis]:
    return [one for one in candidates.hypotheses([scene]) if one.of_motion]


def test_they_are_the_same_for_other_values(robot: Known) -> None:
    scene = robot.scene(make_run(robot.robot, WAY, [Effect("offset", 1)], sensors=CLEAN))
    run = prepared(scene.sampled.run, Recipe(), robot.regressors)
    scene = replace(scene, sampled=run.sampled)
    changed = replace(scene, values={name: 1.5 * x for name, x in scene.values.items()}, beside=Found({"Off1": 3.0}))
    lasting = Lasting()
    first, again, afresh = (
        Bank([run], [one], two) for one, two in ((scene, lasting), (changed, lasting), (changed, None))
    )
    assert {one.effect for one in offered(scene)} > {"stribeck_friction", "dahl_friction", "position_friction"}
    for one in offered(scene):
        for shape in one.variants:
            first.add(one, shape)
    made = dict(lasting)
    kept = 0
    for one in offered(changed):
        for shape in one.variants:
            pair = [bank.add(one, shape) for bank in (again, afresh)]
            assert (pair[0] is None) == (pair[1] is None)
            if pair[0] is not None and pair[1] is not None:
                assert pair[0].coordinates == pair[1].coordinates
                kept += 1
                for j in pair[0].coordinates:
                    rows = [bank.columns(0, j, two.columns) for bank, two in zip((again, afresh), pair, strict=True)]
                    np.testing.assert_array_equal(*rows)
    assert kept > 50
    # The orders of ripples are those of what the model leaves.
    assert {key[0] for key in lasting.keys() - made.keys()} <= {
        name for name, one in library().items() if any(shape.several for shape in one.shapes)
    }


def test_friction_under_load_is_not_among_them(robot: Known) -> None:
    scene = robot.scene(make_run(robot.robot, WAY, [Effect("offset", 1)], sensors=CLEAN))
    every = candidates.hypotheses([scene])
    assert {one.effect for one in every if not one.of_motion} == {
        one.id for one in library().values() if "load" in one.needs
    } & {one.effect for one in every}
