"""Friction that goes with the load, as the diagnosis looks for it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.candidates import library, wrist
from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.diagnosis import NAMED, NOTHING
from identification.diagnosis.mending.addition import addition
from tests.diagnosis import diagnosed_arm
from tests.diagnosis.diagnosed import fitted, known, played
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier
from tests.recorded import Array

HEAVY = "kr500_like"
#: An arm without weight whose file states friction by load.
LOADED = diagnosed_arm.ARM.replace("-9.81 m/s2", "0 m/s2") + "  - {effect: load_friction, joint: 1}\n"
FRICTION, STIFFNESS = 0.15, 30.0
WAY = fourier(1, period=10.0, periods=1, before=2.0)


def test_a_rotor_loads_no_gear(tmp_path: Path) -> None:
    """The plant's friction goes with what the gear carries; the robot file knows the rotor's inertia."""
    scene, truth, kept = played(known(ROBOTS[HEAVY], tmp_path), Effect("load_friction", 2, 0.05), WAY)
    (hypothesis,) = (one for one in library.hypotheses([scene]) if one.key == ("load_friction", 2))
    tried = {
        shape["rotor"]: fitted(hypothesis.columns(scene, shape), truth, kept, scene) for shape in hypothesis.variants
    }
    (slope,), likeness = tried[max(tried)]
    assert likeness > 0.99
    assert all(less < 0.98 for rotor, (_, less) in tried.items() if rotor < max(tried))
    assert slope == pytest.approx(0.05, rel=0.05)


def test_of_a_rotor_that_two_joints_turn_its_inertia_loads_the_drives(tmp_path: Path) -> None:
    scene, _, _ = played(known(ROBOTS["small_wrist"], tmp_path), Effect("wrist_inertia", 6, 0.01), WAY)
    rotor = next(one for one in wrist.hypotheses([scene]) if one.joint == 6)
    shape = rotor.variants[0]
    columns = rotor.columns(scene, shape)
    names = [one.name for one in rotor.coefficients]
    acting = Acting((Variant(rotor, shape, (0, 1, 2), (4, 5), (0, 1, 2)),), (0.01, 0.5, 0.7))
    beside = replace(scene, beside=acting)
    assert names[0].startswith("Iar")
    assert beside.load - scene.load == pytest.approx(0.01 * columns[0])


def test_what_loads_nothing_is_no_value_of_the_file(tmp_path: Path) -> None:
    """Where no rotor is known none is written: a file may hold one that is more than nothing."""
    scene, _, _ = played(known(ROBOTS[HEAVY], tmp_path), Effect("load_friction", 2, 0.05), WAY)
    (hypothesis,) = (one for one in library.hypotheses([scene]) if one.key == ("load_friction", 2))
    assert addition(hypothesis, {"rotor": 0.0}, {"Fl2": 0.05}).values == {}
    assert addition(hypothesis, {"rotor": 6.0}, {"Fl2": 0.05}).values == {"rotor": 6.0}


def test_a_hysteresis_begins_from_standing_still(tmp_path: Path) -> None:
    scene, _, _ = played(known(ROBOTS[HEAVY], tmp_path), Effect("hysteresis", 2), WAY)
    motion = scene.motion
    speed = motion.qd.copy()
    speed[:, :100] = 0.0
    standing = replace(scene, sampled=replace(scene.sampled, motion=replace(motion, qd=speed)))
    (hypothesis,) = (one for one in library.hypotheses([scene]) if one.key == ("hysteresis", 2))
    columns = hypothesis.columns(standing, hypothesis.variants[0])
    assert np.isfinite(columns).all()
    assert np.abs(columns).max() > 0.1


@pytest.mark.parametrize("sprung", [False, True])
def test_stated_friction_is_under_the_load_that_was_found(sprung: bool, tmp_path: Path) -> None:
    """What pulls at the link loads its drive, whether the file knows it or not."""
    stiffness = STIFFNESS if sprung else 0.0
    truth = {name: diagnosed_arm.TRUTH[name] for name in ("ZZ1", "Fv1", "Fc1", "Off1")}

    def hidden(q: Array, qd: Array) -> Array:
        # Gradients over samples of 0.01 s are the accelerations that load the drive.
        load = truth["ZZ1"] * np.gradient(qd, 0.01) + truth["Off1"] + stiffness * q
        return np.asarray(stiffness * q + FRICTION * np.sign(qd) * np.abs(load))

    regressors, sources = diagnosed_arm.recorded(tmp_path, [hidden] * 3, LOADED, truth)
    found = diagnosed_arm.diagnosis_of(sources, regressors)
    assert found.verdict == (NAMED if sprung else NOTHING)
    assert [one.hypothesis.effect for one in found.findings] == ["joint_spring"] * sprung
    assert found.search.values["Fl1"] == pytest.approx(FRICTION, rel=0.1)
