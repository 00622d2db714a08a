"""The state inside one effect along speeds, by the exponential method of ``effect_states``.

A rate that is linear in the state, as that of bristles is, makes a linear recursion: all steps are taken at once. Any
other is linearised where each step begins.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import casadi
import numpy as np
import sympy

from identification.arrays import Array
from identification.effect_states import phi
from identification.recursion import from_start

#: Slope times step below which (e^x - 1)/x is 1.
_LINEAR = 1e-9
#: What the rates of states are made of, by the names that they are printed with.
_CASADI = {"Abs": casadi.fabs, "direction": casadi.sign, "exp": casadi.exp, "sqrt": casadi.sqrt, "tanh": casadi.tanh}

#: States (N) along speeds (N) in steps [s], for values of the effect, from the first state.
Steps = Callable[[Array, Sequence[float], float, float], Array]


def steps(rate: sympy.Expr, state: sympy.Symbol, speed: sympy.Symbol, values: Sequence[sympy.Symbol]) -> Steps:
    """How a ``state`` with this ``rate`` goes on at a ``speed``, which stays as it is for a step."""
    slope = sympy.diff(rate, state)
    if not slope.has(state):
        return _at_once(rate.subs(state, 0), slope, speed, values)
    slope = slope.subs(sympy.Derivative(sympy.sign(state), state), 0)
    slope = slope.replace(sympy.DiracDelta, lambda *_: sympy.S.Zero)
    return _one_by_one(rate, slope, state, speed, values)


def _at_once(rest: sympy.Expr, slope: sympy.Expr, speed: sympy.Symbol, values: Sequence[sympy.Symbol]) -> Steps:
    """With a rate of ``rest`` + ``slope`` z."""
    both = sympy.lambdify([*values, speed], [rest, slope], "numpy", cse=True)

    def along(speeds: Array, given: Sequence[float], h: float, start: float) -> Array:
        constant, per_state = (np.broadcast_to(one, speeds.shape)[:-1] for one in both(*given, speeds))
        x = h * per_state
        return from_start(np.exp(x), h * phi(x) * constant, start)

    return along


def _one_by_one(
    rate: sympy.Expr, slope: sympy.Expr, state: sympy.Symbol, speed: sympy.Symbol, values: Sequence[sympy.Symbol]
) -> Steps:
    """z + h f phi(h f') of each step."""
    # Printed as Python sign is a choice, which symbols do not make.
    both = [one.replace(sympy.sign, sympy.Function("direction")) for one in (rate, slope)]
    z, v, own, h = (casadi.SX.sym(name, *size) for name, *size in (("z",), ("v",), ("own", len(values)), ("h",)))
    f, of_z = sympy.lambdify([*values, speed, state], both, [_CASADI], cse=True)(*casadi.vertsplit(own), v, z)
    # At zero a power of |z| has no slope; a step there is Euler's.
    x = casadi.if_else(z == 0, 0, h * of_z)
    linear = casadi.fabs(x) <= _LINEAR
    grown = casadi.if_else(linear, 1, casadi.expm1(x) / casadi.if_else(linear, 1, x))
    step = casadi.Function("step", [z, v, casadi.vertcat(own, h)], [z + h * f * grown, z])

    @cache
    def many(count: int) -> Any:
        return step.mapaccum("states", count)

    def along(speeds: Array, given: Sequence[float], h: float, start: float) -> Array:
        count = len(speeds)
        _, found = many(count)(start, speeds[None], np.tile(np.array([*given, h])[:, None], count))
        return np.asarray(found.full()[0])

    return along
