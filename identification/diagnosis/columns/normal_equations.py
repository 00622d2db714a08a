"""Least squares on the Gram matrix of white rows, base parameters taken out once and for all.

With G the products of base columns W, candidate columns C and torque y over the fitted runs, and a prior's rows added
to W's, the Schur complement of W's block holds the products of what W cannot explain of C and y. Every question about
candidates is then a question about a few of its rows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.diagnosis.columns.growing import Products

Places = NDArray[np.int64]

#: Eigenvalues of W's scaled products below this part of the largest: directions that no row shows.
_RANK = 1e-10
#: Part of a column's square that must be left beside the chosen ones to be told from them.
_LEFT = 1e-4
#: The same where most parameters, more than this part of them, are known: what is left then is what their uncertainty
#: allows, and no rounding.
_KNOWN_LEFT, _MOSTLY = 1e-6, 0.5
#: Part of a precision that is rounding.
_ROUNDING = 1e-10
#: Standard deviations beyond which a value that is known is contradicted.
FAR = 5.0


@dataclass(frozen=True)
class Prior:
    """What is known of the base parameters beforehand: ``mean`` (p) and ``precision``, the inverse of its covariance
    (p x p), with zero rows for parameters of which nothing is known.
    """

    mean: Array
    precision: Array

    @property
    def known(self) -> NDArray[np.bool_]:
        """The parameters of which anything is known (p)."""
        return np.diag(self.precision) > 0

    @cached_property
    def whole(self) -> Array:
        """Products of the prior's rows and what they are to be, the last one (p + 1 square)."""
        weighted = self.precision @ self.mean
        return np.block([[self.precision, weighted[:, None]], [weighted[None], self.mean @ weighted]])

    def beside(self, precision: Sequence[float]) -> Prior:
        """With more parameters, which are zero to the ``precision``; of nothing where that is zero."""
        more = np.diag(np.asarray(precision, dtype=float))
        count = len(precision)
        whole = np.pad(self.precision, (0, count))
        whole[len(self.mean) :, len(self.mean) :] = more
        return Prior(np.append(self.mean, np.zeros(count)), whole)

    def only(self, kept: NDArray[np.int64]) -> Prior:
        """Of some of the parameters by number, the others being as they are known."""
        return Prior(self.mean[kept], self.precision[np.ix_(kept, kept)])

    def far(self, values: Array, covariance: Array) -> Array:
        """How far values (p) of a fit near the known ones, with a covariance (p x p), are from these, in standard
        deviations of the difference (p): such a fit holds what is known already, and is nearer to it than the runs
        alone are. One that is less certain than what is known does not hold it. Zero where nothing is known, or found;
        below ``FAR`` within the deviation that is known.
        """
        before, after = np.diag(inverse(self.precision)), np.diag(covariance)
        variance = np.where(after < before, np.maximum(before - after, before / FAR**2), before + after)
        variance = np.where(self.known & np.isfinite(after), variance, np.inf)
        return np.asarray(np.abs(values - self.mean) / np.sqrt(variance))

    def products(self, rows: Sequence[int], columns: Sequence[int], torque: int) -> Array:
        """The prior's part of products of columns by number, that of the torque being ``torque``."""
        p = len(self.mean)
        place = [np.array([p if k == torque else k if k < p else p + 1 for k in each]) for each in (rows, columns)]
        return np.asarray(np.pad(self.whole, (0, 1))[np.ix_(*place)])

    def shifted(self, direction: Array, value: float, std: float) -> Prior:
        """With ``value`` times a direction (p) added to the parameters, known with a standard deviation, or not at all
        where that is infinite.
        """
        weighted = self.precision @ direction
        variance = float(direction @ weighted) + (std**-2 if std else np.inf)
        precision = self.precision - (np.outer(weighted, weighted) / variance if variance else 0.0)
        if np.isinf(std):
            # What rounding leaves of nothing is no knowledge.
            left = np.diag(precision) > _ROUNDING * np.diag(self.precision)
            precision = np.where(np.outer(left, left), precision, 0.0)
        return Prior(self.mean + direction * value, precision)


def least_part(prior: Prior | None) -> float:
    """The part of a column's square that must be left for its coefficient to be told."""
    return _KNOWN_LEFT if prior is not None and float(prior.known.mean()) > _MOSTLY else _LEFT


