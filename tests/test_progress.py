"""How commands show that work goes on: on a terminal, on one that cannot move its cursor, and where there is none."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from io import StringIO
from pathlib import Path

import pytest

from generator.progress import bar, counter, stages
from tests.commands import ROOT, command


@pytest.fixture
def own_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Takes away what the machine's environment says of terminals."""
    for name in ("TTY_COMPATIBLE", "TTY_INTERACTIVE", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)


def test_stages_are_told_on_a_terminal_and_elsewhere(
    own_terminal: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with stages() as announced:
        announced("reading [a/b]")
        announced("writing [/c]")
    lines = "reading [a/b]\nwriting [/c]\n"
    assert capsys.readouterr().err == lines
    for kind, moves in (("xterm", True), ("dumb", False)):
        terminal = StringIO()
        monkeypatch.setenv("TERM", kind)
        monkeypatch.setattr(terminal, "isatty", lambda: True, raising=False)
        monkeypatch.setattr(sys, "stderr", terminal)
        with stages() as announced:
            announced("reading [a/b]")
            announced("writing [/c]")
        assert "writing [/c]" in terminal.getvalue()
        assert (terminal.getvalue() != lines) == moves
    terminal.truncate(terminal.seek(0))
    with bar("reading") as done, counter("starts") as counted:
        done(0.5)
        counted(1, 2)
    assert terminal.getvalue() == "reading\nstarts: 1 of 2 done\n"


def test_stages_are_plain_lines_where_there_is_no_terminal(
    pendulum: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("generate", pendulum, "--out", tmp_path / "out", capsys=capsys)
    assert done.err == f"reading {pendulum.name}\nderiving the model of pendulum\nemitting the files\n"


def test_stages_are_shown_on_a_terminal(own_terminal: None, pendulum: Path) -> None:
    terminal, end = pty.openpty()
    with os.fdopen(terminal, "rb", buffering=0) as screen:
        done = subprocess.run(
            [sys.executable, "-m", "generator", "check", str(pendulum)],
            cwd=ROOT,
            env={**os.environ, "TERM": "xterm-256color"},
            stdout=subprocess.PIPE,
            stderr=end,
            check=True,
        )
        os.close(end)
        shown = screen.read(100_000).decode()
    assert b"is good" in done.stdout
    assert "reading and deriving" in shown
    assert "\x1b[" in shown
