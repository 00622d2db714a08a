"""Least squares among parameters that matter can have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from generator.symbolic.pseudo_inertia import of_body, uniform_bar
from identification.consistency import grouped
from identification.consistent_fit import ConsistentFit, consistent_fit, doubts
from identification.inverse_model import Identification, Options, identify
from identification.left_open import columns_of_standard, left_open, told
from identification.observation import Motion, Regressors
from identification.recipes import Recipe
from identification.results import CONSISTENT, document, parameter_sets
from tests.bodies import STEMS
from tests.recorded import Recorded, as_recorded, fourier, recorded, regressors

#: Two bars with rotors; what the base parameters are made of.
BARS = {1: uniform_bar(20.0, (0, 0, 0), (0.5, 0, 0), 0.1), 2: uniform_bar(6.0, (0, 0, 0), (0.4, 0.05, 0), 0.08)}
DRIVES = {"Ia1": 1.5, "Fv1": 14.0, "Fc1": 9.0, "Off1": 1.5, "Ia2": 0.9, "Fv2": 7.0, "Fc2": 4.0, "Off2": -0.8}
WEIGHT = 0.03


def ten(number: int, P: np.ndarray) -> dict[str, float]:
    """The inertial parameters of a pseudo-inertia."""
    S, half = P[:3, :3], np.trace(P[:3, :3])
    tensor = half * np.eye(3) - S
    values = [*tensor[np.triu_indices(3)], *P[:3, 3], P[3, 3]]
    return {f"{stem}{number}": float(value) for stem, value in zip(STEMS, values, strict=True)}


STANDARD = {**ten(1, BARS[1]), **ten(2, BARS[2]), **DRIVES}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("runs")


def found(links: Regressors, run: Recorded, path: Path, **options: object) -> Identification:
    recipe = Recipe(dynamics=4.0)
    return identify(links.model.robot, [run.save(path)], [path], Options(recipe=recipe, **options), links)  # type: ignore[arg-type]


def possible(links: Regressors, fit: ConsistentFit) -> bool:
    bodies = [of_body(number, fit.standard) for number in (1, 2)]
    bounded = all(
        fit.standard[p.name] >= p.lower - 1e-6 for p in links.model.standard_parameters if p.lower is not None
    )
    return bounded and min(np.linalg.eigvalsh(P).min() / P[3, 3] for P in bodies) > -1e-9


def test_possible_bodies_are_found_again(links: Regressors, folder: Path) -> None:
    truth = grouped(links.model, STANDARD)
    one = found(links, recorded(links, truth, noise=0.005), folder / "a.csv")
    fit = consistent_fit(one, STANDARD, WEIGHT)
    assert possible(links, fit)
    assert dict(fit.base) == pytest.approx(truth, rel=0.02, abs=0.05)
    assert fit.base == pytest.approx(grouped(links.model, fit.standard))
    assert fit.train.total.norm < 1.01 * one.full.train.total.norm
    assert fit.test is not None
    assert fit.test.total.norm == pytest.approx(fit.train.total.norm)
    assert doubts(one, fit) == []


def test_rows_count_by_their_noise_whatever_the_free_fit_did(links: Regressors, folder: Path) -> None:
    """A free fit without weights leaves the quiet joint more than need be; what is possible is sought near neither."""
    truth = grouped(links.model, STANDARD)
    run = recorded(links, truth)
    noise = np.random.default_rng(5).normal(size=(2, len(run.columns["t"]))) * [[2.0], [0.02]]
    loud = Recorded({**run.columns, **{f"tau{j}": run.columns[f"tau{j}"] + noise[j - 1] for j in (1, 2)}})
    by_joint, none = (
        identify(
            links.model.robot,
            [loud.save(folder / "loud.csv")],
            [],
            Options(recipe=Recipe(dynamics=4.0, weights=weights)),
            links,
        )
        for weights in ("joint", "none")
    )
    best, other = (consistent_fit(one, STANDARD, 0.0).base for one in (by_joint, none))
    std = dict(zip(by_joint.full.solution.names, np.sqrt(np.diag(by_joint.full.solution.covariance)), strict=True))
    away = [abs(other[name] - best[name]) / std[name] for name in std]
    assert max(away) < 0.3


def test_impossible_estimates_become_possible(links: Regressors, folder: Path) -> None:
    """Torques that no bodies and no friction make."""
    impossible = {**grouped(links.model, STANDARD), "ZZ2": -0.2, "Fc1": -2.0}
    one = found(links, recorded(links, impossible, noise=0.005), folder / "b.csv")
    values = one.full.solution.values
    assert (values["ZZ2"], values["Fc1"]) == pytest.approx((-0.2, -2.0), abs=0.1)
    fit = consistent_fit(one, None, WEIGHT)
    assert possible(links, fit)
    assert fit.base["ZZ2"] >= fit.base["MX2"] ** 2 / fit.standard["M2"] > 0
    assert fit.base["Fc1"] >= -1e-6
    assert fit.train.total.norm > one.full.train.total.norm


def test_torques_of_no_robot_are_doubted(links: Regressors, folder: Path) -> None:
    """A link of negative inertia and mass: free parameters explain it as well as any other."""
    truth = grouped(links.model, STANDARD)
    impossible = {**truth, "ZZ2": -20 * truth["ZZ2"], "MX2": -truth["MX2"]}
    one = found(links, recorded(links, impossible, noise=0.005), folder / "impossible.csv")
    assert one.full.train.total.relative_to_mean < 20
    (doubt,) = doubts(one, consistent_fit(one, None, WEIGHT))
    assert doubt.startswith("no possible bodies and friction explain these torques (")


def test_given_values_are_kept_or_refused(links: Regressors, folder: Path) -> None:
    truth = grouped(links.model, STANDARD)
    run = recorded(links, truth, noise=0.01)
    fit = consistent_fit(found(links, run, folder / "c.csv", fixed={"MX2": 1.0, "Fc1": 8.0}), None, WEIGHT)
    assert (fit.base["MX2"], fit.base["Fc1"]) == pytest.approx((1.0, 8.0), rel=1e-4)
    with pytest.raises(ValueError, match="no physically consistent parameters were found"):
        consistent_fit(found(links, run, folder / "c.csv", fixed={"Fc1": -1.0}), None, WEIGHT)


def test_an_impossible_prior_is_refused(links: Regressors, folder: Path) -> None:
    one = found(links, recorded(links, grouped(links.model, STANDARD)), folder / "d.csv")
    with pytest.raises(InputError, match="body 2 of the prior is impossible, expected a positive pseudo-inertia"):
        consistent_fit(one, {**STANDARD, "ZZ2": -1.0}, WEIGHT)


#: A vertical slide with a rotor and a body, which weight and acceleration tell apart.
LIFT = """\
name: lift
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: 0, d: 0, theta: 0, r: q1}
effects:
  - {effect: rotor_inertia, joints: all}
