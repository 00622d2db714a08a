"""The passages of Python in the documents, with a small robot: they run as printed."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator import resources
from identification.simulation.machine import Machine
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import simulate
from tests.documents import blocks
from tests.test_docs import DOCUMENTS, text

#: Documents whose passage is run by test_excite.py, or shows a function without what it imports.
ELSEWHERE = {"docs/excite.md", "docs/extending.md"}
PASSAGES = {
    name: [one.text for one in blocks(text(name)) if one.language == "python" and not one.name] for name in DOCUMENTS
}


@pytest.mark.parametrize("name", [name for name in PASSAGES if PASSAGES[name] and name not in ELSEWHERE])
def test_passages_run_one_after_the_other(
    name: str,
    machine: Machine,
    file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Whatever robot they name is that of two links; what they print are numbers."""
    monkeypatch.setattr(resources, "find_robot", lambda name: file)
    monkeypatch.chdir(tmp_path)
    for seed, run in enumerate("ABC"):
        made = simulate(machine, Settings(duration=4.0, noise=(0.05,), seed=seed))
        save(made, machine.robot.name, machine.robot.digest, Path(f"{run}.csv"))
    names: dict[str, object] = {}
    for passage in PASSAGES[name]:
        exec(compile(passage, name, "exec"), names)
    printed = [float(word) for word in capsys.readouterr().out.split()]
    assert len(printed) > 1
    assert all(0 < abs(number) < 1e3 for number in printed)


def test_documents_left_out_have_passages() -> None:
    assert all(PASSAGES[name] for name in ELSEWHERE)
