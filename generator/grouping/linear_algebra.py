"""Spans and null spaces over the exact scalars of one robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from generator.grouping.scalars import Numbers, Scalar

Vector = list[Scalar]
Matrix = list[Vector]


def times(row: Sequence[Scalar], matrix: Matrix, numbers: Numbers) -> Vector:
    """The row vector ``row`` times ``matrix``."""
    result = [numbers.zero] * len(matrix[0])
    for coefficient, line in zip(row, matrix, strict=True):
        if coefficient:
            for k, entry in enumerate(line):
                if entry:
                    result[k] = result[k] + coefficient * entry
    return result


class Span:
    """A subspace of row vectors, kept as a reduced echelon basis."""

    def __init__(self, size: int, numbers: Numbers) -> None:
        self.size = size
        self._numbers = numbers
        self._rows: dict[int, Vector] = {}

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def basis(self) -> Matrix:
        """The basis as rows of ``size`` entries, by ascending pivots, at which a row is 1 and all others are 0."""
        return [self._rows[pivot] for pivot in sorted(self._rows)]

    @property
    def pivots(self) -> list[int]:
        """Places of the rows' leading ones, ascending, counted from 0."""
        return sorted(self._rows)

    @property
    def full(self) -> bool:
        """Whether it is the whole space."""
        return len(self._rows) == self.size

    def add(self, vector: Sequence[Scalar]) -> bool:
        """Takes a vector in; tells whether it was new."""
        if self.full:
            return False
        rest = list(vector)
        for pivot, row in self._rows.items():
            if rest[pivot]:
                rest = _minus(rest, rest[pivot], row)
        lead = next((k for k, entry in enumerate(rest) if entry), None)
        if lead is None:
            return False
        rest = [entry / rest[lead] if entry else entry for entry in rest]
        for pivot, row in self._rows.items():
            if row[lead]:
                self._rows[pivot] = _minus(row, row[lead], rest)
        self._rows[lead] = rest
        return True

    def add_all(self, vectors: Iterable[Sequence[Scalar]]) -> Span:
        """Takes every vector in; returns the span itself."""
        for vector in vectors:
            self.add(vector)
        return self

    def close_under(self, operator: Matrix) -> Span:
        """Grows to the smallest subspace that holds this one and is mapped into itself by v -> v operator."""
        fresh = self.basis
        while fresh:
            images = [times(vector, operator, self._numbers) for vector in fresh]
            fresh = [image for image in images if self.add(image)]
        return self


def null_space(rows: Span, numbers: Numbers) -> Matrix:
    """A basis of the vectors x with row . x = 0 for every row."""
    pivots = rows.pivots
    basis = []
    for free in range(rows.size):
        if free in pivots:
            continue
        vector = [numbers.zero] * rows.size
        vector[free] = numbers.one
        for pivot, row in zip(pivots, rows.basis, strict=True):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis


def _minus(a: Vector, factor: Scalar, b: Vector) -> Vector:
    return [x - factor * y if y else x for x, y in zip(a, b, strict=True)]
