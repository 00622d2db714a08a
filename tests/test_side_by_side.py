"""Work shared by processes: the results are those of one process, whatever becomes of the others."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.connection import Connection

import numpy as np
import pytest

from generator.errors import InputError, Place
from identification.side_by_side import side_by_side
from tests.commands import ROOT

HERE = os.getpid()


def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)


@pytest.mark.parametrize("count", [0, 1, 2, 3, 8])
def test_results_are_in_the_order_of_what_they_are_of(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    two_cores(monkeypatch)
    more = 3.0
    found = side_by_side(lambda x: np.full(2, x + more), range(count))
    assert [x.tolist() for x in found] == [[k + 3.0] * 2 for k in range(count)]


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux alone")
def test_the_work_is_shared_by_as_many_processes_as_there_are_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    two_cores(monkeypatch)
    owners = side_by_side(lambda _: os.getpid(), range(6))
    assert owners[::2] == [HERE] * 3
    assert len(set(owners[1::2])) == 1
    assert owners[1] != HERE
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0})
    assert set(side_by_side(lambda _: os.getpid(), range(6))) == {HERE}


@pytest.mark.parametrize("bad", [0, 3])
def test_no_process_is_left(monkeypatch: pytest.MonkeyPatch, bad: int) -> None:
    """Not one that is still at work, nor one whose results nobody waits for."""
    two_cores(monkeypatch)

    def function(x: int) -> bytes:
        if x == bad:
            raise ValueError(x)
        return bytes(1_000_000)

    with pytest.raises(ValueError, match=str(bad)):
        side_by_side(function, range(4))
    assert not multiprocessing.active_children()


def test_a_process_that_dies_while_it_sends_is_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    two_cores(monkeypatch)

    def half_sent(there: Connection, x: object) -> None:
        os.write(there.fileno(), b"\0\0\1\0rest")
        os._exit(1)

    monkeypatch.setattr(Connection, "send", half_sent)
    assert side_by_side(lambda x: x, range(4)) == [0, 1, 2, 3]


def test_where_no_process_can_be_started_all_is_done_here(monkeypatch: pytest.MonkeyPatch) -> None:
    two_cores(monkeypatch)

    def refused() -> int:
        raise BlockingIOError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(os, "fork", refused, raising=False)
    assert side_by_side(lambda x: (x, os.getpid()), range(4)) == [(x, HERE) for x in range(4)]


INTERRUPTED = """
import os, signal, sys, time
from identification.side_by_side import side_by_side
os.sched_getaffinity = lambda _: {0, 1}
# Whoever began the tests may have it ignored, as shells do for what runs in the background.
signal.signal(signal.SIGINT, signal.default_int_handler)
def function(x):
    os.write(1, b"at work\\n")
    time.sleep(60)
try:
    side_by_side(function, range(2))
except KeyboardInterrupt:
    sys.exit(130)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux alone")
def test_an_interruption_ends_all_processes_without_a_word() -> None:
    command = [sys.executable, "-c", INTERRUPTED]
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stdout is not None
        assert [process.stdout.readline() for _ in range(2)] == ["at work\n"] * 2
        os.killpg(process.pid, signal.SIGINT)
        # Both ends of the pipes are closed: no process holds them any more.
        _, said = process.communicate(timeout=20)
    assert (process.returncode, said) == (130, "")


def in_a_process_of_a_pool(x: int) -> list[int]:
    os.sched_getaffinity = lambda _: {0, 1}
    return side_by_side(lambda _: os.getpid(), range(2 + x))


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux alone")
def test_processes_that_share_work_already_do_not_share_it_again() -> None:
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert len(set(pool.submit(in_a_process_of_a_pool, 2).result())) == 1


def test_what_is_shared_does_not_share_again(monkeypatch: pytest.MonkeyPatch) -> None:
    two_cores(monkeypatch)
    assert side_by_side(lambda x: side_by_side(lambda y: x * y, range(3)), range(4)) == [
        [0, x, 2 * x] for x in range(4)
    ]


@pytest.mark.parametrize("bad", [0, 1])
def test_an_error_is_raised_as_in_one_process(monkeypatch: pytest.MonkeyPatch, bad: int) -> None:
    two_cores(monkeypatch)

    def function(x: int) -> int:
        if x == bad:
            raise InputError(Place("run.csv", 3, 1), "a bad row", "a good one")
        return x

    with pytest.raises(InputError, match="a bad row"):
        side_by_side(function, range(4))


def test_what_a_process_that_dies_had_to_do_is_done_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    two_cores(monkeypatch)

    def function(x: int) -> int:
        if x == 3 and os.getpid() != HERE:
            os.kill(os.getpid(), signal.SIGKILL)
        return x

    assert side_by_side(function, range(6)) == list(range(6))
