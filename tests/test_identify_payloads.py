"""Which run carries which payload, and what of it the runs can tell."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from identification.drive_gains import drive_gains
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.results import document
from identification.sidecar import UNITS, Payload
from tests.recorded import TRUTH, Recorded, as_recorded, fourier, recorded

PLAIN = Recipe(dynamics=4.0)
#: Ten parameters of a point mass in the tool frame [SI], by its mass.
POINT = {mass: [0.0] * 9 + [mass] for mass in (0.0, 0.5, 2.5)}
#: Those of half a kilogram as a sidecar tells them.
POINT_OF_HALF = dict.fromkeys(UNITS, 0.0) | {"M": 0.5}


def carrying(links: Regressors, mass: float, path: Path, says: str) -> Path:
    recorded(links, TRUTH, seed=round(10 * mass) + 1, payload=POINT[mass]).save(path)
    path.with_suffix(".yaml").write_text(says)
    return path


def known(name: str, mass: float) -> str:
    values = dict.fromkeys(UNITS, 0.0) | {"M": mass}
    return f"payload: {{name: {name}, {', '.join(f'{k}: {x} {UNITS[k]}' for k, x in values.items())}}}\n"


def test_a_run_that_says_it_carries_nothing_is_given_no_payload(links: Regressors, tmp_path: Path) -> None:
    empty = carrying(links, 0.0, tmp_path / "empty.csv", "payload: none\n")
    loaded = carrying(links, 2.5, tmp_path / "loaded.csv", "notes: of the day after\n")
    payload = Payload("L", dict.fromkeys(UNITS, 0.0) | {"M": 2.5})
    found = identify(links.model.robot, [empty, loaded], options=Options(PLAIN, payload=payload), regressors=links)
    values = found.full.solution.values
    assert {name: values[name] for name in TRUTH} == pytest.approx(TRUTH, rel=5e-3, abs=0.03)


def test_a_payload_that_all_sidecars_contradict_is_refused(links: Regressors, tmp_path: Path) -> None:
    empty = carrying(links, 0.0, tmp_path / "empty.csv", "payload: none\n")
    loaded = carrying(links, 2.5, tmp_path / "loaded.csv", known("L", 2.5))

    def fitted(*runs: Path, payload: Payload, test: tuple[Path, ...] = ()) -> Mapping[str, float]:
        options = Options(PLAIN, payload=payload)
        return identify(links.model.robot, runs, test, options, links).full.solution.values

    for payload in (Payload("L", {"M": 77.0}), Payload("K", {"M": 2.5}), Payload("K", {})):
        with pytest.raises(
            InputError, match=f"^--payload:1:1: no run carries payload {payload.name} with these values"
        ):
            fitted(empty, loaded, payload=payload)
    with pytest.raises(InputError, match="no run carries payload L"):
        fitted(empty, payload=Payload("L", {"M": 2.5}))
    told = fitted(empty, loaded, payload=Payload("L", {"M": 2.5}))
    assert told["ML"] == 2.5
    silent = carrying(links, 0.5, tmp_path / "silent.csv", "notes: of the day after\n")
    assert fitted(empty, silent, payload=Payload("K", POINT_OF_HALF))["MX2"] == pytest.approx(TRUTH["MX2"], rel=0.01)
    fitted(empty, test=(silent,), payload=Payload("K", POINT_OF_HALF))


def test_one_payload_with_two_values_is_refused(links: Regressors, tmp_path: Path) -> None:
    """In the same words, whatever is sought, at the run that comes later."""
    runs = [carrying(links, mass, tmp_path / f"{mass}.csv", known("L", mass)) for mass in (0.5, 2.5)]
    told = f"{runs[1]}:1:1: payload L has other values here, expected another name for another payload"
    with pytest.raises(InputError, match=f"^{re.escape(told)}$"):
        identify(links.model.robot, runs, options=Options(PLAIN), regressors=links)


def test_of_two_payloads_one_is_told_from_the_other(links: Regressors, tmp_path: Path) -> None:
    """Without an empty run the first counts as part of the last body; the other one's difference shows."""
    first = carrying(links, 0.5, tmp_path / "first.csv", "payload: {name: A}\n")
    second = carrying(links, 2.5, tmp_path / "second.csv", "payload: {name: B, MZ: 0 kg m}\n")
    found = identify(links.model.robot, [first, second], options=Options(PLAIN), regressors=links)
    assert [note[:10] for note in found.notes if "tells" in note] == ["payload A:"]
    assert found.full.train.total.relative_to_mean < 0.2
    # A point at the tool's origin, 0.4 m beyond the second joint.
    assert found.full.solution.values["MX2"] == pytest.approx(TRUTH["MX2"] + 0.5 * 0.4, rel=0.01)
    told = document(found)["payloads"]
    assert all(one["value"] is None and np.isinf(one["std"]) for one in told["A"].values())
    assert any(one["value"] is not None for one in told["B"].values())


