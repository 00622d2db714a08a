"""Candidates of the diagnosis that are no effects of the library, against what the simulated robot's own laws add."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import cos, sin

import numpy as np
import pytest
import sympy
from scipy.ndimage import binary_erosion

from generator.resources import find_robot
from generator.robot.description import EffectUse, Signals
from identification.diagnosis.candidates import library
from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SIGNAL, Coefficient, Hypothesis
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.repair import repaired
from identification.recipes import Recipe
from identification.sampling import sampled
from tests.diagnosis.diagnosed import CLEAN, Found, Known, fitted, offered, played, rows, with_robot
from tests.plant.effect import Effect
from tests.plant.trajectories.fourier import fourier

HEAVY, SMALL, SCARA = "kr500_like", "small_wrist", "scara_like"
WAY = fourier(1, period=10.0, periods=1, before=2.0)


#: Robot, law, joint, size; the candidate, its joint, and the coefficients that the law's size is.
LINEAR: Mapping[str, tuple[str, Effect, str, int, Mapping[str, float]]] = {
    "gain": (HEAVY, Effect("torque_gain", 2, -0.1), "torque_gain", 2, {"torque_gain_error2": 1 / 0.9 - 1}),
    "gain of a coupled motor": (
        SMALL,
        Effect("torque_gain", 6, 0.2),
        "torque_gain",
        6,
        {"torque_gain_error6": 1 / 1.2 - 1},
    ),
    "gain of a slide": (SCARA, Effect("torque_gain", 3, -0.1), "torque_gain", 3, {"torque_gain_error3": 1 / 0.9 - 1}),
    "encoder": (HEAVY, Effect("encoder_offset", 2, 0.01), "position_offset", 2, {"position_offset2": -0.01}),
    "encoder of a wrist": (HEAVY, Effect("encoder_offset", 5, 0.03), "position_offset", 5, {"position_offset5": -0.03}),
    "ratio": (HEAVY, Effect("gear_ratio", 2, 0.01), "gear_ratio", 2, {"gear_ratio_error2": 0.01}),
    "ratio of a coupled motor": (SMALL, Effect("gear_ratio", 5, 0.01), "gear_ratio", 5, {"gear_ratio_error5": 0.01}),
    "ratio of a slide": (SCARA, Effect("gear_ratio", 3, 0.01), "gear_ratio", 3, {"gear_ratio_error3": 0.01}),
    "delay": (HEAVY, Effect("delay", 1, 3e-3), "torque_delay", 0, {"torque_delay": -3e-3}),
    "tilt": (
        HEAVY,
        Effect("base_tilt", 1, 0.01),
        "base_tilt",
        0,
        {"tilt_x": 0.01 * cos(0.6), "tilt_y": 0.01 * sin(0.6)},
    ),
    "tilt under parallel axes": (
        SCARA,
        Effect("base_tilt", 1, 0.02),
        "base_tilt",
        0,
        {"tilt_x": 0.02 * cos(0.6), "tilt_y": 0.02 * sin(0.6)},
    ),
    "payload": (HEAVY, Effect("payload", 1, 30.0), "payload", 0, {"M": 30.0, "MX": 1.2, "MY": -0.6, "MZ": 1.5}),
    "payload on a slide": (SCARA, Effect("payload", 1, 0.5), "payload", 0, {"M": 0.5}),
    "rotor of two joints": (SMALL, Effect("wrist_inertia", 6, 0.01), "coupled_rotor", 6, {"Iar6": 0.01}),
    "friction of two joints": (
        SMALL,
        Effect("wrist_friction", 6, 0.5),
        "coupled_rotor",
        6,
        {"Fcr6": 0.5, "Fvr6": 0.5 / (0.8 * 7.0)},
    ),
}


@pytest.mark.parametrize("case", LINEAR)
def test_columns_are_what_the_law_adds(case: str, known_robots: Callable[[str], Known]) -> None:
    name, effect, candidate, joint, expected = LINEAR[case]
    scene, truth, kept = played(known_robots(name), effect, WAY)
    (hypothesis,) = [
        one for one in offered([scene], candidate, joint) if one.given.get("ratio", 1.0) == pytest.approx(1.0)
    ]
    columns = hypothesis.columns(scene, hypothesis.variants[0])
    x, likeness = fitted(columns, truth, kept, scene)
    found = dict(zip([one.name for one in hypothesis.coefficients], x, strict=True))
    assert likeness > 0.99
    for key, value in expected.items():
        assert found[key] == pytest.approx(value, rel=0.05), key
        (coefficient,) = [one for one in hypothesis.coefficients if one.name == key]
        assert coefficient.lower is None or coefficient.lower <= value
        assert coefficient.upper is None or value <= coefficient.upper


def test_what_the_first_joint_alone_shows_is_no_tilt(known_robots: Callable[[str], Known]) -> None:
    told = []
    for effect in (Effect("soft_stop", 1, 3.0), Effect("base_tilt", 1, 0.02)):
        scene, truth, kept = played(known_robots(SCARA), effect, WAY)
        (tilt,) = offered([scene], "base_tilt", 0)
        columns = tilt.columns(scene, {})
        assert [one.name for one in tilt.coefficients if one.essential] == ["tilt_x", "tilt_y"]
        products = [k for k, one in enumerate(tilt.coefficients) if not one.essential]
        told.append([fitted(one, truth, kept, scene)[1] for one in (columns, columns[products])])
    (stop, of_products), (lean, less) = told
    assert stop > 0.7
    assert stop - of_products < 0.1 * (lean - less)


#: Robot, law, joint, size; the candidate, its joint, the coefficient and what the size is of it.
LARGE: Mapping[str, tuple[str, Effect, str, int, str, float]] = {
    "encoder": (HEAVY, Effect("encoder_offset", 3, 0.2), "position_offset", 3, "position_offset3", -0.2),
    "ratio": (HEAVY, Effect("gear_ratio", 2, 0.1), "gear_ratio", 2, "gear_ratio_error2", 0.1),
    "delay": (HEAVY, Effect("delay", 1, 0.03), "torque_delay", 0, "torque_delay", -0.03),
}


@pytest.mark.parametrize("case", LARGE)
def test_what_is_large_is_exact_about_what_was_found(case: str, known_robots: Callable[[str], Known]) -> None:
    name, effect, candidate, joint, key, value = LARGE[case]
    scene, truth, kept = played(known_robots(name), effect, WAY)
    # A joint of a late log stands in other rows than the logged one.
    kept = binary_erosion(kept, np.ones((1, 5)))
    (hypothesis,) = offered([scene], candidate, joint)
    _, first = fitted(hypothesis.columns(scene, {}), truth, kept, scene)
    near = replace(scene, beside=Found({key: 0.9 * value}))
    x, second = fitted(hypothesis.columns(near, {}), truth, kept, near)
    again = replace(scene, beside=Found({key: float(x[0])}))
    (last,), third = fitted(hypothesis.columns(again, {}), truth, kept, again)
    assert last == pytest.approx(value, rel=0.01)
    # What the rows tell by themselves is right before anything was found.
    exact = 1e-3 if hypothesis.preset else 0.0
    assert 1 - third < max(0.1 * (1 - first), exact)
    assert 1 - second < max(0.3 * (1 - first), exact)


def test_effects_that_were_found_act_in_what_depends_on_the_torque(known_robots: Callable[[str], Known]) -> None:
    """A payload loads the transmissions, and is late as the rest of the torque is."""
    scene, truth, _ = played(known_robots(HEAVY), Effect("payload", 1, 30.0), WAY)
    (payload,) = offered([scene], "payload", 0)
    acts = [j for j in range(6) if np.abs(payload.columns(scene, {})[:, j]).any()]
    every = tuple(range(len(payload.coefficients)))
    variant = Variant(payload, {}, every, tuple(acts), every)
    x, _ = fitted(payload.columns(scene, {}), truth, np.ones_like(rows(truth), dtype=bool), scene)
    acting = Acting((variant,), tuple(x.tolist()))
    loaded = replace(scene, beside=acting)
    assert np.linalg.norm(loaded.torque - scene.torque - truth) < 0.02 * np.linalg.norm(truth)
    assert loaded.load - scene.load == pytest.approx(x @ payload.columns(scene, {}).transpose(1, 0, 2))


def test_what_sits_on_the_drive_loads_no_transmission(known_robots: Callable[[str], Known]) -> None:
    scene, _, _ = played(known_robots(HEAVY), Effect("payload", 1, 30.0), WAY)
    drive, link = (
        Hypothesis(name, name, 2, (Coefficient("c", "N m"),), lambda scene, shape: np.ones((1, *scene.motion.q.shape)))
        for name in ("viscous_friction", "cable_spring")
    )
    for hypothesis, load in ((drive, 0.0), (link, 5.0)):
        acting = Acting((Variant(hypothesis, {}, (0,), (1,), (0,)),), (5.0,))
        acted = replace(scene, beside=acting)
        assert acted.torque - scene.torque == pytest.approx(5.0)
        assert acted.load - scene.load == pytest.approx(load)


def test_friction_by_bristles_needs_no_damping_of_theirs(known_robots: Callable[[str], Known]) -> None:
    scene, _, _ = played(known_robots(HEAVY), Effect("presliding_lugre", 2, 50.0), WAY)
    (lugre,) = offered([scene], "lugre_friction", 2)
    assert {one.name: one.refines for one in lugre.coefficients} == {"Fz2": False, "Dz2": True}


@pytest.mark.parametrize(("way", "least"), [("time since the start", 0.99), ("motor's heat", 0.999)])
def test_a_torque_constant_drifts(way: str, least: float, known_robots: Callable[[str], Known]) -> None:
    """The plant's winding is heated by the current and so does not warm up by an exponential alone."""
    effect = Effect("torque_constant_drift", 2, 0.1)
    scene, truth, kept = played(known_robots(HEAVY), effect, fourier(1, period=10.0, periods=4, before=0.0))
    (hypothesis,) = [one for one in offered([scene], "torque_drift", 2) if way in one.title]
    tried = [fitted(hypothesis.columns(scene, shape), truth, kept, scene) for shape in hypothesis.variants]
    (drift, start), likeness = max(tried, key=lambda one: one[1])
    assert likeness > least
    assert drift < 0
    assert abs(start) < 0.2 * abs(drift)


