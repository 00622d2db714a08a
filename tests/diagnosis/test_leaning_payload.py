"""A base that leans while the tool carries what no file tells of: the tilt is that of all that weighs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.plant.effect import Effect
from tests.plant.robot_file import PRIOR, robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier

#: Angle of the base [rad] about the horizontal line at another angle [rad], and mass of the payload [kg].
TILT, TOWARDS, MASS = 0.05, 0.6, 30.0


@pytest.mark.long
def test_the_weight_of_a_payload_that_was_found_tilts_as_well(tmp_path: Path) -> None:
    hidden = [Effect("base_tilt", 1, TILT, {"towards": TOWARDS}), Effect("payload", 1, MASS)]
    sources = [str(tmp_path / f"{seed}.csv") for seed in range(1, 4)]
    for seed, source in enumerate(sources, 1):
        write_csv(make_run(ROBOTS["three_axis"], fourier(seed, period=5.0, periods=3), hidden, seed=seed), Path(source))
    path = tmp_path / "arm.yaml"
    path.write_text(robot_file(ROBOTS["three_axis"]), encoding="utf-8")
    found = diagnosis_of(sources, Regressors(read(path)), PRIOR)
    assert {one.hypothesis.effect for one in found.findings} == {"base_tilt", "payload"}
    values = {name: value for one in found.findings for name, value in one.parameters.items()}
    for name, true in {"M": MASS, "tilt_x": TILT * np.cos(TOWARDS), "tilt_y": TILT * np.sin(TOWARDS)}.items():
        assert values[name].value == pytest.approx(true, abs=3 * values[name].std)
        assert values[name].std < 0.07 * true
