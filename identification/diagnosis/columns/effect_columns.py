"""Torque per unit of an effect's parameters along a run, from the effect's own equations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import sympy
from scipy.integrate import cumulative_trapezoid

from generator.effects.effect import Effect, Shape, Site
from generator.robot.description import Joint, Robot
from identification.arrays import Array
from identification.diagnosis.columns.state_steps import Steps, steps
from identification.diagnosis.runs.scene import Scene
from identification.effect_states import beginning

#: What columns may be made of here.
NEEDS = frozenset({"q", "qd", "qdd", "motor", "load", "warmth", "state"})
#: Steps a second in which states are integrated.
_STEPS = 500.0
#: Positions over a joint's limits at which lengths are looked at that must be positive.
_STEPS_OVER = 200


class EffectColumns:
    """``effect`` on ``joint``, coordinate ``k``; called with a scene and a shape it gives its columns (p x n x N).

    The drives are as warm as the robot's file says, or by ``warm_up_time`` [s] of the shape.
    """

    def __init__(self, effect: Effect, joint: Joint, k: int, robot: Robot) -> None:
        self._k, self._numbers = k, [one.number for one in robot.moving]
        values = {shape.name: _symbol(shape) for shape in effect.shapes}
        self._names = list(values)
        self._site = Site(joint, values, _ratios(robot, k) if "motor" in effect.needs else {})
        self._effect = effect
        self._function: Callable[..., Any] | None = None
        self._steps: Steps | None = None

    def from_the_start(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        """Columns (2 p x n x N), and once more those of drives that are warm all along: what a file's values, which are
        of another warmth than that at the start, lack everywhere.
        """
        return np.concatenate([self(scene, shape), self(scene, shape, warm=True)])

    def __call__(self, scene: Scene, shape: Mapping[str, float], warm: bool = False) -> Array:
        """Columns at the recorded rate; not a number where the shape is impossible along the run, or over the joint's
        limits in the robot's file, or leaves less room than a machine has.
        """
        return self._made(scene, shape, warm, None)

    def of_beginning(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        """What they hold (p x n x N) of how the effect's state began, which no record tells: the way from one end of
        its range to the other.
        """
        first, last = (self._made(scene, shape, False, start) for start in (-1.0, 1.0))
        return last - first

    def _made(self, scene: Scene, shape: Mapping[str, float], warm: bool, start: float | None) -> Array:
        if self._function is None:
            self._prepare()
        assert self._function is not None
        values = [shape[name] for name in self._names]
        states = [] if self._steps is None else self._states(scene, values, start)
        signals = self._signals(scene, shape.get("warm_up_time"), warm)
        motion = scene.motion
        result = np.zeros((len(self._effect.parameters), len(self._numbers), motion.samples))
        anywhere = self._anywhere(motion.q[self._k])
        if any(np.min(left(*values, anywhere)) < one.room * shape[one.value] for one, left in self._positive):
            return np.full_like(result, np.nan)
        with np.errstate(invalid="ignore", over="ignore"):
            found = self._function(*values, *signals, *states)
        for (p, j), torque in zip(self._places, found, strict=True):
            result[p, j] = torque
        return result

    def _prepare(self) -> None:
        at, effect = self._site, self._effect
        columns = effect.columns(at)
        self._places = [(p, self._numbers.index(j)) for p, column in enumerate(columns) for j in column]
        torques = [torque for column in columns for torque in column.values()]
        inputs = [
            *(at.values[name] for name in self._names),
            *(sympy.Symbol(f"{stem}{number}", real=True) for stem in ("q", "qd", "qdd") for number in self._numbers),
            at.load,
            at.warmth,
        ]
        states = [at.state(one.stem) for one in effect.states]
        self._function = sympy.lambdify([*inputs, *states], torques, "numpy", cse=True)
        lengths = () if effect.positive is None else effect.positive(at)
        given = [*(at.values[name] for name in self._names), at.q]
        self._positive = [(one, sympy.lambdify(given, one.length, "numpy")) for one in lengths]
        if effect.rates is not None:
            self._steps = steps(effect.rates(at)[0], states[0], at.qd, [at.values[name] for name in self._names])

    def _anywhere(self, q: Array) -> Array:
        """Positions of a run, and all that the robot's file allows."""
        lower, upper = self._site.joint.lower, self._site.joint.upper
        if lower is None or upper is None:
            return q
        return np.append(q, np.linspace(float(lower), float(upper), _STEPS_OVER))

    def _signals(self, scene: Scene, warm_up_time: float | None, warm: bool) -> list[Array]:
        motion = scene.motion
        known = "warmth" in self._effect.needs and not warm
        warmth = scene.warmth(self._k, warm_up_time) if known else np.ones(1)
        load = scene.load[self._k] if "load" in self._effect.needs else np.zeros(1)
        return [*motion.q, *motion.qd, *motion.qdd, load, warmth]

    def _states(self, scene: Scene, values: list[float], start: float | None) -> list[Array]:
        """The effect's state along a scene since the run's ``start``, if that is not told as a file's own effect has it
        (``effect_states``).
        """
        stride = max(1, int(1 / (scene.period * _STEPS)))
        head = scene.sampled.head[self._k]
        qd = np.concatenate([head, scene.motion.qd[self._k]])
        # Means over the steps: what is worn in is a matter of the way.
        way = cumulative_trapezoid(qd, initial=0)[::stride]
        speed = np.append(np.diff(way) / stride, qd[-1])
        count = len(speed)
        assert self._steps is not None
        begun = float(beginning(qd)) if start is None else start
        z = self._steps(speed, values, stride * scene.period, begun)
        return [np.interp(np.arange(len(head), len(qd)), np.arange(count) * stride, z)]


def _symbol(shape: Shape) -> sympy.Symbol:
    signed = shape.lower is None or shape.lower < 0
    return sympy.Symbol(f"shape_{shape.name}", **({"real": True} if signed else {"positive": True}))


def _ratios(robot: Robot, k: int) -> dict[int, sympy.Expr]:
    assert robot.drives is not None
    pairs = zip(robot.moving, robot.drives.coupling[k], strict=True)
    return {other.number: ratio for other, ratio in pairs if ratio != 0}
