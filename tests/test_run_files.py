"""Runs in all formats, on the joint or the motor side; and files that are not what they should be."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from generator.discovery import modules
from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.readers import read
from identification import readers
from identification.dataset import load
from identification.readers import csv
from tests.elastic_links import KT, N
from tests.recorded import Recorded, same, stacked

# -- formats ----------------------------------------------------------------------------------------------------------


def test_text(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    run = load(str(good.save(tmp_path / "a.csv")), robot)
    assert same(run, good)
    assert (run.samples, run.notes) == (1600, ())
    assert run.rate == pytest.approx(200)
    text = (tmp_path / "a.csv").read_text()
    (tmp_path / "b.csv").write_text("\ufeff" + text.replace(",", ";").replace("\n", "\r\n"))
    assert same(load(str(tmp_path / "b.csv"), robot), good)


def test_matlab(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    variables = {"t": good.columns["t"][:, None], "q": stacked(good, "q").T, "tau": stacked(good, "tau").T, "note": "x"}
    scipy.io.savemat(tmp_path / "a.mat", variables)
    assert same(load(str(tmp_path / "a.mat"), robot), good)


def test_a_variable_of_another_length_is_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    short = stacked(good, "tau").T[:-1]
    variables = {
        "t": good.columns["t"][:, None],
        "q": stacked(good, "q").T,
        "tau": stacked(good, "tau").T,
        "more": short,
    }
    scipy.io.savemat(tmp_path / "a.mat", variables)
    run = load(str(tmp_path / "a.mat"), robot)
    count = len(good.columns["t"])
    note = f"{tmp_path / 'a.mat'}: more is {count - 1} x 2, of runs of {count} samples: it is left out"
    assert run.notes == (note,)


def test_parquet(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    import pyarrow
    from pyarrow import parquet

    parquet.write_table(pyarrow.table(dict(good.columns)), tmp_path / "a.parquet")
    assert same(load(str(tmp_path / "a.parquet"), robot), good)


def test_a_missing_package_is_told_with_what_brings_it(
    robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.parquet").touch()
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    wanted = "pyarrow is not installed, expected make setup or pip install '.[identification]' in the checkout"
    with pytest.raises(InputError, match=re.escape(wanted)):
        load(str(tmp_path / "a.parquet"), robot)


def test_motor_side_and_currents(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    qm, taum = N @ stacked(good, "q"), np.linalg.solve(N.T, stacked(good, "tau"))
    columns = {"t": good.columns["t"], "qm1": qm[0], "qm2": qm[1]}
    motors = Recorded(columns | {"taum1": taum[0], "taum2": taum[1]}).save(tmp_path / "motors.csv")
    currents = Recorded(columns | {"i1": taum[0] / KT[0], "i2": taum[1] / KT[1]}).save(tmp_path / "currents.csv")
    assert same(load(str(motors), robot), good)
    assert same(load(str(currents), robot), good)


def test_further_columns_are_kept_and_unknown_ones_are_not(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    more = good.with_columns(
        qs1=good.columns["q1"] + 1e-4, fz=good.columns["t"], temp2=good.columns["t"], x=good.columns["t"]
    )
    assert sorted(load(str(more.save(tmp_path / "a.csv")), robot).others) == ["fz", "qs1", "temp2"]


@pytest.mark.parametrize(("spelt", "meant"), [("temp_2", "temp2"), ("FZ", "fz"), ("QS_1", "qs1")])
def test_a_column_that_is_nearly_a_known_one_is_told(
    spelt: str, meant: str, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    path = good.with_columns(**{spelt: good.columns["q1"] + 1e-4}).save(tmp_path / "a.csv")
    place = f"{path}:1:{len(','.join(good.columns)) + 2}"
    assert load(str(path), robot).notes == (f"{place}: column {spelt} is not known, perhaps {meant} is meant",)


def test_a_sidecar_tells_robot_payload_and_columns(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    foreign = Recorded({"time": good.columns["t"] * 1000, **good.without("t").columns})
    path = foreign.save(tmp_path / "a.csv")
    side = tmp_path / "a.yaml"
    side.write_text("robot: two_links\nnotes: spindle\npayload: {M: 500 g, MX: unknown}\ncolumns: {t: time / 1000}\n")
    run = load(str(path), robot)
    assert same(run, good)
    assert run.payload is not None
    assert (run.payload.name, run.payload.known, run.payload.sought[-2:]) == ("L", {"M": 0.5}, ("MY", "MZ"))
    for content, message in (
        ("", "the file is empty, expected the sidecar of a run"),
        ("{", "the sidecar of a run in YAML"),
        ("since_cold: -1 s\n", "the time since the drives were cold is -1 s, expected 0 s or more"),
        ("since_cold: 1 m\n", "'m' is the wrong unit, expected s"),
    ):
        side.write_text(content)
        with pytest.raises(InputError, match=rf"a.yaml:1:\d+: .*{message}"):
            load(str(path), robot)
    with pytest.raises(InputError, match=r"a.yaml:1:1: a run file ending in '.yaml', expected a run in .csv"):
        load(str(side), robot)
    side.write_text("name: mine\njoints: []\n")
    with pytest.raises(InputError, match=r"a.yaml:1:1: the robot file of this name would be the sidecar of a.csv"):
        load(str(path), robot)
    side.write_text("robot: other\n")
    with pytest.raises(InputError, match=r"a.yaml:1:1: this is a run of other, expected one of two_links"):
        load(str(path), robot)
    side.write_text("columns:\n  t: time / 1000\n  qmm1: -q1\n")
    with pytest.raises(InputError, match=r"a.yaml:3:3: column qmm1 means nothing, expected one of t, q1.., qm1.."):
        load(str(path), robot)
    side.write_text("columns:\n  t: clock / 1000\n")
    with pytest.raises(InputError, match=r"a.yaml:2:6: .*a.csv has no column clock, expected one of time, q1, "):
        load(str(path), robot)
    side.write_text("columns:\n  t: time / 1000\n  q1: q1 * 1e300 * 1e300\n")
    with pytest.raises(InputError, match=r"a.csv:2:\d+: .*expected a finite number"):
        load(str(path), robot)
    side.write_text("columns:\n  t: time / 1000\n  q1: ((q1 + pi)^2 - (pi - q1)**2) / (4 * pi)\n")
    assert np.allclose(load(str(path), robot).q[0], good.columns["q1"], atol=1e-12)
    side.write_text("payload: {M: -500 g}\n")
    with pytest.raises(InputError, match=r"a.yaml:1:14: M=-0.5, expected a number that is not negative"):
        load(str(path), robot)
    side.write_text("payload: {M: 3 m}\n")
    with pytest.raises(InputError, match=r"a.yaml:1:\d+: 'm' is the wrong unit"):
        load(str(path), robot)


# -- files that are not what they should be ---------------------------------------------------------------------------


def put(run: Recorded, name: str, rows: slice | int, value: float) -> Recorded:
    column = run.columns[name].copy()
    column[rows] = value
    return run.with_columns(**{name: column})


def shifted(run: Recorded) -> Recorded:
    return run.with_columns(q2=run.columns["q2"] + 3.0)


def degrees(run: Recorded) -> Recorded:
    return run.with_columns(q1=np.degrees(run.columns["q1"]), q2=np.degrees(run.columns["q2"]))


def degrees_in_part(run: Recorded) -> Recorded:
    """The joint stays near zero for the most part."""
    q1 = run.columns["q1"]
    return run.with_columns(q1=np.degrees(q1 * (q1 / np.max(np.abs(q1))) ** 8))


def few_degrees(run: Recorded) -> Recorded:
    q1 = run.columns["q1"]
    return run.with_columns(q1=5.0 / np.max(np.abs(q1)) * q1)


def gap(run: Recorded) -> Recorded:
    return Recorded({name: np.delete(values, slice(500, 600)) for name, values in run.columns.items()})


def two_rates(run: Recorded) -> Recorded:
    keep = np.r_[0:800, 800:1600:2]
    return Recorded({name: values[keep] for name, values in run.columns.items()})


def cut_off(run: Recorded) -> Recorded:
    return run.with_columns(q1=np.minimum(run.columns["q1"], 0.6 * run.columns["q1"].max()))


def exchanged(run: Recorded) -> Recorded:
    q1, q2 = run.columns["q1"], run.columns["q2"]
    return run.with_columns(q1=q2, q2=q1, qr1=q1 + 1e-3, qr2=q2 + 1e-3)


BAD: dict[str, tuple[Callable[[Recorded], Recorded], str]] = {
    "missing column": (lambda r: r.without("q2"), r":1:\d+: there is no column q2, expected q1 to q2"),
    "misspelt": (
        lambda r: Recorded({**r.without("tau2").columns, "tau_2": r.columns["tau2"]}),
        r":1:\d+: there is no column tau2, expected tau1 to tau2; perhaps tau_2 is meant",
    ),
    "no time": (lambda r: r.without("t"), ":1:1: there is no column t, expected times in s"),
    "no torques": (
        lambda r: r.without("tau1", "tau2"),
        "there are no columns of efforts, expected tau1 to tau2 or taum1",
    ),
    "nan": (lambda r: put(r, "tau1", 77, np.nan), r":79:\d+: tau1 is nan, expected a finite number"),
    "infinite": (lambda r: put(r, "q1", 5, np.inf), r":7:\d+: q1 is inf, expected a finite number"),
    "gap": (gap, r":502:1: time steps by 0.505 s, at 3 s, where it stepped by 0.005 s, expected one rate without gaps"),
    "jump in time": (
        lambda r: put(r, "t", slice(900, None), 0).with_columns(t=r.columns["t"] + 3 * (np.arange(1600) >= 900)),
        r":902:1: time steps by 3.005 s",
    ),
    "time goes back": (
        lambda r: put(r, "t", 300, 0.1),
        r":302:1: time goes from 1.495 s to 0.1 s, expected times that increase; FILE@FROM:TO takes a part",
    ),
    "two rates": (
        two_rates,
        r":802:1: time steps by 0.01 s, at 4.005 s, where it stepped by 0.005 s|:803:1: time steps",
    ),
    "constant torque": (
        lambda r: put(r, "tau2", slice(None), 4.0),
        r":2:\d+: tau2 is 4 in all rows, expected a measured",
    ),
    "cut-off position": (
        cut_off,
        r":\d+:\d+: q1 stays at [\d.]+ from here for \d+ rows, expected a position that is not",
    ),
    "degrees": (degrees, r"q\d gives joint \d [-\d.]+ rad, outside of -2.793 to 2.793, .* are these degrees\?"),
    "degrees in part": (degrees_in_part, r"q1 gives joint 1 .* are these degrees\?"),
    "few degrees": (few_degrees, r"q1 gives joint 1 .*; are these degrees, or is this a run of another robot\?"),
    "five rows in a row": (
        lambda r: put(r, "q1", slice(700, 705), 3.5),
        r":702:\d+: q1 gives joint 1 3.5 rad, .* in 5 of \d+ samples, .*; is this a run of another",
    ),
    "another pose": (shifted, r"q2 gives joint 2 [\d.]+ rad, outside of .* is this a run of another robot\?"),
    "swapped": (exchanged, r"q1 follows qr2, not qr1, expected columns in the joints' order; are two swapped\?"),
    "another robot": (lambda r: r.with_columns(q3=r.columns["q1"]), "column q3, but two_links has 2 moving joints"),
    "a jump": (lambda r: put(r, "q2", slice(700, None), 2.5), r":702:\d+: q2 jumps from"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_runs_are_refused_with_their_row(name: str, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    change, message = BAD[name]
    path = change(good).save(tmp_path / "bad.csv")
    with pytest.raises(InputError, match=message) as caught:
        load(str(path), robot)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_torque_at_its_limit_is_left_out_and_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    tau = good.columns["tau1"]
    limited = good.with_columns(tau1=np.minimum(tau, np.quantile(tau, 0.95)))
    run = load(str(limited.save(tmp_path / "a.csv")), robot)
    assert run.unusable is not None
    assert not run.unusable[1].any()
    stuck = limited.columns["tau1"] == limited.columns["tau1"].max()
    assert (run.unusable[0] <= stuck).all()
    assert run.unusable[0].sum() > 0.9 * stuck.sum()
    assert "tau1 is cut off for" in run.notes[0]


def test_a_coarse_encoder_that_rests_at_the_end_of_its_way_is_not_cut_off(
    good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    coarse = np.round(cut_off(good).columns["q1"] / 0.004) * 0.004
    assert load(str(good.with_columns(q1=coarse).save(tmp_path / "a.csv")), robot).samples == 1600


def test_coarse_torques_are_neither_cut_off_nor_slowly_logged(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    step = np.ptp(good.columns["tau1"]) / 12
    coarse = good.with_columns(tau1=step * np.round(good.columns["tau1"] / step))
    run = load(str(coarse.save(tmp_path / "a.csv")), robot)
    assert (run.notes, run.unusable) == ((), None)


@pytest.mark.parametrize("steps", [50, 100, 200])
def test_coarse_torques_that_are_cut_off_are_left_out(steps: int, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    tau = good.columns["tau1"]
    step = np.ptp(tau) / steps
    limited = step * np.round(np.minimum(tau, np.quantile(tau, 0.9)) / step)
    run = load(str(good.with_columns(tau1=limited).save(tmp_path / "a.csv")), robot)
    assert run.unusable is not None
    assert run.unusable[0].sum() > 0.9 * (limited == limited.max()).sum()


def test_stays_elsewhere_do_not_hide_that_torques_are_cut_off(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    tau = np.minimum(good.columns["tau1"], np.quantile(good.columns["tau1"], 0.9))
    limited = tau.copy()
    for start in (200, 700, 1200):
        limited[start : start + 150] = tau[start]
    run = load(str(good.with_columns(tau1=limited).save(tmp_path / "a.csv")), robot)
    assert run.unusable is not None
    assert run.unusable[0].sum() > 0.9 * (limited == limited.max()).sum()


@pytest.mark.parametrize("rate", [2.5, 4])
def test_slowly_logged_torques_are_told(rate: float, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    tau = good.columns["tau1"]
    held = tau[(rate * np.floor(np.arange(len(tau)) / rate)).astype(int)]
    run = load(str(good.with_columns(tau1=held).save(tmp_path / "a.csv")), robot)
    assert f"tau1 keeps each value for {int(rate)} rows: it was logged more slowly" in run.notes[0]


@pytest.mark.parametrize("ending", [ending for one in modules(readers) for ending in one.EXTENSIONS])
def test_damaged_files_are_refused(ending: str, robot: Robot, tmp_path: Path) -> None:
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"MATLAB 5.0 MAT-file, Platform" + bytes(range(256)) * 3)
    told = "3:115: byte 0x80 is not UTF-8" if ending in csv.EXTENSIONS else "1:1: this is not a whole"
    with pytest.raises(InputError, match=f"a{ending}:{told}"):
        load(str(path), robot)


def test_other_files_are_refused(robot: Robot, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"there is no such file, expected a run in .csv"):
        load(str(tmp_path / "none.csv"), robot)
    with pytest.raises(InputError, match=r"a run file ending in '.doc'"):
        load(str(tmp_path / "a.doc"), robot)


#: Its second frame is fixed.
BENT = """\
name: bent
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 2, alpha: pi/4, d: 0.2 m, theta: 0, r: 0}
  - {j: 3, sigma: 0, alpha: 0, d: 0.3 m, theta: q3, r: 0}
"""


def test_columns_of_joints_that_are_not_numbered_in_a_row_are_listed(good: Recorded, tmp_path: Path) -> None:
    (tmp_path / "bent.yaml").write_text(BENT)
    with pytest.raises(InputError, match="there is no column q3, expected q1 and q3"):
        load(str(good.save(tmp_path / "run.csv")), read(tmp_path / "bent.yaml"))
