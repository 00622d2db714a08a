"""Runs played through generated code: what a robot file's model says to them, beside what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generator.errors import InputError
from generator.generation import Stage, generate, silent
from generator.python_library import build_library, load_library
from generator.symbolic.effect_torques import STATES, WARMTH
from identification.arrays import Array
from identification.diagnosis.runs import stated_elasticity
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.observation import Motion, Regressors
from identification.residuals import Residual, Residuals


class Player:
    """The model of one robot file as code: the generated NumPy functions, or the C in ``folder`` where it is given.

    ``module`` is the generated Python module on the compiled library.
    """

    def __init__(self, regressors: Regressors, folder: Path | None = None, module: Any = None) -> None:
        self.regressors, self.folder, self._module = regressors, folder, module

    def torques(self, values: Mapping[str, float], motion: Motion) -> Array:
        """Joint torques (n x N) [N m, N] along a motion, for values of the base parameters by name, or zero."""
        if self._module is None:
            return self.regressors.torques(values, motion)
        known = {name: value for name, value in values.items() if name in self._module.PARAMETERS}
        robot = self._module.Robot(known)
        signals = [np.ascontiguousarray(one.T) for one in self._signals(motion)]
        if len(signals) == 3 and hasattr(self._module, "filtered"):
            return np.asarray(robot.inverse_dynamics(*signals).T)
        return np.stack([robot.inverse_dynamics(*sample) for sample in zip(*signals, strict=True)], axis=-1)

    def _signals(self, motion: Motion) -> list[Array]:
        """The inputs of the inverse dynamics, one row a number."""
        still = np.zeros((1, motion.samples))
        given = {
            "q": motion.q,
            "qd": motion.qd,
            "qdd": motion.qdd,
            STATES: still if motion.states is None else motion.states,
            WARMTH: np.tile(still, (len(motion.q), 1)) if motion.warmth is None else motion.warmth,
        }
        return [given[one.name] for one in self.regressors.model.functions["inverse_dynamics"].inputs]


def compiled(robot_file: Path, out: Path, regressors: Regressors, stage: Stage = silent) -> tuple[Player, list[str]]:
    """Everything generated from ``robot_file`` into ``out``/ROBOT, its C compiled; and what is to be told.

    ``regressors`` are those of the same robot file. Without a compiler the generated NumPy functions play, and it is
    told. Raises InputError for a bad robot file and a folder that cannot be written.
    """
    folder, manifest = generate(robot_file, out, stage)
    name = manifest["robot"]["name"]
    try:
        with stage("compiling the C"):
            build_library(folder, name)
        return Player(regressors, folder, load_library(folder, name)), []
    except InputError as error:
        note = f"the generated C was not compiled ({error}); the generated NumPy functions play the runs instead"
        return Player(regressors, folder), [note]


@dataclass(frozen=True)
class Played:
    """Rows of a run: times ``t`` (N) [s], ``measured`` and ``model`` torques (n x N) [N m, N], which are ``kept``."""

    t: Array
    measured: Array
    model: Array
    kept: NDArray[np.bool_]

    def part(self, start: int, count: int) -> Played:
        """``count`` rows from number ``start``."""
        rows = slice(start, start + count)
        return Played(self.t[rows], self.measured[:, rows], self.model[:, rows], self.kept[:, rows])

    @property
    def rate(self) -> float:
        """Rows a second [Hz]."""
        return 1 / float(np.median(np.diff(self.t)))

    @property
    def residuals(self) -> Residuals:
        """Of the kept rows, by joint (coordinates from 0)."""
        each = {}
        for k, rows in enumerate(self.kept):
            measured = self.measured[k, rows]
            each[k] = Residual.of(measured - self.model[k, rows], measured)
        return Residuals(each)


def play(one: Prepared, player: Player, values: Mapping[str, float]) -> Played:
    """A run's torques beside the model's along its filtered motion, in the rows that a diagnosis looks at.

    ``values`` are those of the base parameters by name [SI], and of the file's elastic drive trains
    (``stated_elasticity``), which the inverse dynamics of rigid joints leaves out.
    """
    scene = Scene(one.sampled, player.regressors, values)
    model = player.torques(values, scene.motion) + scene.carried(scene.motion) + stated_elasticity.torque(scene)
    return Played(one.t, one.tau, one.decimated(model), one.kept)


def together(played: Sequence[Played]) -> Residuals:
    """The residuals of several played runs, by joint (coordinates from 0)."""
    parts = [one.residuals.per_joint for one in played]
    return Residuals({k: Residual.total(part[k] for part in parts) for k in range(len(played[0].kept))})


def aligned(one: Played, other: Played) -> tuple[Played, Played]:
    """Both over the rows that they have in common and that count in both: a corrected delay moves the ends of a run,
    and an effect that was found leaves out what the other one keeps.
    """
    shift = round(float(other.t[0] - one.t[0]) * one.rate)
    count = min(len(one.t) - max(shift, 0), len(other.t) - max(-shift, 0))
    parts = one.part(max(shift, 0), count), other.part(max(-shift, 0), count)
    kept = parts[0].kept & parts[1].kept
    return replace(parts[0], kept=kept), replace(parts[1], kept=kept)