def alone(links: Regressors, mass: float, seed: int, path: Path, says: str) -> Path:
    """A run, with noise of 0.05 N m, in which the second joint alone moves."""
    t, motion = fourier(links.model.robot, 20.0, 200.0, seed)
    still = Motion(*(np.array([[0.0], [1.0]]) * one for one in (motion.q, motion.qd, motion.qdd)))
    tau = links.torques(TRUTH, still) + np.array([POINT[mass] @ W for W in links.payload(still)])
    tau += 0.05 * np.random.default_rng(seed).normal(size=tau.shape)
    as_recorded(links, t, still.q, tau).save(path)
    path.with_suffix(".yaml").write_text(says)
    return path


def test_a_payload_that_shows_only_in_sums_is_not_taken_from_the_runs_that_carry_it(
    links: Regressors, tmp_path: Path
) -> None:
    """The first joint stands still: beside an empty run the second one's torque tells sums of the payload's values."""
    empty = alone(links, 0.0, 1, tmp_path / "empty.csv", "payload: none\n")
    loaded = alone(links, 2.5, 2, tmp_path / "loaded.csv", "payload: {name: L}\n")
    found = identify(links.model.robot, [empty, loaded], options=Options(PLAIN), regressors=links)
    left = found.full.train.per_joint[1]
    assert left.norm < 0.05 * np.sqrt(left.rows)
    assert not [note for note in found.notes if "tells" in note]
    values = found.full.solution.values
    # The first moment about the second joint, 0.4 m from the tool's origin.
    assert values["MXL"] + 0.4 * values["ML"] == pytest.approx(2.5 * 0.4, rel=0.01)
    assert {"ML", "MXL", "XXL"} <= set(found.full.solution.hidden)


def test_of_a_payload_on_all_runs_no_more_is_said_than_the_last_body_holds(links: Regressors, tmp_path: Path) -> None:
    loaded = alone(links, 2.5, 2, tmp_path / "loaded.csv", "payload: {name: L}\n")
    found = identify(links.model.robot, [loaded], options=Options(PLAIN), regressors=links)
    (note,) = (note for note in found.notes if "tells" in note)
    # Turning about its axis, the second joint shows no moment of inertia about another one.
    assert "tells ZZL MXL MYL ML from" in note
    assert found.full.train.per_joint[1].norm < 0.05 * np.sqrt(found.full.train.per_joint[1].rows)


def test_gains_are_not_found_from_runs_in_the_wrong_places(links: Regressors, tmp_path: Path) -> None:
    def current(path: Path) -> str:
        run = recorded(links, TRUTH)
        columns = {name.replace("tau", "i"): values for name, values in run.columns.items()}
        return str(Recorded(columns).save(path))

    empty, loaded = current(tmp_path / "empty.csv"), current(tmp_path / "loaded.csv")
    (tmp_path / "empty.yaml").write_text("payload: none\n")
    (tmp_path / "loaded.yaml").write_text(known("L", 2.5))
    robot = links.model.robot
    with pytest.raises(InputError, match=r"loaded.csv:1:1: payload L is on a run that counts as empty"):
        drive_gains(robot, [loaded], [loaded], regressors=links)
    with pytest.raises(InputError, match=r"empty.csv:1:1: no payload is on a run that counts as loaded"):
        drive_gains(robot, [empty], [empty], Payload("L", {"M": 2.5}), regressors=links)


@pytest.mark.parametrize("word", ["None", "", "150 kg", "[1, 2]"])
def test_a_payload_is_a_table_or_none(word: str, links: Regressors, tmp_path: Path) -> None:
    run = carrying(links, 0.0, tmp_path / "a.csv", f"payload: {word}\n")
    told = "a.yaml:1:.*: payload is no table, expected none, or a table such as {M: 150 kg}, of which"
    with pytest.raises(InputError, match=told):
        identify(links.model.robot, [run], options=Options(PLAIN), regressors=links)