@dataclass(frozen=True)
class Normal:
    """Products ``gram`` (c + 1 square) of ``base`` columns, candidates and torque, over ``rows`` rows.

    ``preset`` are coefficients of candidates, by the column's number, that are known: a solution has them as they are.
    """

    gram: Array
    base: int
    rows: int
    prior: Prior | None = None
    preset: Mapping[int, float] = field(default_factory=dict)

    @cached_property
    def whole(self) -> Array:
        """The Gram matrix with the prior's rows."""
        if self.prior is None:
            return self.gram
        at = [*range(self.base), len(self.gram) - 1]
        whole = self.gram.copy()
        whole[np.ix_(at, at)] += self.prior.whole
        return whole

    def products(self, rows: Sequence[int], columns: Sequence[int]) -> Array:
        """Some rows and columns of it, by number."""
        part = self.gram[np.ix_(np.asarray(rows, dtype=int), np.asarray(columns, dtype=int))]
        if self.prior is not None:
            part = part + self.prior.products(rows, columns, len(self.gram) - 1)
        return np.asarray(part)

    @cached_property
    def inverse(self) -> Array:
        """Pseudo-inverse of W's products: covariance of the base parameters without candidates (p x p)."""
        return inverse(self.whole[: self.base, : self.base])

    @cached_property
    def _left(self) -> Products:
        G, p = self.whole, self.base
        S = G[p:, p:] - G[p:, :p] @ self.inverse @ G[:p, p:]
        return Products((S + S.T) / 2)

    @property
    def schur(self) -> Array:
        """Products of what W cannot explain of the candidates and of the torque."""
        return self._left.array

    def grown(self, gram: Array) -> Normal:
        """The same of a ``gram`` with more candidates, the last columns before the torque; what was before is of no
        more use. Of the other candidates it is told already what W cannot explain.
        """
        result = replace(self, gram=gram)
        if "_left" in self.__dict__:
            p, old = self.base, len(self.schur) - 1
            across, more = result.products(range(p), range(p, len(gram))), gram[p + old : -1]
            S = self._left.join(len(more))
            S[old:-1] = more[:, p:] - more[:, :p] @ self.inverse @ across
            S[:, old:-1] = S[old:-1].T
            result.__dict__.update(inverse=self.inverse, _left=self._left)
        return result

    @cached_property
    def _least(self) -> Array:
        return least_part(self.prior) * self.gram.diagonal()

    def least(self, columns: Sequence[int]) -> Array:
        """What must be left of the squares of candidate columns by number (k) for their coefficients to be told."""
        return self._least[list(columns)]

    def hides(self, column: int) -> bool:
        """Whether W takes up a candidate's column, by its number, or no row shows it."""
        return bool(self.schur[column - self.base, column - self.base] <= self.least([column])[0])

    def beside(self, chosen: Sequence[int]) -> Array:
        """The Schur complement after the columns ``chosen`` too; their own rows are zero."""
        at = np.array(chosen, dtype=int) - self.base
        if not at.size:
            return self.schur
        fitted, known, values = told_apart(chosen, self.preset)
        S, out = without(self.schur, known - self.base, values), fitted - self.base
        result = S - S[:, out] @ (inverse(square(S, out)) @ S[out])
        result[at], result[:, at] = 0.0, 0.0
        return np.asarray(result)

    def part(self, columns: Sequence[int], chosen: Sequence[int]) -> Array:
        """The rows of ``columns`` and of the torque of the Schur complement after the columns ``chosen`` too."""
        fitted, known, values = told_apart(chosen, self.preset)
        at = np.array([*known, *fitted, *columns, len(self.gram) - 1]) - self.base
        S = without(square(self.schur, at), np.arange(len(known)), values)[len(known) :, len(known) :]
        return after(S, len(fitted))

    def numbers(self, chosen: Sequence[int]) -> list[int]:
        """Those of the base columns, then of the chosen ones."""
        return [*range(self.base), *chosen]

    def by_number(self, chosen: Sequence[int], solution: Array | None = None) -> dict[int, float]:
        """Values of the base columns and the chosen ones: of the ``solution`` (p + k), or else of that of the rows."""
        values = self.solution(chosen)[0] if solution is None else solution
        return dict(zip(self.numbers(chosen), values.tolist(), strict=True))

    def solution(self, chosen: Sequence[int]) -> tuple[Array, Array]:
        """Base parameters and the chosen columns' coefficients (p + k); and their covariance."""
        at = self.numbers(chosen)
        G = self.products(at, [*at, len(self.gram) - 1])
        free = np.array([number not in self.preset for number in at])
        values = told_apart(at, self.preset)[2]
        b = G[free, -1] - G[:, :-1][np.ix_(free, ~free)] @ values
        C = np.zeros((len(at), len(at)))
        C[np.ix_(free, free)] = inverse(G[:, :-1][np.ix_(free, free)])
        solution = np.empty(len(at))
        solution[free] = square(C, np.flatnonzero(free)) @ b
        solution[~free] = values
        return solution, C

    def misfit(self, chosen: Sequence[int], solution: Array) -> float:
        """Sum of the squared white residuals, without the prior's rows."""
        at = np.array([*self.numbers(chosen), len(self.gram) - 1])
        v = np.append(-solution, 1.0)
        return float(v @ square(self.gram, at) @ v)


