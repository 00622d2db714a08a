"""The recipe of the EMPS benchmark, on a file of its layout with known truth, against the recipe written out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io
from numpy.typing import NDArray
from scipy import signal

from generator.resources import find_robot
from generator.robot.readers import read
from identification.inverse_model import identify

Array = NDArray[np.float64]

SAMPLES = 24841
GTAU = 35.15065188
TRUTH = {"M1": 95.0, "Fv1": 204.0, "Fc1": 20.4, "Off1": -3.2}


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """t, qm [m], qg [m], vir [V], gtau [N/V]: a carriage that goes to and fro for 25 s at 1 kHz."""
    t = np.arange(SAMPLES) / 1000
    draw = np.random.default_rng(1)
    waves = [(0.09, 0.25, 0.0), (0.02, 0.7, 1.0), (0.003, 2.3, 2.0), (0.0006, 6.1, 0.5)]
    q = sum(a * np.sin(2 * np.pi * f * t + p) for a, f, p in waves)
    qd = sum(a * 2 * np.pi * f * np.cos(2 * np.pi * f * t + p) for a, f, p in waves)
    qdd = sum(-a * (2 * np.pi * f) ** 2 * np.sin(2 * np.pi * f * t + p) for a, f, p in waves)
    force = TRUTH["M1"] * qdd + TRUTH["Fv1"] * qd + TRUTH["Fc1"] * np.sign(qd) + TRUTH["Off1"]
    vir = (force + draw.normal(scale=8.0, size=SAMPLES)) / GTAU
    qm = np.round((q + draw.normal(scale=2e-7, size=SAMPLES)) / 5e-8) * 5e-8
    path = tmp_path_factory.mktemp("emps") / "DATA.mat"
    columns = {"t": t, "qm": qm, "qg": q, "vir": vir}
    scipy.io.savemat(path, {name: values[:, None] for name, values in columns.items()} | {"gtau": GTAU})
    return path


def difference(x: Array) -> Array:
    inner = (x[2:] - x[:-2]) / 2
    return np.concatenate([[x[1] - x[0]], inner, [x[-1] - x[-2]]]) * 1000


def written_out(file: Path) -> tuple[Array, Array]:
    """W and Y by the recipe, step by step."""
    data = {name: np.ravel(value) for name, value in scipy.io.loadmat(file).items() if not name.startswith("__")}
    b, a = signal.butter(4, 100 / 500)
    q = signal.filtfilt(b, a, data["qm"], padlen=12)
    qd = difference(q)
    qdd = difference(qd)
    columns = [qdd, qd, np.sign(qd), np.ones(SAMPLES), data["gtau"] * data["vir"]]
    b, a = signal.cheby1(8, 0.05, 0.08)
    kept = int(np.ceil((SAMPLES - 49) / 10))
    start = 10 - (10 * kept - (SAMPLES - 49))
    # At an end, about which the samples are continued, the filter leaves all noise.
    decimated = [signal.filtfilt(b, a, column[49:], padlen=24)[start - 1 :: 10][2:-2] for column in columns]
    return np.stack(decimated[:4], axis=1), decimated[4]


def test_the_recipe_gives_what_it_gives_written_out(file: Path) -> None:
    found = identify(read(find_robot("emps")), [file])
    W, Y = written_out(file)
    chi = np.linalg.lstsq(W, Y, rcond=None)[0]
    error = Y - W @ chi
    std = np.std(error, ddof=1) * np.sqrt(np.diag(np.linalg.inv(W.T @ W)))
    solution, total = found.full.solution, found.full.train.total
    assert list(found.full.sought) == list(TRUTH)
    assert (total.rows, found.train[0].sampled.filters.factor) == (2476, 10)
    assert [solution.values[name] for name in TRUTH] == pytest.approx(chi, rel=1e-6)
    assert [solution.relative_std(name) for name in TRUTH] == pytest.approx(100 * std / np.abs(chi), rel=1e-6)
    assert solution.condition == pytest.approx(np.linalg.cond(W), rel=1e-6)
    assert total.norm == pytest.approx(np.linalg.norm(error), rel=1e-6)
    assert total.relative == pytest.approx(100 * np.linalg.norm(error) / np.linalg.norm(Y), rel=1e-6)


def test_the_truth_lies_within_three_std(file: Path) -> None:
    solution = identify(read(find_robot("emps")), [file]).full.solution
    for name, truth in TRUTH.items():
        assert solution.values[name] == pytest.approx(truth, abs=3 * solution.std(name) + 2e-3 * abs(truth))
        assert solution.relative_std(name) < 5
