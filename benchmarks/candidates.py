"""Fixed-step methods that the generated simulation might offer, beside those that it does."""

from __future__ import annotations

from fractions import Fraction

from generator.backends.printing.runge_kutta import METHODS, Method, Row, row

_ROOT = "4.58257569495584000658804719372800848898445657676797"  # of 21


def _r(a: int, b: int, divisor: int) -> Fraction:
    """(a + b sqrt(21)) / divisor."""
    return (a + b * Fraction(_ROOT)) / divisor


def _rows(*rows: tuple[object, ...]) -> tuple[Row, ...]:
    return tuple({j: Fraction(entry) for j, entry in enumerate(one) if entry != 0} for one in rows)  # type: ignore[arg-type]


MIDPOINT = Method("midpoint", "midpoint, order 2", 2, (row([]), row(["1/2"])), row(["0", "1"]))
KUTTA3 = Method("kutta3", "Kutta, order 3", 3, (row([]), row(["1/2"]), row(["-1", "2"])), row(["1/6", "2/3", "1/6"]))
#: Nystroem 1925 for accelerations that do not depend on the speeds; speeds of its stages to second order.
NYSTROEM5 = Method(
    "nystroem5",
    "Nystroem, order 5 without damping",
    5,
    (row([]), row(["1/5"]), row(["-4/9", "10/9"]), row(["1/4", "0", "3/4"])),
    row(["14/336", "125/336", "162/336", "35/336"]),
    (
        row([]),
        row(["1/50"]),
        row(["-1/27", "7/27"]),
        row(["3/10", "-2/35", "9/35"]),
        row(["14/336", "100/336", "54/336"]),
    ),
)
DP5 = Method(
    "dp5",
    "Dormand and Prince, order 5",
    5,
    (
        row([]),
        row(["1/5"]),
        row(["3/40", "9/40"]),
        row(["44/45", "-56/15", "32/9"]),
        row(["19372/6561", "-25360/2187", "64448/6561", "-212/729"]),
        row(["9017/3168", "-355/33", "46732/5247", "49/176", "-5103/18656"]),
    ),
    row(["35/384", "0", "500/1113", "125/192", "-2187/6784", "11/84"]),
)
BUTCHER6 = Method(
    "butcher6",
    "Butcher, order 6",
    6,
    (
        row([]),
        row(["1/3"]),
        row(["0", "2/3"]),
        row(["1/12", "1/3", "-1/12"]),
        row(["25/48", "-55/24", "35/48", "15/8"]),
        row(["3/20", "-11/24", "-1/8", "1/2", "1/10"]),
        row(["-261/260", "33/13", "43/156", "-118/39", "32/195", "80/39"]),
    ),
    row(["13/200", "0", "11/40", "11/40", "4/25", "4/25", "13/200"]),
)
COOPER_VERNER8 = Method(
    "cv8",
    "Cooper and Verner, order 8",
    8,
    _rows(
        (),
        ("1/2",),
        ("1/4", "1/4"),
        ("1/7", _r(-7, -3, 98), _r(21, 5, 49)),
        (_r(11, 1, 84), 0, _r(18, 4, 63), _r(21, -1, 252)),
        (_r(5, 1, 48), 0, _r(9, 1, 36), _r(-231, 14, 360), _r(63, -7, 80)),
        (_r(10, -1, 42), 0, _r(-432, 92, 315), _r(633, -145, 90), _r(-504, 115, 70), _r(63, -13, 35)),
        ("1/14", 0, 0, 0, _r(14, -3, 126), _r(13, -3, 63), "1/9"),
        ("1/32", 0, 0, 0, _r(91, -21, 576), "11/72", _r(-385, -75, 1152), _r(63, 13, 128)),
        ("1/14", 0, 0, 0, "1/9", _r(-733, -147, 2205), _r(515, 111, 504), _r(-51, -11, 56), _r(132, 28, 245)),
        (
            *(0, 0, 0, 0, _r(-42, 7, 18), _r(-18, 28, 45)),
            *(_r(-273, -53, 72), _r(301, 53, 72), _r(28, -28, 45), _r(49, -7, 18)),
        ),
    ),
    _rows(("1/20", 0, 0, 0, 0, 0, 0, "49/180", "16/45", "49/180", "1/20"))[0],
)


def extrapolated(*numbers: int) -> Method:
    """Gragg's extrapolation: midpoint rules of even ``numbers`` of steps, whose errors are even powers of the step."""
    A: list[Row] = [{}]
    b: Row = {}
    for n in numbers:
        weight = Fraction(1)
        for other in numbers:
            weight *= Fraction(n * n, n * n - other * other) if other != n else 1
        before: Row = {}
        now: Row = {0: Fraction(1, n)}
        for _ in range(n - 1):
            A.append(now)
            after = before | {len(A) - 1: before.get(len(A) - 1, Fraction(0)) + Fraction(2, n)}
            before, now = now, after
        for column, entry in now.items():
            b[column] = b.get(column, Fraction(0)) + weight * entry
    return Method(f"gragg{2 * len(numbers)}", f"Gragg, order {2 * len(numbers)}", 2 * len(numbers), tuple(A), b)


CANDIDATES = (
    MIDPOINT,
    KUTTA3,
    NYSTROEM5,
    DP5,
    BUTCHER6,
    COOPER_VERNER8,
    extrapolated(2, 4),
    extrapolated(2, 4, 6, 8),
    *METHODS,
)
