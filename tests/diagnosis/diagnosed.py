"""Scenes of the diagnosis from runs of the simulated robot, whose model is right but for one effect."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from generator.discovery import modules
from generator.errors import Place
from generator.robot.description import Robot as Described
from generator.robot.readers import read
from identification.dataset import Run as Recorded
from identification.diagnosis import candidates
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.filtering import decimated, flat_derivative, kept_indices
from identification.observation import Regressors
from identification.recipes import Recipe
from identification.sampling import sampled
from tests.plant.effect import Effect
from tests.plant.measurement import Sensors
from tests.plant.robot import Array, Robot
from tests.plant.robot_file import PRIOR, robot_file
from tests.plant.run import Run
from tests.plant.simulate import make_run, own_effects
from tests.plant.size import effect_torque
from tests.plant.trajectory import Trajectory

#: No noise, no steps: what is left between log and model is the effect.
CLEAN = Sensors(noise=0.0, quantised=False)
#: Cut-off of the motion's filter [Hz], decimation of its rows, and speed below which a joint stands, in its rms.
CUTOFF, FACTOR, SLOW = 50.0, 10, 0.04
#: Where a candidate stands that is not called as its module.
_MODULES = {
    "coupled_rotor": "wrist",
    "joint_elasticity": "elasticity",
    "warm_friction": "library",
    "load_friction": "library",
    "lugre_friction": "library",
}


@dataclass(frozen=True)
class Known:
    """A simulated robot and its model with the true base parameters."""

    robot: Robot
    regressors: Regressors
    values: dict[str, float]

    def scene(self, run: Run) -> Scene:
        """A run beside the model."""
        others: dict[str, Array] = {}
        for stem, block in (("qs", run.qs), ("temp", run.temperature)):
            if block is not None:
                others |= {f"{stem}{j + 1}": column for j, column in enumerate(block.T)}
        recorded = Recorded("run", Place("run"), 0.0, 1 / run.rate, run.q.T, run.tau.T, by_motors=True, others=others)
        one = sampled(
            recorded, Recipe().changed(cutoff=CUTOFF, factor=1, standstill=0.0), self.regressors, flat_derivative
        )
        return Scene(one, self.regressors, self.values)


def known(robot: Robot, folder: Path) -> Known:
    """The robot by its file, with true values; a wrist has no coupled rotor."""
    path = folder / f"{robot.name}.yaml"
    path.write_text(robot_file(robot, leave_out={"coupled_rotor"}), encoding="utf-8")
    description = read(path)
    regressors = Regressors(description)
    standard = {name: one.value for name, one in description.parameter_sets[PRIOR].values.items()}
    numeric = regressors.model.grouping.numeric()
    values = {
        name: sum(coefficient * standard.get(part, 0.0) for part, coefficient in terms.items())
        for name, terms in numeric.items()
    }
    return Known(robot, regressors, values)


def played(
    robot: Known, effect: Effect, trajectory: Trajectory, sensors: Sensors = CLEAN
) -> tuple[Scene, Array, NDArray[np.bool_]]:
    """A run with an effect beside what the robot's file has: its scene, what the effect adds to the logged torque
    (n x N), and rows that count (n x M, ``decimated``): those in whose window the joint moves.
    """
    own = [one for one in own_effects(robot.robot) if not one.law.startswith("wrist")]
    run = make_run(robot.robot, trajectory, [effect], sensors=sensors, own=own)
    scene = robot.scene(run)
    first = scene.sampled.filters.first
    truth = effect_torque(run, effect).T[:, first : first + scene.motion.samples]
    speed = np.abs(scene.motion.qd)
    standing = speed < SLOW * np.sqrt(np.mean(speed**2, axis=1, keepdims=True))
    windows = np.apply_along_axis(np.convolve, 1, standing.astype(float), np.ones(2 * FACTOR + 1), "same")
    return scene, truth, windows[:, kept_indices(scene.motion.samples, FACTOR)] < 0.5


def offered(scenes: Sequence[Scene], effect: str, joint: int) -> list[Hypothesis]:
    """What the modules but the library's offer, without looking for swings where they are not asked for."""
    own = [module for module in modules(candidates) if module.__name__.endswith(f".{_MODULES.get(effect, effect)}")]
    found = [one for module in own for one in module.hypotheses(scenes)]
    return [one for one in found if one.effect == effect and one.joint == joint]


def rows(x: Array) -> Array:
    """Signals (... x N) as a diagnosis looks at them."""
    return decimated(x, FACTOR)


def fitted(columns: Array, truth: Array, kept: Array, scene: Scene) -> tuple[Array, float]:
    """Coefficients that make the truth, and the cosine between the two (zeros: 0); joints by their torque."""
    scale = np.sqrt(np.mean(scene.torque**2, axis=1, keepdims=True))
    A = rows(columns / scale)[:, kept].T
    y = rows(truth / scale)[kept]
    x = np.linalg.lstsq(A, y, rcond=None)[0]
    fit = A @ x
    return x, float(fit @ y / (np.linalg.norm(fit) * np.linalg.norm(y))) if fit.any() else 0.0


def with_robot(scene: Scene, robot: Described) -> Scene:
    """The scene of a robot that says more of itself."""
    return replace(scene, regressors=scene.regressors.described(robot))


@dataclass(frozen=True)
class Found:
    """Coefficients that a search has found, none of them a torque of its own."""

    coefficients: Mapping[str, float]

    def torque(self, scene: Scene) -> Array:
        return np.zeros_like(scene.motion.q)

    load = torque
