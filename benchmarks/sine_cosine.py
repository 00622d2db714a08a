"""Errors of the sine and cosine in generated C, against arithmetic of 200 bits.

What is measured is a generated library: one joint that turns about z, whose transformation holds both.
"""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import mpmath
import numpy as np
from numpy.typing import NDArray

from generator.backends import c
from generator.derivation import derive
from generator.robot.readers import read
from tests.compiled import write

Doubles = NDArray[np.float64]

_ROBOT = """name: wheel
description: One joint about z
gravity: [0 m/s2, 0 m/s2, 0 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
"""
_DRIVER = """#include "wheel.h"
void evaluate(int size, const double *x, double *sines, double *cosines)
{
    wheel_prepared prepared = { 0 };
    for (int i = 0; i < size; ++i) {
        const wheel_real q[1] = { (wheel_real)x[i] };
        wheel_real T[16];
        wheel_tool_transform(&prepared, q, T);
        sines[i] = T[4];
        cosines[i] = T[0];
    }
}
"""


@dataclass(frozen=True)
class Reference:
    """Sines or cosines in two parts: ``high + low`` is exact to twice the precision of a double."""

    high: Doubles
    low: Doubles

    def errors(self, computed: Doubles, bits: int) -> tuple[float, float]:
        """Largest error in units in the last place of a number of ``bits`` bits, and largest absolute error."""
        wrong = np.abs((computed - self.high) - self.low)
        _, exponents = np.frexp(self.high)
        return float((wrong / np.ldexp(1.0, exponents - bits)).max()), float(wrong.max())


def sources(build: Path) -> Path:
    """Writes the library and its driver into ``build``."""
    write(build, {"wheel.yaml": _ROBOT, "driver.c": _DRIVER})
    model = derive(read(build / "wheel.yaml"), ["tool_transform"], check=False)
    return write(build, c.library(model, ()))


class SineCosine:
    """The library in ``build`` (from ``sources``), compiled with ``flags`` and callable on arrays."""

    def __init__(self, build: Path, compiler: str = "gcc", flags: Sequence[str] = ("-O2",)) -> None:
        name = f"wheel{len(list(build.iterdir()))}"
        # -ffast-math at the link would change how the whole process treats small numbers
        for command in (
            ["-std=c99", *flags, "-fPIC", "-c", "wheel.c", "-o", f"{name}.o"],
            ["-std=c99", *flags, "-shared", "-fPIC", f"{name}.o", "driver.c", "-o", f"{name}.so", "-lm"],
        ):
            linked = [word for word in command if "-shared" not in command or word != "-ffast-math"]
            subprocess.run([compiler, *linked], cwd=build, check=True)
        library = build / f"{name}.so"
        self._evaluate = ctypes.CDLL(str(library)).evaluate

    def __call__(self, x: Doubles) -> tuple[Doubles, Doubles]:
        """Sines and cosines of ``x``, which a library in single precision rounds first."""
        angles = np.ascontiguousarray(x, np.float64)
        sines, cosines = np.empty_like(angles), np.empty_like(angles)
        pointers = (array.ctypes.data_as(ctypes.c_void_p) for array in (angles, sines, cosines))
        self._evaluate(ctypes.c_int(len(angles)), *pointers)
        return sines, cosines


def exact(x: Doubles) -> tuple[Reference, Reference]:
    """Sines and cosines of the numbers ``x``."""
    with mpmath.workprec(200):
        return tuple(_parts([function(mpmath.mpf(float(one))) for one in x]) for function in (mpmath.sin, mpmath.cos))  # type: ignore[return-value]


def _parts(values: Sequence[object]) -> Reference:
    high = np.array([float(value) for value in values])  # type: ignore[arg-type]
    low = np.array([float(value - mpmath.mpf(part)) for value, part in zip(values, high, strict=True)])
    return Reference(high, low)


def samples(limit: float, size: int, single: bool) -> Doubles:
    """Numbers of magnitude up to ``limit``: uniform, of every order of magnitude, and about multiples of pi/2."""
    draw = np.random.default_rng(0)
    uniform = draw.uniform(-limit, limit, size)
    orders = np.exp(draw.uniform(np.log(1e-12), np.log(limit), size // 4)) * draw.choice([-1.0, 1.0], size // 4)
    every = np.concatenate([uniform, orders, near_multiples(limit, single)])
    return every.astype(np.float32).astype(np.float64) if single else every


def near_multiples(limit: float, single: bool, size: int = 1000) -> Doubles:
    """The numbers up to ``limit`` that come closest to multiples of pi/2, where most digits cancel."""
    kind = np.float32 if single else np.float64
    multiples = np.arange(1, int(limit / (np.pi / 2)) + 1)
    with mpmath.workprec(200):
        half_pi = mpmath.pi / 2
        nearest = [kind(float(int(n) * half_pi)) for n in multiples]
        left = [abs(float(int(n) * half_pi - mpmath.mpf(float(x)))) for n, x in zip(multiples, nearest, strict=True)]
    closest = np.array(nearest, kind)[np.argsort(left)[:size]]
    around = [closest, np.nextafter(closest, kind(0)), np.nextafter(closest, kind(np.inf))]
    inside = np.concatenate(around).astype(np.float64)
    return inside[np.abs(inside) <= limit]
