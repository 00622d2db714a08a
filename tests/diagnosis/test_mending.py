"""From runs of the simulated robot over the diagnosis to new code that explains a run that nothing has touched."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved_sets
from identification import recipes
from identification.dataset import load
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, diagnose
from identification.diagnosis.mending.mended import Mended, _gain, mended
from identification.diagnosis.runs.played import Player, play
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.roles import roles
from identification.observation import Regressors
from tests.diagnosis import diagnosed_arm
from tests.diagnosis.diagnosed_arm import answered
from tests.plant.effect import Effect
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier
from tests.recorded import TRUTH, as_recorded, parameters_text, two_links
from tests.recorded import fourier as sines

ARM = ROBOTS["three_axis"]


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Mended]:
    folder = tmp_path_factory.mktemp("mending")
    path = folder / f"{ARM.name}.yaml"
    path.write_text(f"# Kept as it is.\n{robot_file(ARM)}", encoding="utf-8")
    hidden = Effect("position_friction", 2, 1.0 * ARM.chain[1].coulomb)
    sources = []
    for seed in (1, 2, 3):
        write_csv(make_run(ARM, fourier(seed, period=5.0, periods=3), [hidden], seed=seed), folder / f"{seed}.csv")
        sources.append(str(folder / f"{seed}.csv"))
    robot = read(path)
    regressors, recipe = Regressors(robot), recipes.recipe_of(robot.name)
    first = [load(source, robot, recipe.columns) for source in sources]
    chosen = roles(first[:1], first[1:2], first[2:])
    runs = [prepared(one, recipe, regressors) for one in first[:-1]]
    found = diagnose(regressors, runs, chosen)
    assert found.verdict == NAMED
    return folder, mended(path, found, None, folder / "out")


def test_the_new_file_holds_the_effect_and_the_rest_of_the_old_one(case: tuple[Path, Mended]) -> None:
    folder, done = case
    written = folder / "out" / f"{ARM.name}.yaml"
    assert written.read_text(encoding="utf-8") == done.text
    robot = read(written)
    assert any(use.effect == "position_friction" and use.joints == (2,) for use in robot.effects)
    assert "diagnosed" in robot.parameter_sets
    assert done.text.startswith("# Kept as it is.\n")
    gone = [line for line in done.file_difference.splitlines() if line.startswith("-") and not line.startswith("---")]
    assert not gone
    assert "position_friction" in done.file_difference
    for name in ("Fqc2", "Fqs2"):
        assert name in done.groupings_difference


def test_the_code_is_generated_and_the_gap_closes_on_the_untouched_run(case: tuple[Path, Mended]) -> None:
    folder, done = case
    assert done.generated == Path("generated", ARM.name)
    made = folder / "out" / done.generated
    assert (made / "c" / f"{ARM.name}.c").is_file()
    assert (made / "python" / f"lib{ARM.name}.so").is_file()
    (before,), (after,) = done.before, done.after
    was, now = (one.residuals.per_joint[1] for one in (before, after))
    assert now.rows == was.rows
    assert now.norm < 0.6 * was.norm
    assert now.relative_to_mean < was.relative_to_mean
    assert not done.notes


@pytest.mark.parametrize(
    ("prior", "stiffness"),
    [(None, 1e6), pytest.param("a", 1e6, marks=pytest.mark.long), pytest.param("b", 3e6, marks=pytest.mark.long)],
)
def test_the_flexible_set_has_the_stiffness_of_the_prior(prior: str | None, stiffness: float, tmp_path: Path) -> None:
    """In the place of that of an earlier diagnosis."""
    told = {"a": 1e6, "b": 3e6, "diagnosed_flexible": 9e6}
    sets = {name: {**diagnosed_arm.TRUTH, "k1": k} for name, k in told.items()}
    _, (source,) = diagnosed_arm.recorded(tmp_path, [diagnosed_arm.torque("")])
    path, out = tmp_path / "arm.yaml", tmp_path / "out"
    path.write_text(f"{diagnosed_arm.ARM}flexible: [1]\n{parameters_text(sets)}")
    answered(path, Request([source], prior=prior), out)
    assert read(out / "arm.yaml").parameter_sets["diagnosed_flexible"].values["k1"].value == stiffness


@pytest.mark.long
def test_the_model_after_is_the_written_set_s_where_the_runs_hide_parameters(tmp_path: Path) -> None:
    """Runs that each hold a joint show sums of two inertias alone, which the run that tests takes apart."""
    of = two_links(tmp_path)
    sources = []
    for seed, held in enumerate(([0], [1], []), 1):
        t, way = sines(of.model.robot, 40.0, 100.0, seed)
        q, qd, qdd = way.signals
        q[held], qd[held], qdd[held] = q[held, :1], 0.0, 0.0
        tau = of.torques(TRUTH, way) + 0.6 * np.random.default_rng(seed).normal(size=q.shape)
        sources.append(str(as_recorded(of, t, q, tau).save(tmp_path / f"{seed}.csv")))
    wanted = Request(sources[:2], (), sources[2:])
    _, new = answered(tmp_path / "two_links.yaml", wanted, tmp_path / "out")
    assert new is not None
    assert any("the runs do not show ZZ1R ZZ2 Ia2" in note for note in new.notes)
    written = Regressors(read(tmp_path / "out" / "two_links.yaml"))
    one = prepared(load(sources[2], written.model.robot), recipes.recipe_of("two_links"), written)
    again = play(one, Player(written), resolved_sets(written.model)["diagnosed"]).model
    (after,) = new.after
    np.testing.assert_allclose(after.model, again, atol=1e-4 * np.abs(again).max())


def test_the_model_without_what_was_found_is_told_near_the_prior_and_free(monkeypatch: pytest.MonkeyPatch) -> None:
    def together(played: Any) -> Any:
        return SimpleNamespace(total=SimpleNamespace(rows=len(played), relative_to_mean=sum(played)))

    monkeypatch.setattr("identification.diagnosis.mending.mended.together", together)
    played: list[Any] = [[5.0], [3.01], [3.0]]
    (said,) = _gain(*played, "untouched runs")
    near, free, new = (said.index(f"{one} %") for one in (5, 3.01, 3))
    assert near < said.index("stay near the prior") < free < said.index("may move them far") < new
    assert "make up for" not in said
    (said,) = _gain([3.02], *played[1:], "untouched runs")
    assert said.endswith("parameters make up for what was found without going far from the prior")
    assert not [*_gain([], [], [], "untouched runs")]
