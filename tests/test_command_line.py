"""Where files go and what an interruption does, the same for every command."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import ROOT, command


@pytest.mark.parametrize("name", ["generate", "identify", "excite", "simulate", "gains"])
def test_an_empty_out_is_bad_input(name: str, pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It would be the folder at hand."""
    data = ("--data", "a.csv") if name in ("identify", "gains") else ()
    done = command(name, pendulum, *data, "--out", "", capsys=capsys)
    assert "argument --out: it is empty; . is the folder at hand" in done.err
    assert done.status == 2


def test_an_interruption_while_python_reads_the_program_is_no_defect() -> None:
    code = (
        "import runpy, sys\n"
        "class Interrupted:\n"
        "    def find_spec(self, name, *more):\n"
        "        if name == 'argparse': raise KeyboardInterrupt\n"
        "sys.modules.pop('argparse', None)\n"
        "sys.meta_path.insert(0, Interrupted())\n"
        "runpy.run_module('generator', run_name='__main__')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (130, "")
