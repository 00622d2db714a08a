"""States of effects in steps of the samples, against their differential equations integrated finely."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp

from identification.arrays import Array
from identification.diagnosis.columns.state_steps import steps

H = 0.002
Z, V, XS, EXPONENT, VS = sympy.Symbol("z", real=True), sympy.Symbol("v", real=True), *sympy.symbols("xs n vs")

DAHL = (V - sympy.Abs(V) * Z) / XS
LUGRE = (V - sympy.Abs(V) * Z / (1 + sympy.exp(-((V / VS) ** 2)) / 2)) / XS
BOUC_WEN = (V - sympy.Abs(Z) ** EXPONENT * (V + sympy.Abs(V) * sympy.sign(Z)) / 2) / XS


def speeds() -> Array:
    """There and back, each speed for a step; it stands for a while."""
    t = H * np.arange(800)
    return np.where((t > 0.7) & (t < 0.9), 0.0, 0.3 * np.sin(4 * t) + 0.05 * np.sin(31 * t))


@pytest.mark.parametrize("start", [0.0, -0.4, 1.0])
@pytest.mark.parametrize(
    ("rate", "symbols", "values"),
    [(DAHL, [XS], [0.02]), (LUGRE, [XS, VS], [0.01, 0.1]), (BOUC_WEN, [XS, EXPONENT], [0.03, 1.7])],
    ids=["Dahl", "LuGre", "Bouc-Wen"],
)
def test_a_state_goes_on_as_its_rate_says(
    rate: sympy.Expr, symbols: Sequence[sympy.Symbol], values: Sequence[float], start: float
) -> None:
    v = speeds()
    found = steps(rate, Z, V, symbols)(v, values, H, start)
    of_time = sympy.lambdify([Z, V], rate.subs(dict(zip(symbols, values, strict=True))), "numpy")
    expected = [start]
    for speed in v[:-1]:
        done = solve_ivp(lambda _, z, speed=speed: of_time(z, speed), (0, H), expected[-1:], rtol=1e-9, atol=1e-11)
        expected.append(float(done.y[0, -1]))
    assert found.shape == v.shape
    linear = rate is not BOUC_WEN
    np.testing.assert_allclose(found, expected, atol=1e-7 if linear else 2e-3)


def test_what_wears_down_within_a_step_has_no_past() -> None:
    """A bristle that is far shorter than a step's way ends where sliding ends."""
    v = np.repeat([0.5, -0.5], 50)
    found = steps(DAHL, Z, V, [XS])(v, [1e-9], H, 0.0)
    np.testing.assert_allclose(found[1:51], 1.0, rtol=1e-14)
    np.testing.assert_allclose(found[51:], -1.0, rtol=1e-14)