def test_drift_by_a_temperature(known_robots: Callable[[str], Known]) -> None:
    """Where the run has one the candidate is offered with it, by its rise since the recording began, 1 at the end."""
    sensors = replace(CLEAN, temperature=True)
    scene, _, _ = played(known_robots(SCARA), Effect("torque_constant_drift", 1, 0.1), WAY, sensors)
    by_time, _, by_temperature = offered([scene], "torque_drift", 1)
    assert "warm_up_time" in {shape.name for shape in by_time.shapes}
    (shape,) = by_temperature.variants
    changing, own = by_temperature.columns(scene, shape)
    run, first = scene.sampled.run, scene.sampled.filters.first
    rise = run.others["temp1"][first : first + scene.motion.samples] - run.others["temp1"][0]
    np.testing.assert_allclose(changing[0] / own[0], rise / shape["warm_rise"], atol=1e-12)
    assert rise.max() == pytest.approx(shape["warm_rise"])


def test_a_drive_is_as_warm_as_its_recording_has_made_it(known_robots: Callable[[str], Known]) -> None:
    """A part of a long recording goes on where the one before it ended, whatever the clock begins with."""
    first, _, _ = played(known_robots(SCARA), Effect("offset", 1, 0.0), WAY)
    run = first.sampled.run
    part = replace(run, start=1e6 + 20.0, began={"t": 1e6})
    later = replace(first, sampled=replace(first.sampled, run=part))
    t = later.sampled.times - 1e6
    assert 20 < t[0] < t[-1] < 33
    (friction,) = offered([first, later], "warm_friction", 1)
    shape = friction.variants[0]
    viscous, _, all_along, _ = friction.columns(later, shape)
    np.testing.assert_allclose(viscous[0], (1 - np.exp(-t / shape["warm_up_time"])) * later.motion.qd[0], atol=1e-9)
    np.testing.assert_allclose(all_along[0], later.motion.qd[0], atol=1e-9)
    drift, _ = offered([first, later], "torque_drift", 1)
    changing, own = drift.columns(later, {"warm_up_time": 30.0})
    np.testing.assert_allclose(changing[0], (1 - np.exp(-t / 30.0)) * own[0], atol=1e-9)
    # One part alone is about as warm at its end as at its beginning.
    assert not offered([later], "warm_friction", 1)


