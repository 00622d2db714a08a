"""What is missing, said once: effect, joint, values with uncertainty, evidence, and what may stand in its place."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from generator.review.decimals import scientific
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.search.evidence import Evidence
from identification.outcome import Value

FIRM, TENTATIVE = "firm", "tentative"
#: Standard deviation of a value beyond which runs do not tell it, in parts of it; of a shape whose zero means nothing
#: in parts of its grid's step.
_VAGUE = 0.5
#: Part of a value's standard deviation below which that of the same value told another way is clearly less.
_BETTER = 0.5
#: Significant digits of a value without a standard deviation, and most of one with it.
_DIGITS, _MOST = 4, 6


@dataclass(frozen=True)
class Alternative:
    """Another effect that this data cannot tell from the one that was named; ``named`` says it in words."""

    effect: str
    title: str
    joints: tuple[int, ...]
    named: str
    score: float
    separating_experiment: str


@dataclass(frozen=True)
class Told:
    """A value of a finding [``unit``]; ``std`` is None for what was not searched and for a coefficient ``at_bound``
    of its range, where a shape may be too, infinite for what the runs do not show. Of a ``scale`` any value will do.
    """

    name: str
    value: float
    std: float | None
    unit: str
    at_bound: bool = False
    scale: bool = False

    @property
    def digits(self) -> int:
        """Significant digits of the value, of which the standard deviation leaves the last two uncertain."""
        if not self.std or not self.value or not math.isfinite(self.std):
            return _DIGITS
        before = math.floor(math.log10(abs(self.value))) - math.floor(math.log10(self.std))
        return min(max(before + 2, 2), _MOST)

    def text(self, unit: str, plus_minus: str = "+-") -> str:
        """Value and standard deviation with the unit as it is written: ``0.053 +- 0.0014 rad/s``."""
        std = "" if self.std in (None, math.inf) else f" {plus_minus} {_written(self.std or 0.0, 2)}"
        return f"{_written(self.value, self.digits)}{std}{unit}{self._remark}"

    @property
    def _remark(self) -> str:
        if self.scale:
            return " (chosen: the runs tell the other lengths and the force only relative to it)"
        unseen = " (not shown by these runs)" if self.std == math.inf else ""
        return (" (at its bound)" if self.at_bound else "") + unseen


def _written(x: float, digits: int) -> str:
    """Without a power of ten down to 1e-4, as small times are read."""
    return f"{x:.{digits}g}" if 1e-4 <= abs(x) < 1e-3 else scientific(x, digits)


@dataclass(frozen=True)
class Finding:
    """An effect on ``joints`` that the model lacks: ``parameters`` and ``shape`` values by name.

    ``amplitude`` is the rms of its torque on the fitted rows of each joint it acts on [N m, N], by joint number, and
    ``refined`` how much of it coefficients that only refine make, in parts of what the rest does. ``shape_std`` are
    standard deviations of the shape values that were searched. ``disagreement`` tells in words how the runs disagree on
    its amplitude, if they do; ``apart`` whether no other shape of those that are tried alone does as well; ``sure``
    that such a torque acts, whatever makes it. ``doubts`` say in words why it may be another one.
    """

    hypothesis: Hypothesis
    joints: tuple[int, ...]
    shape: Mapping[str, float]
    parameters: Mapping[str, Value]
    evidence: Evidence
    alternatives: tuple[Alternative, ...]
    amplitude: Mapping[int, float]
    shape_std: Mapping[str, float]
    disagreement: str = ""
    apart: bool = True
    refined: float = 0.0
    sure: bool = True
    doubts: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        """Tentative where it may stand for something else."""
        return TENTATIVE if self.doubts or self.alternatives else FIRM

    def doubted(self, *doubts: str, alternatives: Sequence[Alternative] = (), sure: bool | None = None) -> Finding:
        """With further ``doubts`` and ``alternatives``, and ``sure`` as given, else as it was."""
        return replace(
            self,
            doubts=(*self.doubts, *doubts),
            alternatives=(*self.alternatives, *alternatives),
            sure=self.sure if sure is None else sure,
        )

    @property
    def known(self) -> dict[str, float]:
        """Coefficients [SI] by name, without those that the runs do not show."""
        return {name: one.value for name, one in self.parameters.items() if one.value is not None}

    @property
    def told_shape(self) -> dict[str, float]:
        """The shape, with the value of the coefficient in the place of the one that is the same by another way
        (``Hypothesis.twice``) where the runs tell the coefficient better. How fast a link swings tells a stiffness
        better than how far, unless it is too fast to be seen.
        """
        result = dict(self.shape)
        for name, (other, power) in self.hypothesis.twice.items():
            one, std = self.parameters[name], self.shape_std.get(other)
            if one.value and std is not None and one.std / one.value < _BETTER * std / self.shape[other]:
                result[other] = one.value**power
        return result

    @property
    def homogeneous(self) -> bool:
        """Whether one amplitude holds in all runs, and along each that repeats."""
        return not self.disagreement

    @property
    def variable(self) -> str:
        """What it shows over: of its coefficients that are not zero, where they agree."""
        whole = self.hypothesis.variable
        own = {one.variable or whole for one in self.hypothesis.coefficients if self.parameters[one.name].value}
        return own.pop() if len(own) == 1 else whole

    @property
    def told(self) -> tuple[Told, ...]:
        """Coefficients, then the shape."""
        units = {**self.hypothesis.units, **{shape.name: shape.unit for shape in self.hypothesis.shapes}}
        coefficients = [
            Told(c.name, one.value, one.std or None, one.unit, not one.value and not one.std)
            for c in self.hypothesis.coefficients
            if (one := self.parameters[c.name]).value is not None
            if one.std or not c.refines
        ]
        scales = {shape.name for shape in self.hypothesis.shapes if shape.scale}
        ends = {one.name for one in self.hypothesis.shapes if one.step and one.ends_at(self.shape[one.name])}
        shape = [
            Told(name, value, self.shape_std.get(name), units.get(name, "1"), name in ends, name in scales)
            for name, value in self.shape.items()
        ]
        return (*coefficients, *shape)

    @property
    def main(self) -> tuple[Value, ...]:
        """Its coefficients but those that refine it, unless they are all that it has."""
        plain = tuple(self.parameters[c.name] for c in self.hypothesis.coefficients if not c.refines)
        refining = tuple(self.parameters[c.name] for c in self.hypothesis.coefficients if c.refines)
        return plain if any(one.value for one in plain) else refining or plain

    @property
    def determined(self) -> bool:
        """Whether the runs tell its values one by one, and not only the torque that they make together."""
        shapes = {one.name: one for one in self.hypothesis.shapes}
        sizes = {name: abs(self.shape[name]) if shapes[name].log else shapes[name].spacing for name in self.shape_std}
        told = all(std <= _VAGUE * sizes[name] for name, std in self.shape_std.items())
        return told and self.apart and not all(map(vague, self.main))


def vague(one: Value, part: float = _VAGUE) -> bool:
    """Whether its standard deviation is more than ``part`` of it."""
    return not one.value or (one.std or 0.0) > part * abs(one.value)