def square(A: Array, at: Places) -> Array:
    """The rows and columns ``at`` places of a matrix: ``np.ix_`` takes longer than what is done with so few."""
    return A[at[:, None], at]


def told_apart(columns: Sequence[int], preset: Mapping[int, float]) -> tuple[Places, Places, Array]:
    """Columns by number that are fitted, those of which a coefficient is ``preset``, and the values that are."""
    known = [number for number in columns if number in preset]
    fitted = [number for number in columns if number not in preset]
    return np.array(fitted, dtype=int), np.array(known, dtype=int), np.array([preset[number] for number in known])


def without(G: Array, known: Places, values: Array) -> Array:
    """Products of columns and, the last, the torque, as they are of a torque without columns of known ``values``."""
    if not known.size:
        return G
    result = G.copy()
    result[:, -1] -= result[:, known] @ values
    result[-1] -= values @ result[known]
    return result


def after(G: Array, first: int) -> Array:
    """What the ``first`` of some columns cannot explain of the products of the others."""
    if not first:
        return G
    across = G[:first, first:]
    return np.asarray(G[first:, first:] - across.T @ inverse(G[:first, :first]) @ across)


def inverse(A: Array, rank: float = _RANK) -> Array:
    """Pseudo-inverse of a matrix of products, by the eigenvalues of what it is with columns of unit length."""
    if not len(A):
        return A
    if len(A) == 1:
        return np.array([[1 / A[0, 0] if A[0, 0] > 0 else 0.0]])
    if len(A) == 2 and (pair := _inverse_of_two(A, rank)) is not None:
        return pair
    along = directions(A, rank)
    return np.asarray(along @ along.T)


def directions(A: Array, rank: float = _RANK, whole: Array | None = None) -> Array:
    """Combinations of columns with the products ``A`` (k x k), each of unit length over the rows and at right angles to
    the others (k x m), those last that most of the columns share: their products are the pseudo-inverse of A.

    Where A is what others leave of the columns, ``whole`` are their squares (k) before: rounding is no direction.
    """
    size = np.sqrt(np.maximum(A.diagonal() if whole is None else whole, 0.0))
    live = size > 1e-12 * size.max(initial=0.0)
    scale = np.where(live, np.maximum(size, 1e-300), 1.0)
    scaled = np.where(np.outer(live, live), A / np.outer(scale, scale), 0.0)
    values, vectors = np.linalg.eigh(scaled)
    seen = values > rank * max(values.max(initial=0.0), 1e-300)
    return np.asarray(vectors[:, seen] / scale[:, None] / np.sqrt(values[seen]))


def _inverse_of_two(A: Array, rank: float) -> Array | None:
    """Of two columns, both of a size; None where it is not of full rank."""
    (a, c), (_, b) = A.tolist()
    if not (a > 0 and b > 0):
        return None
    size, other = sqrt(a), sqrt(b)
    cosine = c / size / other
    if 1 - abs(cosine) <= rank * (1 + abs(cosine)) or min(size, other) <= 1e-12 * max(size, other):
        return None
    scale = 1 / ((1 - cosine) * (1 + cosine))
    across = -scale * cosine / size / other
    return np.array([[scale / a, across], [across, scale / b]])


def lowered(A: Array, b: Array, x: Array) -> float:
    """By how much coefficients x lower the sum of squares, 2 b x - x A x: less than nothing where they raise it."""
    return float(2 * b @ x - x @ A @ x)


def bounded(A: Array, b: Array, lower: Array, upper: Array, least: Array) -> tuple[Array, float]:
    """Coefficients that lower the sum of squares most, and by how much: max 2 b x - x A x.

    A is k x k, all others k. Those that would be beyond their bounds are left out, zero: such values mean another
    effect; and so are those of whose column's square not the ``least`` is left.
    """
    free = A.diagonal() > least
    x = np.zeros(len(b))
    for _ in range(len(b) + 1):
        at = np.flatnonzero(free)
        if not at.size:
            return np.zeros(len(b)), 0.0
        x = np.zeros(len(b))
        x[at] = inverse(square(A, at), 1e-8) @ b[at]
        out = at[(x[at] < lower[at]) | (x[at] > upper[at])]
        if not out.size:
            break
        free[out] = False
    return x, max(lowered(A, b, x), 0.0)
