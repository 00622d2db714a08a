"""Which changes of the code begin the study of the diagnosis anew."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.diagnosis_study.reach import reached
from benchmarks.diagnosis_study.state import MODULES, ROOT, state
from tests.diagnosis.diagnosed_arm import recorded, torque

#: A command, what it imports, and an effect that only its folder tells of.
HALF = {
    "identification/cli/diagnose.py": "def run():\n    from generator import effects, half\n",
    "generator/half.py": '"""Doc."""\n\n\ndef half(x):\n    return x / 2\n',
    "generator/effects/__init__.py": "",
    "generator/effects/spring.py": "",
}


def _written(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "same"),
    [
        ('"""Better."""\n\n\ndef half(x):\n    """Of it."""\n    return x / 2  # exactly\n', True),
        ('"""Doc."""\n\n\ndef half(x):\n    return x / 3\n', False),
        ('"""Doc."""\n\n\ndef half(x):\n    print("Doc.")\n    return x / 2\n', False),
    ],
)
def test_an_answer_depends_on_the_code_and_not_on_its_words(words: str, same: bool, tmp_path: Path) -> None:
    _written(tmp_path, HALF)
    before = state(tmp_path)
    _written(tmp_path, {"generator/half.py": words})
    assert (state(tmp_path) == before) is same


@pytest.mark.parametrize(
    ("file", "same"),
    [
        ("identification/cli/excite.py", True),
        ("generator/half.py", False),
        ("generator/effects/spring.py", False),
        ("generator/effects/__init__.py", False),
        ("templates/c/source.jinja", False),
    ],
)
def test_an_answer_depends_on_what_the_command_imports_and_reads(file: str, same: bool, tmp_path: Path) -> None:
    """An effect is imported by nobody: its folder is."""
    _written(tmp_path, HALF | {"templates/c/source.jinja": "", "identification/cli/excite.py": ""})
    before = state(tmp_path)
    _written(tmp_path, {file: "changed = True\n"})
    assert (state(tmp_path) == before) is same


def test_all_that_a_diagnosis_loads_is_of_its_state(tmp_path: Path) -> None:
    """But for what any command loads to list the others."""
    _, sources = recorded(tmp_path, [torque("stribeck")] * 3)
    words = ["diagnose", str(tmp_path / "arm.yaml"), *sources, "--out", str(tmp_path / "out")]
    files = "[one.__file__ for one in list(sys.modules.values()) if getattr(one, '__file__', None)]"
    code = f"""
import json, sys
from generator.cli.main import main
main(["list"])
listed = {files}
main({words!r})
print(json.dumps(sorted(set({files}) - set(listed))))
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    loaded = map(Path, json.loads(done.stdout.splitlines()[-1]))
    ours = {
        file for file in loaded if any(file.is_relative_to(ROOT / name) for name in ("generator", "identification"))
    }
    assert len(ours) > 100
    assert ours <= reached(ROOT, MODULES)
