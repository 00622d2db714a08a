"""Where files go, names too long, and what an interruption does, the same for every command."""

from __future__ import annotations

import subprocess
import sys
from argparse import ArgumentParser
from pathlib import Path

import pytest

from generator.cli.main import Command, commands, main
from tests import lifter, stiff_arm
from tests.commands import PENDULUM, ROOT, command

#: Words beside ``--out`` with which a command comes as far as writing, in the folder that ``at_hand`` makes.
WRITING = {
    "compare": "pendulum.yaml:light pendulum.yaml:light",
    "diagnose": "pendulum.yaml a.csv b.csv",
    "excite": "pendulum.yaml --parameters light --evaluations 256",
    "gains": "lifter.yaml --empty lifted/a.csv --loaded lifted/b.csv --payload M=20",
    "generate": "pendulum.yaml",
    "identify": "pendulum.yaml --data a.csv",
    "output-error": "pendulum.yaml --data a.csv",
    "simulate": "pendulum.yaml --parameters light --duration 0.1",
    "stiffness": "kr500 --locked 2 --data blocked.csv",
}
#: Words with a name of a file, a robot, a set or a quantity that is too long.
NAMING = [
    "check {long}",
    "check {long}.yaml",
    "compare {long} pendulum.yaml:light",
    "compare {long}.json pendulum.yaml:light",
    "compare pendulum.yaml:light pendulum.yaml:{long}",
    "diagnose pendulum.yaml {long}.csv",
    "evaluate {long}.yaml inverse_dynamics",
    "evaluate pendulum.yaml {long}",
    "excite pendulum.yaml --recipe {long}.yaml",
    "gains lifter.yaml --empty {long}.csv --loaded lifted/b.csv --payload M=20",
    "generate {long}.yaml",
    "generate pendulum.yaml --build-in {long}",
    "identify pendulum.yaml --data {long}.csv",
    "identify pendulum.yaml --data a.csv --recipe {long}.yaml",
    "output-error pendulum.yaml --data {long}.csv",
    "review {long}",
    "review {long}.yaml",
    "simulate pendulum.yaml --parameters light --trajectory played --set file={long}.csv",
    "stiffness pendulum.yaml --locked 1 --data {long}.csv --prior light",
]
LONG = "a" * 300


@pytest.fixture(scope="module")
def at_hand(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Robots and runs of theirs."""
    folder = tmp_path_factory.mktemp("at_hand")
    (folder / "pendulum.yaml").write_text(PENDULUM)
    for seed, run in enumerate(("a.csv", "b.csv")):
        words = f"--parameters light --duration 6 --noise 0.01 --log-rate 200 --seed {seed}".split()
        assert main(["simulate", str(folder / "pendulum.yaml"), *words, "--out", str(folder / run)]) == 0
    (folder / "lifted").mkdir()
    lifter.found(lifter.lifter(folder), folder / "lifted")
    stiff_arm.blocked(folder / "blocked.csv")
    return folder


def usage(one: Command) -> str:
    parser = ArgumentParser()
    one.configure(parser)
    return parser.format_usage()


def test_every_command_is_tried() -> None:
    assert set(WRITING) == {name for name, one in commands().items() if "--out " in usage(one)}
    assert {words.split()[0] for words in NAMING} == commands().keys() - {"list"}


@pytest.mark.parametrize("name", WRITING)
@pytest.mark.parametrize(
    ("out", "told"),
    [("", "argument --out: it is empty; . is the folder at hand"), (LONG, "it cannot be written (File name too long)")],
    ids=["empty", "long"],
)
def test_an_out_that_can_be_none_is_bad_input(
    name: str, out: str, told: str, at_hand: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The empty one would be the folder at hand."""
    monkeypatch.chdir(at_hand)
    before = sorted(at_hand.rglob("*"))
    ending = ".csv" if out and name == "simulate" else ""
    done = command(name, *WRITING[name].split(), "--out", out + ending, capsys=capsys)
    assert done.status == 2
    assert done.err.splitlines()[-1].startswith("error: ")
    assert told in done.err.splitlines()[-1]
    assert sorted(at_hand.rglob("*")) == before


@pytest.mark.parametrize("words", NAMING)
def test_a_name_that_is_too_long_is_one_line(
    words: str, at_hand: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(at_hand)
    done = command(*(word.format(long=LONG) for word in words.split()), capsys=capsys)
    assert done.status == 2
    assert done.err.splitlines()[-1].startswith("error: ")
    assert LONG in done.err.splitlines()[-1]


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
