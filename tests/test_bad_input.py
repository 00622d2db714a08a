"""Bad robot files: the exact line that each one is refused with."""

from __future__ import annotations

import errno
import re
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.content import robot_from
from generator.robot.readers import read
from generator.robot.readers import yaml as yaml_reader

GOOD = """\
name: arm
description: a small arm
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
geometry:
  d2: 0.500 m
  rl1: {nominal: 1.2 m, symbolic: true}
  phi: 30 deg
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: rl1, limits: [-170 deg, 170 deg]}
  - {j: 2, sigma: 0, alpha: pi/2, d: d2, theta: q2 + phi, r: 0}
  - {j: 3, sigma: 1, alpha: 0, d: d2 + 2*rl1, theta: 0, r: q3, limits: [0 mm, 250 mm]}
  - {j: 4, sigma: 2, alpha: 0, d: 0, theta: 0, r: 0.1 m, tool: true, label: L}
drives:
  gear_ratios: [-219, 858/3, 100]
  coupling: {convention: row, N32: 1/40}
  torque_constants: {unit: N m/A, use: warm, warm: [1.36, 1.36, 1.2]}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: spring_balancer, joint: 2, values: {d21: 0.7 m, d22: 18 cm, phi: -1.6148 rad}}
flexible: [2, 3]
parameters:
  measured:
    description: from a bench
    source: a notebook
    values:
      ZZ1: {value: 6.58e3, unit: kg m2, relative_std: 0.89, note: by hand}
      Fv2: 8.63e3 N m s/rad
    other_values:
      ML: 175 kg
"""

_SIGNS = str.maketrans({"⏎": "\n", "⇥": "\t", "␇": "\a", "␣": "\u200b", "∅": ""})


def _cases() -> list[tuple[str, str, str]]:
    text = Path(__file__).with_name("bad_input.txt").read_text(encoding="utf-8")
    found = re.findall(r"^(.+) >> (.+)\n    (\d.*)$", text, re.MULTILINE)
    return [(old.translate(_SIGNS), new.translate(_SIGNS), message) for old, new, message in found]


CASES = _cases()


def _refusal(file: Path) -> str:
    with pytest.raises(InputError) as refused:
        read(file)
    return str(refused.value)


