"""Torque per unit of an effect's parameters along a run, from the effect's own equations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import expm1
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.effects.effect import Effect, Site
from generator.robot.description import Joint, Robot
from identification.diagnosis.scene import Scene

Array = NDArray[np.float64]

#: What columns may be made of here.
NEEDS = frozenset({"q", "qd", "qdd", "motor", "load", "warmth", "state"})
#: Steps a second in which states are integrated.
_STEPS = 250.0


class EffectColumns:
    """``effect`` on ``joint``, coordinate ``k``; called with a scene and a shape it gives its columns (p x n x N).

    The drives are as warm as the robot's file says, or by ``warm_up_time`` [s] of the shape.
    """

    def __init__(self, effect: Effect, joint: Joint, k: int, robot: Robot) -> None:
        self._k, self._numbers = k, [one.number for one in robot.moving]
        values = {shape.name: sympy.Symbol(f"shape_{shape.name}", positive=True) for shape in effect.shapes}
        if "neutral" in values or "phi" in values:
            values |= {n: sympy.Symbol(f"shape_{n}", real=True) for n in ("neutral", "phi") if n in values}
        self._names = list(values)
        self._site = Site(joint, values, _ratios(robot, k) if "motor" in effect.needs else {})
        self._effect = effect
        self._function: Callable[..., Any] | None = None
        self._rates: Callable[..., Any] | None = None

    def __call__(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        """Columns at the recorded rate; not a number where the shape is impossible along the run."""
        if self._function is None:
            self._prepare()
        assert self._function is not None
        values = [shape[name] for name in self._names]
        states = [] if self._rates is None else self._states(scene, values)
        signals = self._signals(scene, shape.get("warm_up_time"))
        motion = scene.motion
        result = np.zeros((len(self._effect.parameters), len(self._numbers), motion.samples))
        if self._positive is not None and np.min(self._positive(*values, *signals)) <= 0:
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
        self._positive = None
        if effect.positive is not None:
            self._positive = sympy.lambdify(inputs, next(iter(effect.positive(at).values())), "numpy")
        if effect.rates is not None:
            (rate,), (state,) = effect.rates(at), states
            slope = sympy.diff(rate, state).subs(sympy.Derivative(sympy.sign(state), state), 0)
            slope = slope.replace(sympy.DiracDelta, lambda *_: sympy.S.Zero)
            self._rates = sympy.lambdify(
                [*(at.values[name] for name in self._names), at.qd, state], [rate, slope], "math"
            )

    def _signals(self, scene: Scene, warm_up_time: float | None) -> list[Array]:
        motion = scene.motion
        warmth = scene.warmth(self._k, warm_up_time) if "warmth" in self._effect.needs else np.zeros(1)
        load = scene.load[self._k] if "load" in self._effect.needs else np.zeros(1)
        return [*motion.q, *motion.qd, *motion.qdd, load, warmth]

    def _states(self, scene: Scene, values: list[float]) -> list[Array]:
        """The effect's state, at first that of a long motion the same way.

        Exact where its rate is linear in it: z + h f phi(h f'), phi = (e^x - 1)/x.
        """
        assert self._rates is not None
        stride = max(1, int(1 / (scene.period * _STEPS)))
        speed = scene.motion.qd[self._k, ::stride]
        h = stride * scene.period
        z = np.empty(len(speed))
        # What moved before the record began has come to its end.
        now = float(np.sign(speed[0]))
        for i, v in enumerate(speed.tolist()):
            z[i] = now
            f, slope = self._rates(*values, v, now)
            x = h * slope
            now += h * f * (expm1(x) / x if abs(x) > 1e-9 else 1.0)
        grid = np.arange(len(speed)) * stride
        return [np.interp(np.arange(scene.motion.samples), grid, z)]


def _ratios(robot: Robot, k: int) -> dict[int, sympy.Rational]:
    assert robot.drives is not None
    pairs = zip(robot.moving, robot.drives.coupling[k], strict=True)
    return {other.number: sympy.Rational(n.numerator, n.denominator) for other, n in pairs if n}
