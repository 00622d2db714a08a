"""A case made: its robot file, its runs, and the truth about it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from benchmarks.diagnosis_study.case import KNOWN, Case, Hidden
from benchmarks.diagnosis_study.prior import drawn, relative
from benchmarks.diagnosis_study.runs import FITTED, MOTIONS, NAMES
from benchmarks.diagnosis_study.sizing import INVISIBLE, NOTHING, Size, mismatch, sized
from tests.plant.effect import Effect
from tests.plant.known_effects import entry
from tests.plant.robot import Robot
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import Run, write_csv
from tests.plant.simulate import make_run, own_effects

#: Part of its law's typical size that an effect beside the hidden ones has.
_BESIDE = 0.2

#: Laws that the plant has in any case, by the effect of the robot file that stands for them.
_SIMPLE = {"viscous": "viscous_friction", "coulomb": "coulomb_friction", "offset": "offset"}


@dataclass(frozen=True)
class Made:
    """``effects`` are the hidden ones as they act; ``sizes`` each by itself on the fitted runs; ``mismatch`` is what
    the laws of the robot file leave unexplained without any hidden effect, in multiples of the noise.
    """

    case: Case
    file: str
    runs: Sequence[Run]
    effects: Sequence[Effect]
    sizes: Sequence[Size]
    mismatch: float

    @property
    def truth(self) -> dict[str, Any]:
        """For JSON."""
        robot = self.runs[0].robot
        return {
            "case": self.case.record(),
            "mismatch": self.mismatch,
            "hidden": [
                {**effect.record(robot), **asdict(size), "invisible": invisible(size)}
                for effect, size in zip(self.effects, self.sizes, strict=True)
            ],
        }

    def write(self, folder: Path) -> None:
        """``robot.yaml``, a file for each run, ``truth.json``."""
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "robot.yaml").write_text(self.file, encoding="utf-8")
        for name, run in zip(NAMES, self.runs, strict=True):
            write_csv(run, folder / f"{name}.csv")
        (folder / "truth.json").write_text(json.dumps(self.truth, indent=2) + "\n", encoding="utf-8")


def invisible(size: Size) -> bool:
    """Whether an effect of that size must be answered as invisible."""
    return size.part < INVISIBLE or size.raw < NOTHING


def made(case: Case) -> Made:
    """Raises OutOfReach where a size cannot be had."""
    robot = ROBOTS[case.robot]
    trajectories = MOTIONS[case.motion](case.seed)
    noise = 1000 * case.seed
    stand_ins, effects, sizes = set(), [], []
    for one in case.hidden:
        stand_ins.add(_place(one, robot))
    typical = [Effect(one.law, one.joint) for one in case.beside]
    more = [one.sized(_BESIDE * one.amount(robot)) for one in typical]
    own = [effect for effect in (*own_effects(robot), *more) if _place(effect, robot) not in stand_ins]
    runs: list[Run] = []
    for one in case.hidden:
        wanted = Effect(one.law, one.joint, other=one.other)
        effect, size, runs = sized(robot, trajectories[:FITTED], own, wanted, one.size, case.mode == KNOWN, noise)
        effects.append(effect)
        sizes.append(size)
    if len(effects) != 1:
        runs = []
    for k, each in enumerate(trajectories[len(runs) :], len(runs)):
        runs.append(make_run(robot, each, effects, seed=noise + k, own=own))
    plain = runs if not effects else [make_run(robot, one, seed=noise, own=own) for one in trajectories[:FITTED]]
    left = mismatch(plain[:FITTED], case.mode == KNOWN)
    return Made(case, file_of(robot, own, case.seed), runs, effects, sizes, left)


def file_of(robot: Robot, own: Sequence[Effect], seed: int) -> str:
    """The robot file with all own effects; its values are wrong by as much as it says.

    What is zero is not in the file: it would be fitted, and stand for what is hidden.
    """
    there = {(effect.law, effect.joint) for effect in own if effect.amount(robot)}
    gone = [(name, j) for law, name in _SIMPLE.items() for j in range(1, robot.joints + 1) if (law, j) not in there]

    def told(name: str, value: float) -> tuple[float, float]:
        return drawn({name: value}, seed)[name], relative(name) if value else 0.0

    return robot_file(robot, gone, [effect for effect in own if effect.law not in _SIMPLE], told)


def _place(effect: Effect | Hidden, robot: Robot) -> tuple[str, int]:
    """What a hidden effect takes the place of: the robot's own one of the same law, or what shares its entry in the
    robot file, on the same joint.
    """
    if effect.law in _SIMPLE:
        return effect.law, effect.joint
    known = entry(Effect(effect.law, effect.joint), robot)
    if known is None:
        return effect.law, effect.joint
    return "balancer" if known.effect.endswith("balancer") else known.effect, effect.joint
