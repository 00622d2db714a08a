"""The command line: its commands, its exit statuses, its one-line errors, what it leaves on disk."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from generator.cli import main as cli
from generator.discovery import modules
from generator.resources import robots
from generator.version import VERSION
from tests.commands import PENDULUM, ROOT, Done, command, process, tree


@pytest.fixture
def pendulum(tmp_path: Path) -> Path:
    path = tmp_path / "my robots" / "pendulum.yaml"
    path.parent.mkdir()
    path.write_text(PENDULUM)
    return path


def refused(done: Done) -> str:
    """The message of a command that refused its input in the agreed way."""
    assert done.status == 2, done
    assert done.out == ""
    (line,) = (line for line in done.err.splitlines() if line.startswith("error: "))
    assert done.err.endswith(line + "\n")
    assert "Traceback" not in done.err
    return line


# -- finding commands ---------------------------------------------------------------------------------------------


def test_every_command_module_is_an_entry_point() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    registered = project["entry-points"][cli.GROUP]
    own = {
        module.__name__.rpartition(".")[2]: module.__name__
        for module in modules(importlib.import_module("generator.cli"))
        if hasattr(module, "run")
    }
    assert {name: place for name, place in registered.items() if place.startswith("generator.")} == own
    assert project["scripts"]["counterpoise"] == "generator.cli.main:main"


def test_commands_are_found_without_an_installation(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("generator.cli.main.metadata.entry_points", lambda group: [])
    assert list(cli.commands()) == [
        "check",
        "compare",
        "diagnose",
        "evaluate",
        "excite",
        "gains",
        "generate",
        "identify",
        "list",
        "output-error",
        "review",
        "simulate",
        "stiffness",
    ]


def test_help_names_every_command_and_what_it_does(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        cli.main(["--help"])
    text = " ".join(capsys.readouterr().out.split())
    for name, module in cli.commands().items():
        assert f"{name} {' '.join((module.__doc__ or '').partition(chr(10))[0].split())}" in text


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        cli.main(["--version"])
    assert capsys.readouterr().out == f"counterpoise {VERSION}\n"


def test_asking_for_help_imports_no_algebra() -> None:
    script = (
        "import sys\nfrom generator.cli.main import main\n"
        "try: main(['--help'])\nexcept SystemExit: pass\n"
        "print(sorted({'sympy', 'casadi', 'numpy', 'rich', 'jinja2'} & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stderr == "[]\n"


# -- exit statuses ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "error: counterpoise:1:1: the following arguments are required: COMMAND, expected what"),
        (["derive"], "error: counterpoise:1:1: argument COMMAND: invalid choice: 'derive'"),
        (["check"], "error: counterpoise check:1:1: the following arguments are required: ROBOT, expected what"),
        (["check", "kr501"], "error: kr501:1:1: there is no robot 'kr501', expected perhaps kr500"),
        (["check", "no/such.yaml"], "error: no/such.yaml:1:1: there is no such file, expected the path of a"),
        (
            ["generate", "kr500", "--uot", "x"],
            "error: counterpoise generate:1:1: unrecognized arguments: --uot x, expected",
        ),
        (
            ["generate", "kr501", "--out", "a", "--out=b"],
            "error: counterpoise generate --out:1:1: the option is given twice, expected it once",
        ),
        (
            ["identify", "kr500", "--data", "a.csv", "--data", "b.csv"],
            "error: counterpoise identify --data:1:1: the option is given twice, expected it once",
        ),
    ],
)
def test_mistakes_on_the_command_line(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert refused(command(*arguments, capsys=capsys)).startswith(message)


def test_a_defect_shows_its_traceback_and_exits_with_1() -> None:
    script = (
        "from generator.cli import list, main\n"
        "def run(arguments): raise RuntimeError('a defect')\n"
        "list.run = run\nraise SystemExit(main.main(['list']))"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "Traceback" in done.stderr
    assert done.stderr.endswith("RuntimeError: a defect\n")


def test_a_reader_that_stops_early_is_no_error() -> None:
    line = f'"{sys.executable}" -m generator review kr500 | head -n 1; exit ${{PIPESTATUS[0]}}'
    done = subprocess.run(["bash", "-c", line], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "# Groupings of kr500\n")
    assert "Error" not in done.stderr


@pytest.mark.parametrize("words", ["list", "check tilted_two_link"])
def test_output_that_cannot_be_written_is_one_line(words: str) -> None:
    """Of many bytes some are written at once, of few all at the end."""
    line = f'"{sys.executable}" -m generator {words}'
    full, closed = (
        subprocess.run(["bash", "-c", f"{line} {to}"], cwd=ROOT, capture_output=True, text=True, check=False)
        for to in ("> /dev/full", ">&-")
    )
    assert full.returncode == 2
    expected = "error: standard output:1:1: No space left on device, expected a place for what is printed"
    assert full.stderr.splitlines()[-1] == expected
    assert (closed.returncode, "Error" in closed.stderr) == (0, False)


def test_letters_that_the_terminal_lacks_are_told_by_number(pendulum: Path) -> None:
    pendulum.write_text(PENDULUM.replace("one link", "ein B\u00fcgel"), encoding="utf-8")
    done = process("generate", pendulum, "--out", pendulum.parent / "out", PYTHONIOENCODING="ascii")
    assert (done.status, "ein B\\xfcgel" in done.out) == (0, True), done.err


# -- list, check, review --------------------------------------------------------------------------------------------


def test_list_shows_every_robot_with_its_sets(capsys: pytest.CaptureFixture[str]) -> None:
    head, *lines = command("list", capsys=capsys).out.splitlines()
    assert head.split() == ["robot", "joints", "parameter", "sets", "description"]
    assert [line.split()[0] for line in lines] == [path.stem for path in robots()]
    (kr500,) = (line for line in lines if line.split()[0] == "kr500")
    assert kr500.split()[1] == "6"
    assert "report_table_11, report_table_13" in kr500
    assert kr500.endswith("KUKA KR500-2MT, six axes, gas balancer on axis 2")


def test_check_says_that_a_file_is_good(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = command("check", pendulum, capsys=capsys)
    assert done.out == f"{pendulum}: pendulum is good: 1 moving joint, 5 base parameters, 1 parameter set\n"
    assert done.status == 0


def test_check_tells_values_that_no_robot_can_have(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pendulum.write_text(PENDULUM.replace("MX1: 3", "MX1: -3").replace("Fv1: 0.25", "Fv1: -0.25") + "      M1: -5 kg\n")
    _, *notes = command("check", pendulum, capsys=capsys).out.splitlines()
    assert notes == [
        f"note: {pendulum}:16:7: Fv1 of the set light is -0.25, which no robot can have",
        f"note: {pendulum}:18:7: M1 of the set light is -5, which no robot can have",
    ]


def test_check_refuses_a_set_with_a_parameter_the_robot_lacks(
    pendulum: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pendulum.write_text(PENDULUM.replace("ZZ1:", "ZZ2:"))
    assert refused(command("check", pendulum, capsys=capsys)) == (
        f"error: {pendulum}:13:7: the robot has no parameter 'ZZ2', expected perhaps 'ZZ1'"
    )


def test_review_prints_the_groupings_of_the_review_folder(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("generate", pendulum, "--out", tmp_path, capsys=capsys).status == 0
    text = command("review", pendulum, capsys=capsys).out
    assert text == (tmp_path / "pendulum" / "review" / "groupings.md").read_text()
    assert text.startswith("# Groupings of pendulum\n")


# -- generate -------------------------------------------------------------------------------------------------------


def test_generate_tests_the_code_and_sums_up(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("generate", pendulum, "--out", tmp_path / "out", "--self-test", capsys=capsys)
    assert done.status == 0
    lines = done.out.splitlines()
    assert lines[:4] == [
        "pendulum: one link on a horizontal axis",
        "base parameters  5",
        "effect           viscous friction on 1: Fv1",
        "effect           Coulomb friction on 1: Fc1",
    ]
    (gravity,) = (line.split() for line in lines if line.startswith("gravity "))
    assert gravity == ["gravity", "2", "1", "0", "2", "0"]  # g MX1 and g MY1 are prepared
    tallies = [line.split() for line in lines if line.startswith("self-test")]
    assert [(words[-1], int(words[1]) > 20) for words in tallies] == [("double", True), ("float", True)]
    folder = tmp_path / "out" / "pendulum"
    assert lines[-1].startswith(f"files            {len(tree(folder))} in {folder}/: batch (2), c (4), casadi (")
    assert lines[-1].endswith("manifest.json")


def test_generating_again_removes_what_is_stale_and_keeps_what_is_the_users(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "out" / "pendulum"
    command("generate", pendulum, "--out", folder.parent, capsys=capsys)
    first = tree(folder)
    manifest = json.loads(first["manifest.json"])
    (folder / "manifest.json").write_text(json.dumps(manifest | {"files": [*manifest["files"], "c/stale.c"]}))
    (folder / "c" / "stale.c").write_text("int stale;\n")
    (folder / "c" / "pendulum.h").write_text("edited\n")
    own = {"notes.txt": b"mine\n", "c/main.c": b"int main;\n"}
    for name, content in own.items():
        (folder / name).write_bytes(content)
    command("generate", pendulum, "--out", folder.parent, capsys=capsys)
    assert tree(folder) == first | own
    assert [path.name for path in folder.parent.iterdir()] == ["pendulum"]


@pytest.mark.parametrize(
    ("good", "bad", "message"),
    [
        ("alpha: pi/2", "alpha: pi/2 m", ":5:"),
        ("viscous_friction", "viscous_fiction", ":7:14: unknown effect 'viscous_fiction'"),
        (
            "effect: viscous_friction, joints: all}",
            "effect: coupled_rotor, joint: 1, values: {other: 2, ratio: 1}}",
            ":7:55: other of joint 1 is 2, expected a second joint",
        ),
        ("MX1: 3 kg m", "MX1: 3 kg", ":14:7: MX1 is given in kg, expected kg m"),
        ("MX1: 3 kg m", "MX3: 3 kg m", ":14:7: the robot has no parameter 'MX3', expected perhaps 'MX1'"),
        (
            "MX1: 3 kg m",
            "Fst1: 3 N m",
            ":14:7: the robot has no parameter 'Fst1', expected the effect stribeck_friction on joint 1",
        ),
        ("MX1: 3 kg m", "k1: 3 N m/rad", ":14:7: the robot has no parameter 'k1', expected joint 1 among flexible"),
        ("MX1: 3 kg m", "Fvm1: 3 N m s/rad", ":14:7: the robot has no parameter 'Fvm1', expected joint 1 among flex"),
    ],
)
def test_bad_input_leaves_nothing_behind(
    pendulum: Path, tmp_path: Path, good: str, bad: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert good in PENDULUM
    pendulum.write_text(PENDULUM.replace(good, bad))
    out = tmp_path / "out"
    assert refused(command("generate", pendulum, "--out", out, capsys=capsys)).startswith(f"error: {pendulum}{message}")
    assert not out.exists()


def test_bad_input_leaves_an_older_generation_as_it_was(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command("generate", pendulum, "--out", tmp_path / "out", capsys=capsys)
    before = tree(tmp_path / "out")
    pendulum.write_text(PENDULUM.replace("viscous_friction", "stribeck"))
    refused(command("generate", pendulum, "--out", tmp_path / "out", capsys=capsys))
    assert tree(tmp_path / "out") == before


def test_a_folder_that_cannot_be_made_is_bad_input(pendulum: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = command("generate", pendulum, "--out", pendulum, capsys=capsys)
    place = f"error: {pendulum}/pendulum:1:1"
    expected = f"a folder that can be made and written; {pendulum.name} is a file"
    assert refused(done) == f"{place}: it cannot be written (File exists), expected {expected}"
    assert "deriving" not in done.err


def test_a_missing_compiler_is_named(
    pendulum: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    done = command("generate", pendulum, "--out", tmp_path, "--self-test", capsys=capsys)
    assert refused(done) == "error: no-such-compiler:1:1: there is no such program, expected a C compiler; set CC"
    folder, open_quote = f"{tmp_path}:1:1: it cannot be run", 'CC:1:1: "gcc \'x" is no command'
    for told, problem in ((f"{tmp_path}", folder), ("gcc 'x", open_quote)):
        monkeypatch.setenv("CC", told)
        done = command("generate", pendulum, "--out", tmp_path, "--self-test", capsys=capsys)
        assert refused(done).startswith(f"error: {problem} (")
    monkeypatch.setenv("CC", "false")
    done = command("generate", pendulum, "--out", tmp_path, "--self-test", capsys=capsys)
    assert "its C cannot be compiled in double (it says nothing), expected a C99 compiler that takes" in refused(done)


def test_a_name_that_is_too_long_is_no_file(capsys: pytest.CaptureFixture[str]) -> None:
    name = f"{'a' * 300}.yaml"
    expected = f"error: {name}:1:1: there is no such file, expected the path of a robot file"
    assert refused(command("check", name, capsys=capsys)) == expected


def test_generate_works_from_any_folder_and_with_a_relative_path(pendulum: Path) -> None:
    done = process("generate", "pendulum.yaml", "--out", "here", cwd=pendulum.parent)
    assert done.status == 0
    assert (pendulum.parent / "here" / "pendulum" / "manifest.json").is_file()


@pytest.mark.parametrize(("given", "used"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_commands_use_one_thread_unless_told_otherwise(given: dict[str, str], used: str) -> None:
    """It must be said before NumPy is imported, and NumPy is when the commands are found."""
    program = (
        "import os, sys; from generator.cli.main import main; early = 'numpy' in sys.modules; main(['list']);"
        "print(early, os.environ['OPENBLAS_NUM_THREADS'])"
    )
    clean = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    done = subprocess.run(
        [sys.executable, "-c", program], env={**clean, "PYTHONPATH": str(ROOT), **given}, capture_output=True, text=True
    )
    assert done.stdout.split()[-2:] == ["False", used]
