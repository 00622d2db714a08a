"""Friction by load where payloads are part of the load: gains from currents, parameters from torques."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.drive_gains import drive_gains
from identification.inverse_model import Options, identify
from identification.observation import Regressors
from identification.sidecar import Payload
from tests.elastic_links import N
from tests.recorded import TRUTH, TWO_LINKS, Recorded, fourier

#: Friction that is a fifth of the load, a payload of 20 kg in the tool frame, and true torque constants [N m/A].
LOAD = {"Fl1": 0.2, "Fl2": 0.2}
BODY = {"XX": 0.3, "YY": 0.5, "ZZ": 0.6, "MX": 1.5, "MY": -0.8, "MZ": 0.4, "M": 20.0}
KT = np.array([0.53, 0.44])
NOISE = 0.01


@pytest.fixture(scope="module")
def links(tmp_path_factory: pytest.TempPathFactory) -> Regressors:
    path = tmp_path_factory.mktemp("links") / "two_links.yaml"
    path.write_text(f"{TWO_LINKS}  - {{effect: load_friction, joints: all}}\n")
    return Regressors(read(path))


def under_load(links: Regressors, folder: Path, seed: int, loaded: bool, unit: str) -> str:
    """A run whose friction by load is written out: the load is all but the other friction."""
    t, motion = fourier(links.model.robot, 20.0, 200.0, seed, slowest=0.15)
    rest = {name: 0.0 for name in TRUTH if name.startswith("F")}
    load = links.torques(TRUTH | rest, motion)
    if loaded:
        payload = Payload("L", BODY)
        body = np.array([payload.known.get(stem, 0.0) for stem in payload.names()])
        load = load + np.array([body @ W for W in links.payload(motion)])
    tau = load + np.array([[TRUTH[f"Fv{j}"]] for j in (1, 2)]) * motion.qd
    tau += np.sign(motion.qd) * (np.array([[TRUTH[f"Fc{j}"]] for j in (1, 2)]) + 0.2 * np.abs(load))
    efforts = np.linalg.solve(N.T, tau) / KT[:, None] if unit == "i" else tau
    efforts += NOISE * efforts.std(axis=1)[:, None] * np.random.default_rng(seed).normal(size=efforts.shape)
    columns = {"t": t} | {f"q{j}": motion.q[j - 1] for j in (1, 2)} | {f"{unit}{j}": efforts[j - 1] for j in (1, 2)}
    return str(Recorded(columns).save(folder / f"{unit}{seed}.csv"))


def within(found: tuple[float, float], truth: float) -> bool:
    return abs(found[0] - truth) < 5 * found[1] < 0.2 * abs(truth)


def test_gains_with_friction_by_load(links: Regressors, tmp_path: Path) -> None:
    empty, loaded = (
        [under_load(links, tmp_path, seed, carries, "i") for seed in seeds]
        for seeds, carries in (((1, 2), False), ((3, 4), True))
    )
    found = drive_gains(links.model.robot, empty, loaded, Payload("L", {"M": 20.0}), regressors=links)
    assert not [note for note in found.notes if "load" in note]
    for k in range(2):
        assert within(found.constants[k], KT[k])
    for name, value in LOAD.items():
        assert within(found.parameters[name], value)
    for name in ("Fc1", "Fc2", "Fv1", "Fv2"):
        value, std = found.parameters[name]
        assert abs(value - TRUTH[name]) < 5 * std, name


def test_parameters_with_friction_by_the_load_of_a_payload(links: Regressors, tmp_path: Path) -> None:
    empty = under_load(links, tmp_path, 1, False, "tau")
    loaded = under_load(links, tmp_path, 3, True, "tau")
    payload = Path(loaded).with_suffix(".yaml")
    payload.write_text("payload: {name: L}\n")
    found = identify(links.model.robot, [empty, loaded], options=Options(), regressors=links)
    assert not [note for note in found.notes if "load" in note and "tell" not in note]
    solution = found.full.solution
    for name, value in (TRUTH | LOAD).items():
        assert abs(solution.values[name] - value) < 5 * solution.std(name), name
    for name in LOAD:
        assert within((solution.values[name], solution.std(name)), 0.2)
    for stem in ("M", "MX", "MY"):
        name = f"{stem}L"
        assert name in solution.hidden or abs(solution.values[name] - BODY[stem]) < 5 * solution.std(name), name
