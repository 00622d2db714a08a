"""Explicit Runge-Kutta methods as data, and their stages as C for a second-order system.

For qdd = f(q, qd) a method with coefficients A, b and nodes c needs the stages' accelerations alone (Nystroem's form):

    Q_i = q + c_i h qd + h^2 sum_j (A A)_ij f_j        V_i = qd + h sum_j A_ij f_j        f_i = f(Q_i, V_i)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from generator.backends.printing.language import LINE, Language

Row = dict[int, Fraction]

#: What products of rounded coefficients leave of zeros.
_ROUNDING = Fraction(1, 10**14)


@dataclass(frozen=True)
class Method:
    """``A`` lower triangular, by rows {column: entry}; ``b`` the weights; ``order`` of the error over a fixed time.

    ``P`` has the rows of positions, the result's the last, where they are not those of A A.
    """

    name: str
    title: str
    order: int
    A: tuple[Row, ...]
    b: Row
    P: tuple[Row, ...] = ()

    @property
    def speeds(self) -> tuple[Row, ...]:
        """The rows of A, then b."""
        return (*self.A, self.b)

    @property
    def positions(self) -> tuple[Row, ...]:
        """The rows of A A, then b A, where no others are given."""
        return self.P or tuple(self._times_A(weights) for weights in self.speeds)

    def _times_A(self, weights: Row) -> Row:
        product: Row = {}
        for k, entry in weights.items():
            for j, inner in self.A[k].items():
                product[j] = product.get(j, Fraction(0)) + entry * inner
        return product


@dataclass(frozen=True)
class Stage:
    """One row of a method as text: the time that has passed, and lines of the sums over f of positions and speeds."""

    time: str
    position: tuple[str, ...]
    speed: tuple[str, ...]


def row(entries: Sequence[str] | dict[int, str]) -> Row:
    """A row from its entries as exact numbers, all of them or by column."""
    pairs = entries.items() if isinstance(entries, dict) else enumerate(entries)
    return {column: Fraction(entry) for column, entry in pairs if Fraction(entry) != 0}


#: The classical method (Kutta 1901).
RK4 = Method(
    "rk4",
    "Kutta's method of order 4, 4 evaluations a step",
    4,
    (row([]), row(["1/2"]), row(["0", "1/2"]), row(["0", "0", "1"])),
    row(["1/6", "1/3", "1/3", "1/6"]),
)

#: Dormand and Prince's method of order 8 as in DOP853 (Hairer, Norsett, Wanner 1993, Solving Ordinary Differential
#: Equations I, section II.5), without its error estimate.
DP8 = Method(
    "dp8",
    "Dormand and Prince's method of order 8, 12 evaluations a step",
    8,
    (
        row({}),
        row({0: "0.05260015195876773"}),
        row({0: "0.0197250569845379", 1: "0.0591751709536137"}),
        row({0: "0.02958758547680685", 2: "0.08876275643042054"}),
        row({0: "0.2413651341592667", 2: "-0.8845494793282861", 3: "0.924834003261792"}),
        row({0: "0.037037037037037035", 3: "0.17082860872947386", 4: "0.12546768756682242"}),
        row({0: "0.037109375", 3: "0.17025221101954405", 4: "0.06021653898045596", 5: "-0.017578125"}),
        row(
            {
                0: "0.03709200011850479",
                3: "0.17038392571223998",
                4: "0.10726203044637328",
                5: "-0.015319437748624402",
                6: "0.008273789163814023",
            }
        ),
        row(
            {
                0: "0.6241109587160757",
                3: "-3.3608926294469414",
                4: "-0.868219346841726",
                5: "27.59209969944671",
                6: "20.154067550477894",
                7: "-43.48988418106996",
            }
        ),
        row(
            {
                0: "0.47766253643826434",
                3: "-2.4881146199716677",
                4: "-0.590290826836843",
                5: "21.230051448181193",
                6: "15.279233632882423",
                7: "-33.28821096898486",
                8: "-0.020331201708508627",
            }
        ),
        row(
            {
                0: "-0.9371424300859873",
                3: "5.186372428844064",
                4: "1.0914373489967295",
                5: "-8.149787010746927",
                6: "-18.52006565999696",
                7: "22.739487099350505",
                8: "2.4936055526796523",
                9: "-3.0467644718982196",
            }
        ),
        row(
            {
                0: "2.273310147516538",
                3: "-10.53449546673725",
                4: "-2.0008720582248625",
                5: "-17.9589318631188",
                6: "27.94888452941996",
                7: "-2.8589982771350235",
                8: "-8.87285693353063",
                9: "12.360567175794303",
                10: "0.6433927460157636",
            }
        ),
    ),
    row(
        {
            0: "0.054293734116568765",
            5: "4.450312892752409",
            6: "1.8915178993145003",
            7: "-5.801203960010585",
            8: "0.3111643669578199",
            9: "-0.1521609496625161",
            10: "0.20136540080403034",
            11: "0.04471061572777259",
        }
    ),
)

METHODS = (RK4, DP8)


def stages(method: Method, language: Language) -> list[Stage]:
    """The stages of a step and at last its result, over accelerations f1, f2, ... at place i."""
    pairs = zip(method.positions, method.speeds, strict=True)
    return [Stage(_time(speed, language), _sum(position, language), _sum(speed, language)) for position, speed in pairs]


def _time(weights: Row, language: Language) -> str:
    """The time of a stage; rounded coefficients that miss a whole step by a rounding make one."""
    total = sum(weights.values(), Fraction(0))
    return "h" if abs(total - 1) < _ROUNDING else f"h*{language.number(total)}"


def _sum(entries: Row, language: Language) -> tuple[str, ...]:
    """The sum in lines, each after the first begins with its sign; none for an empty sum."""
    lines: list[str] = []
    for column, factor in sorted(entries.items()):
        if abs(factor) < _ROUNDING:
            continue
        term = f"{language.number(abs(factor))}*f{column + 1}[i]"
        sign = "-" if factor < 0 else "+"
        if not lines:
            lines.append(f"-{term}" if factor < 0 else term)
        elif len(lines[-1]) + len(term) + 24 < LINE:
            lines[-1] += f" {sign} {term}"
        else:
            lines.append(f"{sign} {term}")
    return tuple(lines)
