"""What `check` and `list` tell of robot files beside what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.resources import OVERRIDE
from generator.robot.parameters import INERTIAL
from tests.commands import PENDULUM, command

#: A bar of 3 kg along x, 1 m long, and 0.1 m thick, from its end.
BAR = {"XX": 0.015, "YY": 1.0075, "ZZ": 1.0075, "MX": 1.5, "M": 3.0}


def with_bar(folder: Path, **changed: float) -> Path:
    values = {**dict.fromkeys((stem for stem, *_ in INERTIAL), 0.0), **BAR, **changed}
    units = {stem: unit for stem, unit, _ in INERTIAL}
    lines = "".join(f"      {stem}1: {value} {units[stem]}\n" for stem, value in values.items())
    path = folder / "pendulum.yaml"
    path.write_text(f"{PENDULUM.split('parameters:')[0]}parameters:\n  bar:\n    values:\n{lines}")
    return path


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({}, False),
        ({"ZZ": 5.0}, True),
        ({"MX": 2.0}, True),
        ({"XX": 0.0, "YY": 1.0, "ZZ": 1.0}, False),
        ({"M": 0}, False),
    ],
)
def test_a_body_that_no_matter_can_be_is_told(
    changed: dict[str, float], told: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("check", with_bar(tmp_path, **changed), capsys=capsys)
    assert done.status == 0
    assert ("XX1 to M1 of the set bar are those of no body: about its centre of mass one moment" in done.out) == told
    # The textbook's triangle inequality of the principal moments about the centre of mass, which are on the axes here.
    x = {**BAR, **changed}
    if x["M"]:
        about_x, about_z = x["XX"], x["ZZ"] - x["MX"] ** 2 / x["M"]
        about_y = x["YY"] - x["MX"] ** 2 / x["M"]
        moments = np.sort([about_x, about_y, about_z])
        assert (moments[2] > moments[0] + moments[1] + 1e-9) == told


def test_one_bad_file_does_not_hide_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "robots").mkdir()
    (tmp_path / "robots" / "bad.yaml").write_text("name: [\n")
    (tmp_path / "robots" / "pendulum.yaml").write_text(PENDULUM)
    monkeypatch.setenv(OVERRIDE, str(tmp_path))
    done = command("list", capsys=capsys)
    assert done.status == 2
    assert "pendulum" in done.out
    assert done.err.startswith(f"error: {tmp_path / 'robots' / 'bad.yaml'}:")
    assert len(done.err.splitlines()) == 1
