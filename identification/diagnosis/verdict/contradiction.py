"""Values that were known beforehand and that the runs contradict.

An effect of a joint may have another value than it once had; where a body has, that may stand for what is missing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from generator.effects.library import effects_of, library, names_of_effects
from generator.review.decimals import scientific
from generator.words import listed
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import EFFECT, SHAPE
from identification.diagnosis.columns.normal_equations import FAR, Prior, inverse
from identification.diagnosis.search import known_friction
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.alternatives import OTHER_FRICTION, outside
from identification.diagnosis.verdict.finding import Finding

#: How many values are told by name.
_NAMED = 6
#: Standard deviations within which a value is the known one.
_AGREED = 3.0
#: Part of a joint's largest speed from which it is fast, and that by which what friction has risen to differs there.
_FAST, _ALIKE = 0.4, 0.05
#: Torque of a difference that is little, in parts of the noise's rms.
_LITTLE = 0.2


@dataclass(frozen=True)
class Contradicted:
    """A base parameter, by its ``place``, that the runs say is ``found``, where ``known`` +- ``std`` was stated [SI];
    ``body`` tells whether it is of bodies and of no effect alone, ``rubs`` on which joint it is friction, 0 on none.
    """

    name: str
    place: int
    found: float
    known: float
    std: float
    body: bool
    rubs: int

    def agrees(self, value: float) -> bool:
        """Whether a value is what is known."""
        return abs(value - self.known) <= _AGREED * self.std

    @property
    def text(self) -> str:
        """``Fv1 14.1, not 7 +- 0.35``."""
        return f"{self.name} {scientific(self.found, 3)}, not {scientific(self.known, 3)} +- {scientific(self.std, 2)}"


def contradicted(found: Search, prior: Prior | None) -> tuple[Contradicted, ...]:
    """The base parameters that are farther from what was known than that and the runs leave uncertain, the farthest
    first.
    """
    if prior is None:
        return ()
    names = found.bank.base[: len(prior.mean)]
    before = np.diag(inverse(prior.precision))
    values = np.array([found.values[name] for name in names])
    far = prior.far(values, found.covariance[: len(names), : len(names)])
    stated, effects = effects_of(found.bank.robot), names_of_effects(found.bank.robot)
    rubs = {name: one.joint.number for one in stated if one.effect.dissipates for name in one.names}
    return tuple(
        Contradicted(
            names[i],
            i,
            float(values[i]),
            float(prior.mean[i]),
            float(np.sqrt(before[i])),
            names[i] not in effects,
            rubs.get(names[i], 0),
        )
        for i in np.argsort(-far).tolist()
        if far[i] > FAR
    )


def doubted(found: Search, named: Sequence[Finding], ones: Sequence[Contradicted]) -> tuple[Finding, ...]:
    """What was found, a friction tentative where known friction of its joint is contradicted: the right law leaves that
    as it is known, unless it is the same law, told by directions, or what was found on the joint takes its place: where
    the joint is fast all together is then as much.
    """
    rubbing = [(one, every) for one in named if (every := _friction(found, one)) is not None]
    staying = [each for each in ones if each.rubs and not each.agrees(each.found + _instead(found, rubbing, each))]
    of_friction = {id(one): _instead_of(found, one, every, staying) for one, every in rubbing}
    return tuple(_of_another_law(one, of_friction.get(id(one), ())) for one in named)


def _of_another_law(one: Finding, names: Sequence[str]) -> Finding:
    """Tentative where a law of another form would leave known values, by their ``names``, as they are."""
    if not names:
        return one
    speeds = "constant speeds both ways, from creeping to fast: they show friction over the speed, whatever its law"
    other = outside(OTHER_FRICTION, "friction by another law", one.joints, one.evidence, speeds)
    why = f"the runs contradict {listed(names)}, which another law may leave as known"
    return one.doubted(why, alternatives=[other])


def _friction(found: Search, one: Finding) -> Variant | None:
    """A finding with all its columns, if it is friction."""
    effect = library().get(one.hypothesis.effect) if one.hypothesis.kind in (EFFECT, SHAPE) else None
    return found.bank.add(one.hypothesis, one.shape) if effect is not None and effect.dissipates else None


def _instead_of(found: Search, one: Finding, every: Variant, ones: Sequence[Contradicted]) -> list[str]:
    """Names of contradicted friction in whose place a friction may stand that was found, with ``every`` column."""
    there = [each for each in ones if each.rubs == one.hypothesis.joint]
    places = np.array([each.place for each in there], dtype=int)
    alike = known_friction.alike(found.weighing.normal, every.columns, places).tolist()
    return [each.name for each in there if each.place not in alike]


def _instead(found: Search, rubbing: Sequence[tuple[Finding, Variant]], one: Contradicted) -> float:
    """How much of a friction what was found on its joint makes, in its unit, where the joint is fast."""
    return sum(_risen(found, each, every, one) for each, every in rubbing if each.hypothesis.joint == one.rubs)


def _risen(found: Search, finding: Finding, every: Variant, one: Contradicted) -> float:
    """How much of a friction a finding makes, with ``every`` column, where their joint is fast: nothing, unless that is
    the same on all rows, as of friction that has risen to Coulomb's.
    """
    bank, k = found.bank, found.bank.robot.numbers.index(one.rubs)
    values = np.array([finding.parameters[c.name].value or 0.0 for c in every.coefficients])
    parts = []
    for r in found.train:
        run = bank.runs[r]
        speed = np.abs(run.decimated(bank.scenes[r].motion.qd)[k])
        fast = run.kept[k] & (speed > _FAST * speed.max())
        (known,), torques = (bank.columns(r, k, numbers)[:, fast] for numbers in ([one.place], every.columns))
        parts.append(values @ torques / np.where(known, known, np.inf))
    ratios = np.concatenate(parts)
    mean = float(np.mean(ratios)) if len(ratios) else 0.0
    return mean if mean and np.ptp(ratios) <= _ALIKE * abs(mean) else 0.0


def pulled(found: Search, ones: Sequence[Contradicted]) -> int | None:
    """The coordinate on which other values of bodies than the known ones make most torque beside the noise that no
    other parameter stands for; None where it is little.
    """
    weighing, joints = found.weighing, range(found.bank.dof)
    weights = {one.place: one.found - one.known for one in ones if one.body}
    others = np.setdiff1d(np.arange(len(found.bank.base)), [*weights])
    power = weighing.powers(weights, others, joints)
    size = np.sqrt([power[k] / max(weighing.rows[k], 1) for k in joints])
    most = int(np.argmax(size))
    return most if size[most] > _LITTLE else None


def note(ones: Sequence[Contradicted]) -> list[str]:
    """What is to be told of them."""
    if not ones:
        return []
    told = [one.text for one in ones[:_NAMED]]
    more = len(ones) - len(told)
    rest = [f"{more} more"] if more else []
    return [
        f"the runs contradict values that are known: {listed([*told, *rest])}; the new set is fitted anew, between both"
    ]