"""


def test_an_unknown_inertia_is_that_of_a_ball_as_heavy_as_the_bodies(folder: Path) -> None:
    """Its mass lies 0.3 m off its centre in every direction, root mean square, and two directions are across an axis:
    the moments of 20 kg are 2 x 20 x 0.3^2 kg m2, whatever the rotor.
    """
    path = folder / "lift.yaml"
    path.write_text(LIFT)
    lift = Regressors(read(path))
    t = np.arange(0, 10, 0.005)
    q, qdd = 0.3 * np.sin(2 * t) + 0.1 * np.sin(7 * t), -1.2 * np.sin(2 * t) - 4.9 * np.sin(7 * t)
    run = Recorded({"t": t, "q1": q, "tau1": 20 * 9.81 + (20 + 3) * qdd})
    fit = consistent_fit(found(lift, run, folder / "run.csv"), None, WEIGHT)
    assert [fit.standard[name] for name in ("M1", "Ia1")] == pytest.approx([20, 3], rel=0.01)
    assert [fit.standard[f"{stem}1"] for stem in ("XX", "YY", "ZZ")] == pytest.approx([3.6] * 3, rel=0.02)


#: What nothing shows of the second joint's drive train where it stands still.
STILL = ("Ia2", "Fv2", "Fc2", "Off2")


@pytest.mark.parametrize("prior", [None, STANDARD])
def test_what_no_row_shows_is_no_number_that_looks_identified(
    prior: dict[str, float] | None, links: Regressors, folder: Path
) -> None:
    """The second joint stands still, and the rows of dry friction there are left out."""
    t, moving = fourier(links.model.robot, 20.0, 200.0)
    motion = Motion(*(np.array([[1.0], [0.0]]) * one for one in (moving.q, moving.qd, moving.qdd)))
    run = as_recorded(links, t, motion.q, links.torques(grouped(links.model, STANDARD), motion))
    one = found(links, run, folder / "still.csv")
    fit = consistent_fit(one, prior, WEIGHT)
    assert possible(links, fit)
    assert fit.open.unseen == STILL
    assert fit.open.shared == ()
    assert [fit.standard[name] for name in STILL] == [0.0 if prior is None else prior[name] for name in STILL]
    assert fit.train.total.norm < 1.01 * one.full.train.total.norm
    (written,) = (each.values for each in parameter_sets(one, fit) if each.name == CONSISTENT)
    assert "Fv1" in written
    assert written["Fv1"].relative_std is None
    assert written.keys() & set(STILL) == (set() if prior is None else set(STILL))
    assert all(written[name].relative_std == 1e5 for name in written.keys() & set(STILL))
    stated = document(one, fit)["consistent"]
    assert [stated[kind][name]["value"] for kind in ("parameters", "base_parameters") for name in STILL] == [None] * 8
    (note,) = doubts(one, fit)
    told = "without Ia2, Fv2, Fc2 and Off2" if prior is None else "Ia2, Fv2, Fc2 and Off2 from the prior"
    assert note.startswith("the physically consistent set ")
    assert f" {told}: no motion in the data shows " in note


@pytest.mark.parametrize(("offset", "expected"), [(-3.0, (8.5, 8.5)), (-50.0, (0.0, -30.0))])
def test_what_only_sums_show_is_the_smallest_that_makes_them(
    offset: float, expected: tuple[float, float], folder: Path
) -> None:
    """A carriage that never turns back: Coulomb friction, which is not negative, and offset are one."""
    of = regressors("emps")
    t = np.arange(0, 20, 0.002)
    w = 2 * np.pi * 0.2
    q, qd, qdd = 0.1 * t - 0.04 / w * np.cos(w * t) - 1.0, 0.1 + 0.04 * np.sin(w * t), 0.04 * w * np.cos(w * t)
    truth = {"M1R": 95.0, "Fv1": 200.0, "Fc1": 20.0, "Off1": offset}
    tau = of.torques(truth, Motion(*(x[None] for x in (q, qd, qdd))))
    tau += 0.5 * np.random.default_rng(1).normal(size=tau.shape)
    one = found(of, Recorded({"t": t, "q1": q, "tau1": tau[0]}), folder / "onward.csv")
    fit = consistent_fit(one, None, WEIGHT)
    assert set(fit.open.shared) == {"Fc1", "Off1"}
    assert (fit.standard["Fc1"], fit.standard["Off1"]) == pytest.approx(expected, abs=0.2)
    assert fit.standard["Fc1"] >= -1e-6
    assert fit.train.total.norm < 1.01 * one.full.train.total.norm


def test_a_body_of_which_nothing_shows_is_told() -> None:
    of = regressors("emps")
    columns = columns_of_standard(of.model, of.names, np.zeros((3, len(of.names))))
    all_open = left_open(of.model, of.names, columns)
    assert all_open.bodies == (1,)
    assert set(all_open.unseen) == {"Fv1", "Fc1", "Off1"}
    assert told(all_open, dict.fromkeys(all_open.unseen, 0.0), prior=False)[-1].startswith(
        "the physically consistent set has body 1 as a ball: no "
    )
