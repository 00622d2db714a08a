"""What was found and a robot file cannot hold is told; nothing that was found ends in an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import DRIVE, EFFECT, SIGNAL
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.mending.writable import loaded, writable
from identification.diagnosis.runs.roles import Roles
from identification.diagnosis.runs.scene import Scene
from identification.observation import Regressors
from identification.robot_text import robot_of
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, ready
from tests.recorded import TWO_LINKS, Recorded, fourier

NO_RUNS = Roles((), (), (), ())


@pytest.mark.parametrize(
    ("text", "addition", "said"),
    [
        (
            f"{TWO_LINKS}signals: {{torque_gain: 0.45}}\n",
            Addition(SIGNAL, "torque_gain", (2,), {"torque_gain": 0.5}),
            "torque_gain on joint 2 is not written: torque_gain of joint 2 is 0.225, expected a factor from 0.3 to 3",
        ),
        (
            f"{TWO_LINKS}signals: {{torque_delay: 60 ms}}\n",
            Addition(SIGNAL, "torque_delay", (1,), {"torque_delay": 0.05}),
            "torque_delay on joint 1 is not written: torque_delay of joint 1 is 0.11 s, expected",
        ),
        (
            ARM,
            Addition(DRIVE, "torque_drift", (1,), {"torque_drift": -0.1, "torque_gain": 1.0, "warm_up_time": 60.0}),
            "torque_drift on joint 1 is not written: arm has no drives, expected drives in the robot file",
        ),
    ],
)
def test_what_the_file_cannot_hold_is_told_and_the_rest_is_kept(text: str, addition: Addition, said: str) -> None:
    other = Addition(EFFECT, "cable_spring", (1,), {"neutral": 0.1})
    kept, notes = writable(text, "x", [addition, other], NO_RUNS, [])
    assert kept == [other]
    (note,) = notes
    assert note.startswith(said)


def test_a_run_without_the_temperature_gets_warm_after_the_time_of_the_others(tmp_path: Path) -> None:
    text = f"{ARM}signals: {{warm_rise: [30 K]}}\n"
    regressors, after = Regressors(robot_of(text, "x")), 25.0
    sources = []
    for number in (1, 2, 3):
        t, motion = fourier(regressors.model.robot, 40.0, 100.0, number)
        columns = {"t": t, "q1": motion.q[0], "tau1": regressors.torques(TRUTH, motion)[0]}
        if number < 3:
            columns["temp1"] = 20.0 + 30.0 * (1 - np.exp(-t / after))
        sources.append(str(Recorded(columns).save(tmp_path / f"{number}.csv")))
    chosen = Roles((sources[0],), (sources[1],), (sources[2],), tuple(sources[:2]))
    scenes = [Scene(ready(one, regressors).sampled, regressors, TRUTH) for one in chosen.searched]
    warm = Addition(EFFECT, "warm_friction", (1,))
    kept, (note,) = writable(text, "x", [warm], chosen, scenes)
    assert kept[0] == warm
    assert kept[1].joints == (1,)
    assert kept[1].values["warm_up_time"] == pytest.approx(after, rel=0.06)
    assert "3.csv has no temperature of joint 1" in note
    new = repaired(text, "x", kept)
    assert not any("another warmth" in one for one in new.notes)
    warmths = [run.warmth for run in loaded(sources, new.robot)]
    for one in warmths:
        assert one is not None
        assert one[0, -1] == pytest.approx(1 - np.exp(-40.0 / after), abs=0.03)
    assert writable(text, "x", [warm], Roles((), (), (), chosen.searched), scenes) == ([warm], [])
