"""Torques that stop at a limit are left out wherever runs or parts of them are read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.dataset import load
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING
from tests.diagnosis.diagnosed_arm import TRUTH, answered, recorded, rewritten, torque


@pytest.fixture(scope="module")
def clipped(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The arm's file, whose runs lack the largest torques."""
    folder = tmp_path_factory.mktemp("clipped")
    _, sources = recorded(folder, [torque("")] * 3)
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, q, np.minimum(tau, np.quantile(tau, 0.93))))
    return folder / "arm.yaml", sources


def test_a_part_of_a_run_leaves_out_what_is_cut_off(clipped: tuple[Path, list[str]]) -> None:
    path, (source, *_) = clipped
    whole, part = (load(source + part, read(path), resting=True) for part in ("", "@0:30"))
    assert whole.unusable is not None
    assert part.unusable is not None
    assert whole.unusable.sum() > 0.03 * whole.samples
    np.testing.assert_array_equal(part.unusable, whole.unusable[:, : part.samples])


@pytest.mark.parametrize("runs", [1, 3])
def test_cut_off_torques_neither_name_nor_shift_anything(
    runs: int, clipped: tuple[Path, list[str]], tmp_path: Path
) -> None:
    path, sources = clipped
    fit, validate, test = sources[:1], sources[1:runs][:1], sources[2:runs]
    found, new = answered(path, Request(fit, validate, test), tmp_path / "out")
    assert found.verdict == NOTHING
    assert sum("tau1 is cut off for" in note for note in found.notes) == runs
    assert new is not None
    assert not new.notes
    for name in ("ZZ1", "MX1", "Fv1", "Fc1"):
        assert new.fit.values[name] == pytest.approx(TRUTH[name], rel=0.02), name
