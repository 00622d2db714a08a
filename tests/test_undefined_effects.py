"""Effects of the robot's file that have no real value somewhere along a run: one line says which, and when."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import command
from tests.diagnosis.diagnosed_arm import ARM, recorded, torque
from tests.recorded import Recorded

#: A gas balancer whose chamber ends where the arm still moves.
SHORT = "  - {effect: gas_balancer, joint: 1, values: {d21: 1 m, d22: 0.4 m, phi: 90 deg, l0: 0.1 m, exponent: 1.3}}\n"
#: What follows the load has no value either, but that is not its own.
FOLLOWS = "  - {effect: load_friction, joint: 1, values: {rotor: 1 kg m2}}\n"


COMMANDS = {
    "identify": ["--data", "1.csv"],
    "diagnose": ["1.csv"],
    "diagnose, a run that tests": ["near.csv", "--test", "1.csv"],
}


@pytest.mark.parametrize("effects", [SHORT, FOLLOWS + SHORT], ids=["alone", "under a load"])
@pytest.mark.parametrize("words", COMMANDS)
def test_an_effect_without_a_real_value_is_named(
    words: str, effects: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, (source,) = recorded(tmp_path, [torque("")])
    run = Recorded.read(source)
    run.with_columns(q1=0.1 * run.columns["q1"]).save(tmp_path / "near.csv")
    unlimited = ARM.replace(", limits: [-160 deg, 160 deg]", "")
    (tmp_path / "arm.yaml").write_text(unlimited + effects)
    monkeypatch.chdir(tmp_path)
    done = command(words.split(",")[0], "arm.yaml", *COMMANDS[words], capsys=capsys)
    assert done.status == 2
    line = done.err.splitlines()[-1]
    assert "1.csv:1:1: gas balancer on joint 1 has no real value at " in line
    assert line.endswith(" s, expected a model that is defined along the run's motion")