def test_the_files_word_on_the_warmth_counts(known_robots: Callable[[str], Known]) -> None:
    scene, _, _ = played(known_robots(SCARA), Effect("offset", 1, 0.0), WAY)
    told = np.linspace(0.1, 0.6, scene.motion.samples) * np.ones((scene.motion.q.shape[0], 1))
    stated = replace(scene, sampled=replace(scene.sampled, motion=replace(scene.motion, warmth=told)))
    (friction,), (drift,) = offered([stated], "warm_friction", 1), offered([stated], "torque_drift", 1)
    assert friction.variants == drift.variants == [{}]
    np.testing.assert_allclose(friction.columns(stated, {})[0, 0], told[0] * scene.motion.qd[0], atol=1e-12)
    changing, own = drift.columns(stated, {})
    np.testing.assert_allclose(changing[0], told[0] * own[0], atol=1e-12)


@pytest.mark.parametrize(("name", "effect"), [(SMALL, Effect("current_saturation", 1, 0.7))])
def test_current_beyond_a_limit_is_missing(name: str, effect: Effect, known_robots: Callable[[str], Known]) -> None:
    robot = known_robots(name)
    scene, truth, kept = played(robot, effect, WAY)
    (hypothesis,) = offered([scene], "current_limit", effect.joint)
    limit = robot.robot.chain[effect.joint - 1].peak * (1 - effect.amount(robot.robot))
    (shape,) = hypothesis.shapes
    assert shape.low < limit < shape.high
    (share,), likeness = fitted(hypothesis.columns(scene, {"current_limit": limit}), truth, kept, scene)
    assert likeness > 0.99
    assert share == pytest.approx(1.0, abs=0.05)
    tried = [fitted(hypothesis.columns(scene, shape), truth, kept, scene)[1] for shape in hypothesis.variants]
    assert max(tried) > 0.97


