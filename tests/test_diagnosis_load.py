"""Friction that goes with the load, as the diagnosis looks for it."""

from __future__ import annotations

from pathlib import Path

import pytest

from identification.diagnosis.candidates import library
from tests.diagnosed import fitted, known, played
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier

HEAVY = "kr500_like"
WAY = fourier(1, period=10.0, periods=1, before=2.0)


def test_a_rotor_loads_no_gear(tmp_path: Path) -> None:
    """The plant's friction goes with what the gear carries; the robot file knows the rotor's inertia."""
    scene, truth, kept = played(known(ROBOTS[HEAVY], tmp_path), Effect("load_friction", 2, 0.05), WAY)
    (hypothesis,) = (one for one in library.hypotheses([scene]) if (one.effect, one.joint) == ("load_friction", 2))
    tried = {
        shape["rotor"]: fitted(hypothesis.columns(scene, shape), truth, kept, scene) for shape in hypothesis.variants
    }
    (slope,), likeness = tried[max(tried)]
    assert likeness > 0.99
    assert all(less < 0.98 for rotor, (_, less) in tried.items() if rotor < max(tried))
    assert slope == pytest.approx(0.05, rel=0.05)
