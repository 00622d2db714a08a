"""The built wheel, installed with its locked dependencies in an empty environment and used from another folder."""

from __future__ import annotations

import os
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

from generator.resources import robots
from tests.commands import ROOT, process, tree

#: Where ``make test`` keeps the locked wheels, so that this test needs no network.
WHEELS = Path(sys.prefix, "wheels")


def run(*command: str | Path, cwd: Path) -> str:
    """The output of a command that sees nothing of this checkout."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COUNTERPOISE"))}
    done = subprocess.run(
        list(map(str, command)), cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def pip_of(installed: Path) -> tuple[str | Path, ...]:
    """The tests' own pip for an environment without one."""
    return (sys.executable, "-m", "pip", "--python", installed / "python")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", out, ROOT, cwd=out)
    (built,) = out.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path) -> Path:
    """The folder with the programs of an environment that holds the wheel and requirements.lock, nothing else."""
    folder = wheel.parent / "environment"
    venv.create(folder)
    pip = (*pip_of(folder / "bin"), "install", "--quiet", "--no-compile", "--disable-pip-version-check")
    source = ("--no-index", "--find-links", WHEELS) if WHEELS.is_dir() else ()
    run(*pip, *source, "--require-hashes", "-r", ROOT / "requirements.lock", cwd=folder)
    run(*pip, "--no-deps", "--no-index", wheel, cwd=folder)
    return folder / "bin"


def test_the_wheel_holds_the_packages_and_their_data_alone(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0] for name in names if ".dist-info/" not in name} == {"generator", "identification"}
    shipped = {name.rpartition("/")[2] for name in names if name.startswith("generator/_data/robots/")}
    assert shipped >= {path.name for path in robots()}
    templates = {name.removeprefix("generator/_data/templates/") for name in names if "/_data/templates/" in name}
    assert templates == set(tree(ROOT / "templates"))
    assert "generator/py.typed" in names
    assert not [name for name in names if name.endswith((".pyc", ".so"))]


def test_an_empty_environment_generates_what_the_checkout_generates(installed: Path, tmp_path: Path) -> None:
    assert run(*pip_of(installed), "check", cwd=tmp_path) == "No broken requirements found.\n"
    assert "kr270" in run(installed / "counterpoise", "list", cwd=tmp_path)
    run(installed / "counterpoise", "generate", "tilted_two_link", "--out", "by wheel", "--self-test", cwd=tmp_path)
    assert process("generate", "tilted_two_link", "--out", tmp_path / "by checkout").status == 0
    assert tree(tmp_path / "by wheel") == tree(tmp_path / "by checkout")