def test_a_joint_that_stands_still_has_no_law_of_its_own(known_robots: Callable[[str], Known]) -> None:
    """Its shapes would be parts of no speed and no range; what it does to other joints' torques is offered."""
    scene, _, _ = played(known_robots(HEAVY), Effect("offset", 1, 0.0), WAY)
    run = scene.sampled.run
    q = run.q.copy()
    q[3] = 0.1 + 0.2
    recipe = Recipe().changed(cutoff=50.0, factor=1, standstill=0.0)
    locked = replace(scene, sampled=sampled(replace(run, q=q), recipe, scene.regressors))
    assert not locked.moves(3)
    assert 4 not in {one.joint for one in library.hypotheses([locked])}
    assert ("dahl_friction", 4) in {(one.effect, one.joint) for one in library.hypotheses([locked, scene])}
    for effect in ("position_offset", "torque_gain"):
        (one,) = offered([locked], effect, 4)
        assert np.all(np.isfinite(one.columns(locked, {}))), effect


def test_gains_of_other_conventions_are_possible(known_robots: Callable[[str], Known]) -> None:
    """Peak current for rms, one motor of two; a robot file takes every gain that may be found."""
    scene, _, _ = played(known_robots(HEAVY), Effect("offset", 1, 0.0), WAY)
    unsettled = replace(scene, settled=False)
    acting = replace(unsettled, beside=Found({"torque_gain_error2": -0.4}))
    (first,), (error,), (again,) = (
        one.coefficients for each in (unsettled, scene, acting) for one in offered([each], "torque_gain", 2)
    )
    assert again == error
    assert error.lower is not None
    assert error.upper is not None
    for recorded in (0.5, 2.0):
        assert error.lower < recorded - 1 < error.upper
    # A model that was fitted to the recorded torque is as much too small.
    assert first.lower == pytest.approx(error.lower / (1 + error.lower))
    for bound in (error.lower, error.upper):
        found = Addition(SIGNAL, "torque_gain", (2,), values={"torque_gain": 1 / (1 + bound)})
        repaired(find_robot("kr500").read_text(encoding="utf-8"), "kr500.yaml", [found])


def test_what_the_file_corrects_is_not_offered(known_robots: Callable[[str], Known]) -> None:
    """Nor a second rotor on a joint that has one; what may be stated wrongly is, beyond what the file states."""
    scene, _, _ = played(known_robots(HEAVY), Effect("offset", 1, 0.0), WAY)
    robot, n = scene.robot, len(scene.robot.moving)
    one = [sympy.Integer(int(k == 1)) for k in range(n)]
    gains = tuple(sympy.Integer(1 + int(k == 1)) for k in range(n))
    signals = Signals(tuple(one), gains, tuple(one), (), tuple(sympy.Integer(9) for _ in range(n)))
    changed = replace(robot, signals=signals)
    assert offered([scene], "current_limit", 2)
    assert not offered([with_robot(scene, changed)], "current_limit", 2)
    for candidate in ("position_offset", "torque_gain"):
        for joint, stated in ((1, False), (2, True)):
            titles = [one.title for one in offered([with_robot(scene, changed)], candidate, joint)]
            assert titles, candidate
            assert all(title.endswith("beyond the stated one") == stated for title in titles), titles
    assert offered([with_robot(scene, changed)], "torque_delay", 1)
    unlimited = replace(signals, current_limit=tuple(sympy.Integer(9 if k == 1 else 10**6) for k in range(n)))
    limited = with_robot(scene, replace(robot, signals=unlimited))
    assert offered([limited], "current_limit", 1)
    assert not offered([limited], "current_limit", 2)
    assert offered([scene], "coupled_rotor", 6)
    there = replace(robot, effects=(*robot.effects, EffectUse("coupled_rotor", (6,))))
    assert not offered([with_robot(scene, there)], "coupled_rotor", 6)
