"""A residual that follows how another joint moves is told so; one that its own motion orders is not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import UNEXPLAINED
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, Array, as_recorded, fourier, two_links

#: Of the motion, which repeats [s], and of a run; rms of the noise [N m].
PERIOD, SECONDS, NOISE = 10.0, 40.0, 0.3


def dragged(q: Array, qd: Array) -> Array:
    """What joint 2 feels of how fast joint 1 turns, whichever way it turns itself [N m]."""
    return np.asarray(4.0 * np.tanh(qd[0] / 0.3))


def bump(q: Array, qd: Array) -> Array:
    """What joint 2 feels at one place of its own range [N m]."""
    return np.asarray(4.0 * np.exp(-(((q[1] - np.median(q[1])) / 0.05) ** 2)))


def sources(folder: Path, hidden: Callable[[Array, Array], Array], held: float | None = None) -> list[str]:
    """Three runs' files; ``held`` is where joint 2 stands [rad], None where it moves."""
    regressors, draw, files = two_links(folder), np.random.default_rng(11), []
    for seed in (1, 2, 3):
        t, motion = fourier(regressors.model.robot, SECONDS, 250.0, seed, 1 / PERIOD)
        q, qd, qdd = motion.signals
        if held is not None:
            q[1], qd[1], qdd[1] = held, 0.0, 0.0
        tau = regressors.torques(TRUTH, motion)
        tau[1] += hidden(q, qd)
        tau += NOISE * draw.normal(size=tau.shape)
        files.append(str(as_recorded(regressors, t, q, tau).save(folder / f"{seed}.csv")))
    return files


@pytest.mark.long
@pytest.mark.parametrize(("hidden", "told"), [(dragged, True), (bump, False)])
def test_only_what_follows_another_joint_is_told_so(
    hidden: Callable[[Array, Array], Array], told: bool, tmp_path: Path
) -> None:
    files = sources(tmp_path, hidden)
    request = Request(files[:2], test=files[2:])
    found, _ = answered(tmp_path / "two_links.yaml", request, tmp_path / "out")
    assert (found.verdict, found.after.joint) == (UNEXPLAINED, 2)
    notes = [note for note in found.notes if "of what is left of joint 2 follows the" in note]
    assert [note.endswith("the speed of joint 1") for note in notes] == [True] * told


def test_a_joint_that_stands_has_no_rows_to_look_at(tmp_path: Path) -> None:
    files = sources(tmp_path, lambda q, qd: np.zeros_like(q[1]), held=0.3)
    found, _ = answered(tmp_path / "two_links.yaml", Request(files, dry=True), tmp_path / "out")
    assert found.before.views[2] == ()
    assert found.before.views[1]
