"""Constants of the generated sine and cosine, computed: `python -m benchmarks.sine_cosine_constants` prints them.

The kernels are least-maximum polynomials on [-pi/4, pi/4] by the second algorithm of Remez (1934), in z = r^2,

    sin r = r + r z (S0 + S1 z + ...)       least maximal relative error
    cos r = 1 + z (-1/2 + z (C0 + C1 z + ...))    least maximal absolute error

Coefficients are rounded to the precision one after the other, the later ones making up for what rounding took.
The parts of pi/2 are such that n times a part is exact for every n that the range allows (W. J. Cody and W. Waite,
Software Manual for the Elementary Functions, 1980), so no rounding happens before the subtraction of the third part.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath

Function = Callable[[Any], Any]

mpmath.mp.prec = 300


@dataclass(frozen=True)
class Precision:
    """A binary format: ``bits`` of significand; multiples n of pi/2 have at most ``multiple_bits``."""

    name: str
    bits: int
    multiple_bits: int
    sine_terms: int
    cosine_terms: int


#: |x| <= 1e5 is n <= 63662; |x| <= 1e3 is n <= 637.
PRECISIONS = (Precision("double", 53, 16, 6, 6), Precision("float", 24, 10, 3, 3))


def rounded(value: Any, bits: int) -> Any:
    """``value`` to the nearest number of ``bits`` bits."""
    mantissa, exponent = mpmath.frexp(value)
    return mpmath.ldexp(mpmath.nint(mpmath.ldexp(mantissa, bits)), int(exponent) - bits)


def half_pi_parts(precision: Precision) -> list[Any]:
    """Four parts of pi/2; n times each of the first three is exact, and so are x - n P0 and (x - n P0) - n P1."""
    exact = precision.bits - precision.multiple_bits
    first = rounded(mpmath.pi / 2, exact)
    unit = precision.bits
    second = mpmath.ldexp(mpmath.nint(mpmath.ldexp(mpmath.pi / 2 - first, unit)), -unit)
    third = rounded(mpmath.pi / 2 - first - second, exact)
    return [first, second, third, rounded(mpmath.pi / 2 - first - second - third, precision.bits)]


def remez(function: Function, weight: Function, terms: int, upper: Any) -> list[Any]:
    """Coefficients of the polynomial of ``terms`` terms that makes max |weight (p - function)| on (0, upper] least."""
    nodes = [upper * (1 - mpmath.cos(mpmath.pi * (k + mpmath.mpf(1) / 2) / (terms + 1))) / 2 for k in range(terms + 1)]
    for _ in range(12):
        rows = [[x**k for k in range(terms)] + [(-1) ** i / weight(x)] for i, x in enumerate(nodes)]
        solution = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix([function(x) for x in nodes]))
        coefficients = list(solution)[:terms]

        def error(x: Any, p: Sequence[Any] = coefficients) -> Any:
            return weight(x) * (mpmath.polyval(p[::-1], x) - function(x))

        nodes = _extrema(error, terms + 1, upper)
    return coefficients


def _extrema(error: Function, count: int, upper: Any, grid: int = 600) -> list[Any]:
    """The places of the largest |error| between its changes of sign."""
    places = [upper * (1 - mpmath.cos(mpmath.pi * k / grid)) / 2 for k in range(1, grid + 1)]
    values = [error(x) for x in places]
    runs: list[list[int]] = [[0]]
    for k in range(1, grid):
        if mpmath.sign(values[k]) != mpmath.sign(values[runs[-1][-1]]):
            runs.append([])
        runs[-1].append(k)
    best = [max(run, key=lambda k: abs(values[k])) for run in runs]
    while len(best) > count:
        best.remove(min((best[0], best[-1]), key=lambda k: abs(values[k])))
    assert len(best) == count, f"{len(best)} alternations, {count} expected"
    return [places[k] for k in best]


def coefficients(function: Function, weight: Function, terms: int, bits: int) -> list[Any]:
    """Rounded coefficients of ``function`` in z on (0, (pi/4)^2]: one is rounded, the rest found again."""
    upper = (mpmath.pi / 4) ** 2
    fixed: list[Any] = []

    def rest(z: Any) -> Any:
        return (function(z) - mpmath.polyval([*fixed[::-1]] or [0], z)) / z ** len(fixed)

    while len(fixed) < terms:
        found = remez(rest, lambda z: weight(z) * z ** len(fixed), terms - len(fixed), upper)
        fixed.append(rounded(found[0], bits))
    return fixed


def sine(precision: Precision) -> list[Any]:
    """S0, S1...: (sin r / r - 1) / z, weighted for the relative error of sin r."""

    def ratio(z: Any) -> Any:
        return mpmath.sin(mpmath.sqrt(z)) / mpmath.sqrt(z)

    return coefficients(lambda z: (ratio(z) - 1) / z, lambda z: z / ratio(z), precision.sine_terms, precision.bits)


def cosine(precision: Precision) -> list[Any]:
    """C0, C1...: (cos r - 1 + z/2) / z^2, weighted for the absolute error of cos r."""
    return coefficients(
        lambda z: (mpmath.cos(mpmath.sqrt(z)) - 1 + z / 2) / z**2,
        lambda z: z**2,
        precision.cosine_terms,
        precision.bits,
    )


def literal(value: Any, precision: Precision) -> str:
    """Decimals that read back as ``value``, with the suffix of the type."""
    digits: str = mpmath.nstr(value, 17 if precision.bits == 53 else 9, strip_zeros=True, min_fixed=-2, max_fixed=17)
    return digits + ("F" if precision.bits == 24 else "")


def constants(precision: Precision) -> dict[str, list[str]]:
    """Literals of the constants by their names in templates/c/sine_cosine.c.jinja."""
    return {
        "two_over_pi": [literal(rounded(2 / mpmath.pi, precision.bits), precision)],
        "half_pi": [literal(part, precision) for part in half_pi_parts(precision)],
        "sine": [literal(value, precision) for value in sine(precision)],
        "cosine": [literal(value, precision) for value in cosine(precision)],
    }


if __name__ == "__main__":
    for format_ in PRECISIONS:
        for name, values in constants(format_).items():
            print(format_.name, name, *values)
