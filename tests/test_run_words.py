"""Runs with columns of words, and paths that name no run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from identification.dataset import load, sidecar_of
from tests.recorded import TRUTH, recorded, stacked, two_links


def test_a_column_without_a_number_is_left_out_and_told(tmp_path: Path) -> None:
    regressors = two_links(tmp_path)
    good = recorded(regressors, TRUTH, duration=8.0)
    header, *rows = good.save(tmp_path / "a.csv").read_text().splitlines()
    words = [f"{header},mode", f"{rows[0]},", *(f"{row},AUT" for row in rows[1:])]
    (tmp_path / "b.csv").write_text("\n".join(words) + "\n")
    run = load(str(tmp_path / "b.csv"), regressors.model.robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    (note,) = run.notes
    assert note.endswith("b.csv: mode held no number and is left out")


@pytest.mark.parametrize("source", ["", ".", "/"])
def test_a_path_without_a_name_is_refused(source: str, tmp_path: Path) -> None:
    sidecar_of(source)
    with pytest.raises(InputError, match="a run file ending in ''"):
        load(source, two_links(tmp_path).model.robot)
