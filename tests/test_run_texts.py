"""Runs as text, of every form that logs have; and texts that are not what they should be."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from generator.errors import InputError
from generator.robot.description import Robot
from identification.dataset import load
from tests.recorded import Recorded, same


def text_of(good: Recorded, tmp_path: Path) -> str:
    return good.save(tmp_path / "good.csv").read_text()


TEXTS: dict[str, tuple[Callable[[str], str], str]] = {
    "empty": (lambda text: "", ":1:1: the file is empty"),
    "header alone": (lambda text: text.splitlines()[0] + "\n", ":1:1: there are no samples in the file"),
    "no header": (lambda text: text.partition("\n")[2], ":1:1: column name '0.0', expected a header row"),
    "twice": (lambda text: text.replace("tau2", "tau1", 1), r":1:\d+: column tau1 is there twice"),
    "word": (lambda text: text.replace("\n0.015,", "\n0.015,fast,", 1), r":5:7: q1 is 'fast', expected a number"),
    "empty field": (lambda text: text.replace("\n0.015,", "\n0.015,,", 1), r":5:7: q1 is missing, expected a number"),
    "short row": (
        lambda text: "\n".join([*text.splitlines()[:40], text.splitlines()[40].rpartition(",")[0], "0.2,0,0,0,0", ""]),
        ":41:1: 4 fields in a row, 5 names in the header, expected a complete row; is the file cut off",
    ),
    "decimal commas between commas": (
        lambda text: text.partition("\n")[0] + "\n" + text.partition("\n")[2].replace(".", ","),
        r":2:1: \d+ fields in a row, 5 names in the header, expected as many fields as names; where numbers have dec",
    ),
    "a long name": (lambda text: text.replace("q2", 100 * "\0", 1), r":1:6: column name '(\\x00){60}\.\.\.', expected"),
    "a short row alone": (
        lambda text: "\n".join([*text.splitlines()[:1], "0,0,0,0", ""]),
        ":2:1: 4 fields in a row, 5 names in the header, expected a complete row; is the file cut off",
    ),
    "empty line": (lambda text: text.replace("\n0.1,", "\n\n0.1,", 1), ":22:1: the line is empty"),
    "decimal comma between commas": (lambda text: text.replace("\n0.1,", '\n"0,1",', 1), ":22:1: t is '0,1', expected"),
    "both marks": (
        lambda text: text.replace(",", ";").replace("\n0.1;", "\n1.000,1;", 1),
        ":22:1: t is '1.000,1', expected a number",
    ),
    "two marks": (
        lambda text: text.replace(",", ";").replace("\n0.1;", "\n0,1;", 1),
        ":22:1: t is '0,1', expected a number with '.', as in the rows before",
    ),
    "unit": (
        lambda text: "# a\n" + text.replace("q2", "q2 [deg]", 1),
        r":2:6: column name 'q2 \[deg\]', expected a name of letters, digits and _, such as q1, in rad; q1_deg with "
        r"'columns: {q1: q1_deg \* pi / 180}' in the sidecar",
    ),
    "other name": (
        lambda text: text.replace("q2", "Pos 2", 1),
        r":1:6: column name 'Pos 2', expected a name of letters, digits and _, such as q1\Z",
    ),
    "a field too many": (
        lambda text: text.replace("\n", ",\n").replace(",\n", ",7\n", 3).replace(",7\n", ",\n", 2),
        ":3:1: 6 fields in a row, 5 names in the header",
    ),
    "units below the header": (
        lambda text: text.replace("\n", "\ns,rad,rad,Nm,Nm\n", 1),
        ":2:1: t is 's', expected a number; a row of units stands before the header, behind #",
    ),
    "a word beside a column of words": (
        lambda text: with_modes(text).replace("\n0.1,", "\n0.1s,", 1),
        ":22:1: t is '0.1s', expected a number",
    ),
    "too large for a sensor": (
        lambda text: re.sub(r"\n(0\.1,.*),.*\n", r"\n\1,1e155\n", text, count=1),
        r":22:\d+: tau2 is 1e\+155, expected a number within \+-1e\+30",
    ),
    "underscore": (lambda text: text.replace("\n0.1,", "\n0_1,", 1), ":22:1: t is '0_1', expected a number"),
}


def with_modes(text: str) -> str:
    """With a column of words, one of which is missing."""
    return text.replace("\n", ",AUT\n").replace(",AUT", ",mode", 1).replace(",AUT", ",", 1)


def decimal_commas(text: str, separator: str) -> str:
    return text.replace(",", separator).replace(".", ",")


FORMS: dict[str, Callable[[str], str]] = {
    "decimal commas": lambda text: decimal_commas(text, ";"),
    "tabs and decimal commas": lambda text: decimal_commas(text, "\t"),
    "semicolons and decimal points": lambda text: text.replace(",", ";"),
    "comments": lambda text: "# arm 2\n% 7 May; warm, 30 C\n\n" + text,
    "separator said": lambda text: "sep=;\n" + decimal_commas(text, ";"),
    "empty lines at the end": lambda text: text + "\n \n",
    "empty rows at the end": lambda text: text + ",,,,\n,,,,\n",
    "separators at the end": lambda text: text.replace("\n", ",\n"),
    "separators at the end of rows": lambda text: text.replace("\n", ",\n").replace(",\n", "\n", 1),
    "separator at the end of the header": lambda text: text.replace("\n", ",\n", 1),
    "quotes": lambda text: '"' + text.replace(",", '","').replace("\n", '"\n"')[:-1],
    "quotes and decimal commas": lambda text: '"' + decimal_commas(text, '";"').replace("\n", '"\n"')[:-1],
    "line ends": lambda text: text.replace("\n", "\r\n"),
}


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("form", FORMS)
def test_texts_of_other_forms_say_the_same(
    form: str, encoding: str, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    path = tmp_path / "other.csv"
    path.write_bytes(FORMS[form](text_of(good, tmp_path)).encode(encoding))
    run = load(str(path), robot)
    assert same(run, good)
    assert not run.notes


@pytest.mark.parametrize("name", TEXTS)
def test_bad_texts_are_refused_with_line_and_column(name: str, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    change, message = TEXTS[name]
    path = tmp_path / "bad.csv"
    path.write_text(change(text_of(good, tmp_path)))
    with pytest.raises(InputError, match=message):
        load(str(path), robot)


@pytest.mark.parametrize("form", ["as written", "decimal commas", "separators at the end"])
@pytest.mark.parametrize(("lacks", "end"), [("no end", ""), ("3 of 5 fields", "\n")])
def test_a_last_line_that_is_cut_is_left_out_and_told(
    form: str, lacks: str, end: str, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    path = tmp_path / "cut.csv"
    text = FORMS.get(form, str)(text_of(good, tmp_path))
    last = text.splitlines()[-1]
    path.write_text(text.removesuffix(last + "\n") + last[: len(last) // 3] + end)
    for name, rows in ((str(path), 1599), (f"{path}@0:7", 1401)):
        run = load(name, robot)
        assert run.samples == rows
        assert run.notes == (f"{path}:1601: the last line has {lacks} and is left out, the file may be cut off there",)


def test_a_byte_that_is_not_utf_8_has_its_place(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = tmp_path / "latin.csv"
    path.write_bytes(2000 * "# é\n".encode() + b"# Gr\xf6\xdfe\n" + text_of(good, tmp_path).encode())
    with pytest.raises(InputError, match=r"latin.csv:2001:5: byte 0xf6 is not UTF-8, expected a header row"):
        load(str(path), robot)