def test_the_good_file_is_good_and_every_case_is_read(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(GOOD)
    assert read(file).name == "arm"
    text = Path(__file__).with_name("bad_input.txt").read_text(encoding="utf-8")
    assert len(CASES) == len(re.findall("^ {4}", text, re.MULTILINE)) >= 145


@pytest.mark.parametrize(
    ("old", "new", "message"), CASES, ids=[f"{old.strip()} >> {new.strip()}" for old, new, _ in CASES]
)
def test_refusal(old: str, new: str, message: str, tmp_path: Path) -> None:
    assert old in GOOD
    file = tmp_path / "arm.yaml"
    file.write_text(GOOD.replace(old, new, 1), encoding="utf-8")
    assert _refusal(file) == f"{file}:{message}"


def test_units_that_a_message_recommends_are_known(tmp_path: Path) -> None:
    (message,) = {told for _, _, told in CASES if "is no fraction of N m/A" in told}
    for unit in re.fullmatch(r".*expected one such as (.+) or (.+)", message).groups():  # type: ignore[union-attr]
        file = tmp_path / "arm.yaml"
        file.write_text(GOOD.replace("unit: N m/A", f"unit: {unit}"))
        assert read(file).drives is not None


@pytest.mark.parametrize("content", ["", "\n\n", "# only a comment\n", "---\n", "\ufeff"])
def test_empty_file(content: str, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(content, encoding="utf-8")
    assert re.fullmatch(rf"{re.escape(str(file))}:\d:1: the file is empty, expected a robot file", _refusal(file))


def test_binary_file(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_bytes(b"name: arm\n\x7fELF\x02\xff\x00")
    assert _refusal(file) == f"{file}:2:6: byte 0xff is not UTF-8, expected a text file in UTF-8"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"\xef\xbb\xbfname: a\ndescription: x\xffyz", "2:15: byte 0xff"),
        (b"\xef\xbb\xbfa: 1\n\xffbc", "2:1: byte 0xff"),
        ("x: éé".encode() + b"\xfe", "1:6: byte 0xfe"),
        (b"a: 1\rb: \xff", "2:4: byte 0xff"),
    ],
)
def test_a_byte_is_told_where_an_editor_shows_it(content: bytes, told: str, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_bytes(content)
    assert _refusal(file) == f"{file}:{told} is not UTF-8, expected a text file in UTF-8"


def test_control_characters(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_bytes(b"name: arm\n\x00")
    assert _refusal(file) == f"{file}:2:1: not YAML: character 0, expected a robot file in YAML"


def test_joiners_of_letters_are_no_control_characters(tmp_path: Path) -> None:
    """Persian has one between letters, and some pictures are made of two."""
    file = tmp_path / "arm.yaml"
    told = "\u0645\u06cc\u200c\u062e\u0648\u0627\u0647\u0645 \U0001f469\u200d\U0001f527"
    file.write_text(GOOD.replace("a small arm", told), encoding="utf-8")
    assert read(file).description == told


@pytest.mark.parametrize("space", ["\u00a0", "\u202f", "\u3000"])
def test_a_space_of_any_kind_is_a_blank(space: str, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(GOOD)
    plain = read(file)
    file.write_text(GOOD.replace(" ", space), encoding="utf-8")
    assert read(file) == plain


@pytest.mark.parametrize("name", ["arm.yaml", "arm"])
def test_folder(name: str, tmp_path: Path) -> None:
    folder = tmp_path / name
    folder.mkdir()
    assert _refusal(folder) == f"{folder}:1:1: this is a folder, expected a robot file"


def test_missing_file(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    message = f"{file}:1:1: cannot read the file (No such file or directory), expected a robot file"
    assert _refusal(file) == message


def test_unreadable_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(GOOD)

    def refuse(_: Path) -> bytes:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    assert _refusal(file) == f"{file}:1:1: cannot read the file (Permission denied), expected a robot file"


def test_unknown_ending(tmp_path: Path) -> None:
    file = tmp_path / "arm.toml"
    file.write_text(GOOD)
    assert _refusal(file) == f"{file}:1:1: a file ending in '.toml', expected .yaml or .yml"


def test_huge_file(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_bytes(b"# \n" * 1_400_000)
    assert _refusal(file) == f"{file}:1:1: the file has 4200000 bytes, expected at most 4000000"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("[" * 1_000_000, "1:18: the file is nested too deeply, expected at most 16 levels"),
        ("{a: " * 250_000, "1:66: the file is nested too deeply, expected at most 16 levels"),
        ("- " * 500_000, "1:35: the file is nested too deeply, expected at most 16 levels"),
        ("a: " + "(" * 1_000_000, "1:4: a word of more than 4096 characters, expected a robot file in YAML"),
        ("!" * 1_000_000, "1:1: a word of more than 4096 characters, expected a robot file in YAML"),
        ("a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n", "1:4: anchor '&a', expected the value alone"),
        ("- 1\n" * 250_000, "20000:3: the file says too much, expected at most 20000 values"),
        ("x " * 1_100_000, "1:1: the file has 2200000 characters, expected at most 2000000"),
    ],
    ids=["lists", "tables", "blocks", "parentheses", "tags", "aliases", "values", "characters"],
)
def test_a_megabyte_of_nesting_is_refused_at_once(content: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(content)
    start = time.process_time()
    assert _refusal(file) == f"{file}:{message}"
    assert time.process_time() - start < 3.0


def test_unknown_robot(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "robots").mkdir()
    for name in ("kr500", "arm"):
        (tmp_path / "robots" / f"{name}.yaml").write_text(GOOD)
    monkeypatch.setenv("COUNTERPOISE_DATA", str(tmp_path))
    assert find_robot("arm") == tmp_path / "robots" / "arm.yaml"
    with pytest.raises(InputError) as refused:
        find_robot("kr5000")
    expected = "perhaps kr500, else one of arm, kr500 or the path of a robot file"
    assert str(refused.value) == f"kr5000:1:1: there is no robot 'kr5000', expected {expected}"
    with pytest.raises(InputError) as refused:
        find_robot("./kr500.yaml")
    assert str(refused.value) == "./kr500.yaml:1:1: there is no such file, expected the path of a robot file"


_SNIPPETS = st.one_of(
    st.text(max_size=8),
    st.text(alphabet="[]{}:,-?|>&*!%@`'\"#\n \tq1d2.()/^~=", max_size=8),
    st.sampled_from(
        ["- ", ": ", "\n  ", "[", "{", "}", "q2", "rl1", " m", "1e9", "pi", "''", "\x85", "\u2028", "\ufeff"]
    ),
)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@example([(0, len(GOOD), "\ud800")])
@given(st.lists(st.tuples(st.integers(0, len(GOOD)), st.integers(0, 12), _SNIPPETS), min_size=1, max_size=3))
def test_any_edit_of_a_file_is_read_or_refused_in_one_line(edits: list[tuple[int, int, str]]) -> None:
    text = GOOD
    for start, length, snippet in edits:
        text = text[:start] + snippet + text[start + length :]
    try:
        robot_from(yaml_reader.read(text, "arm.yaml"))
    except InputError as refused:
        message = str(refused)
    else:
        return
    assert re.match(r"arm\.yaml:\d+:\d+: \S", message)
    assert message.isprintable()
