"""Which hypotheses the data ask for: evidence, the held-out gate, exchange, refinement of shapes, pairs.

A hypothesis is taken when all of this holds: its drop of the white sum of squares is beyond chance for all that was
tried; it lowers the sum of squares of a run that was not fitted; it is not tiny beside the noise, nor beside what is
still unexplained; its coefficients are within their physical bounds and its shape not at the end of what was tried.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from identification.diagnosis.bank import Bank, Variant
from identification.diagnosis.hypothesis import Hypothesis
from identification.diagnosis.normal import Normal, Prior, bounded

Array = NDArray[np.float64]

#: Chance, over everything tried, that a name is given to nothing.
_ALPHA = 1e-3
#: Least drop of the validation's sum of squares, and its least part of what the fit promises.
_VALIDATED, _TRANSFERRED = 6.0, 0.25
#: Least size beside the noise, and least part of what is unexplained above it.
_FLOOR, _SHARE = 0.06, 0.01
#: What nearly every robot has: taken first, then challenged by everything else.
_COMMON = (
    "rotor_inertia",
    "viscous_friction",
    "coulomb_friction",
    "offset",
    "payload",
    "coupled_rotor",
    "gas_balancer",
    "spring_balancer",
)
_BALANCERS = ("gas_balancer", "spring_balancer")
#: What is unexplained, in parts of the noise, from which several effects must be missing.
_GROSS = 20.0
#: Laws are never exact: least part of what others explain on the same joint, and where they are friction of the speed.
_BESIDE, _ALIKE = 0.03, 0.15
_OF_SPEED = ("qd", "time since reversal")
#: By how much a challenger must be better, and how far an equal one may be behind, as a part of the evidence.
_BETTER, _EQUAL = 6.0, 0.01
#: Part of the evidence by which a rare effect must be better than a common one.
_RARE = 0.1
#: Part of a column's square that the model must leave for it to be seen.
_VISIBLE = 1e-4
#: Part of an effect by which runs may differ beyond chance: laws wander.
_UNLIKE = 0.25
_MOST, _ROUNDS = 18, 3
#: Hypotheses whose pairs are tried when single ones do not do.
_PAIRED = 20
#: Hypotheses, by what they explain, that are held against the validating runs.
_JUDGED = 16


@dataclass(frozen=True)
class Evidence:
    """What a variant explains beside the chosen ones: drop of the sum of squares, its p-value, BIC, validation."""

    variant: Variant
    coefficients: Array
    drop: float
    p: float
    bic: float
    validation: float
    size: float
    passes: bool
    why_not: str = ""

    @property
    def score(self) -> float:
        """Rank: information criterion and held-out drop together."""
        return self.bic + self.validation


@dataclass(frozen=True)
class Choice:
    """A variant that was taken, with its evidence beside the others and what may stand in its place."""

    evidence: Evidence
    alternatives: tuple[Evidence, ...] = ()


class Selection:
    """The search over a bank whose runs ``train`` are fitted and ``validate`` are not."""

    def __init__(self, bank: Bank, train: Sequence[int], validate: Sequence[int], prior: Prior | None) -> None:
        self.bank, self._train, self._validate, self._prior = bank, tuple(train), tuple(validate), prior
        self._tried = len({(one.hypothesis.effect, one.hypothesis.joint) for one in bank.variants})
        self._known_drops: dict[tuple[int, ...], list[float]] = {}
        self.refresh()

    def refresh(self) -> None:
        """After columns have been added."""
        p = len(self.bank.base)
        train, held = ([self.bank.grams[r] for r in runs] for runs in (self._train, self._validate))
        rows = sum(int(self.bank.rows(r).sum()) for r in self._train)
        others = sum(int(self.bank.rows(r).sum()) for r in self._validate)
        self.normal = Normal(np.sum(train, axis=0), p, rows, self._prior)
        self.held = Normal(np.sum(held, axis=0), p, others)
        self.all = Normal(self.normal.gram + self.held.gram, p, rows + others, self._prior)
        self._rows = np.sum([self.bank.rows(r) for r in self._train], axis=0)

    # -- evidence -------------------------------------------------------------------------------------------------

    def evidence(self, chosen: Sequence[Variant]) -> list[Evidence]:
        """Of the best variants of the hypotheses that are not chosen and explain most, the best first."""
        S = self.normal.beside(_columns(chosen))
        taken = {_key(one) for one in chosen}
        best: dict[tuple[str, int], tuple[float, Variant, Array]] = {}
        for variant in self.bank.variants:
            key = _key(variant)
            if key in taken:
                continue
            x, drop = self._solve(S, variant)
            if key not in best or drop > best[key][0]:
                best[key] = (drop, variant, x)
        unexplained = self.unexplained(chosen)
        ranked = sorted(best.values(), key=lambda one: -one[0])
        common = [one for one in ranked[_JUDGED:] if one[1].hypothesis.effect in _COMMON]
        found = [self._judged(one, chosen, unexplained) for one in (*ranked[:_JUDGED], *common) if one[0] > 0]
        return sorted(found, key=lambda one: -one.score)

    def of(self, variant: Variant, others: Sequence[Variant]) -> Evidence:
        """Evidence of one variant beside others."""
        x, drop = self._solve(self.normal.beside(_columns(others)), variant)
        return self._judged((drop, variant, x), others, self.unexplained(others))

    def unexplained(self, chosen: Sequence[Variant]) -> float:
        """What the sum of squares is above the noise."""
        solution, _ = self.normal.solution(_columns(chosen))
        return max(self.normal.misfit(_columns(chosen), solution) - self.normal.rows, 0.0)

    def _solve(self, S: Array, variant: Variant) -> tuple[Array, float]:
        at = np.array(variant.columns) - self.normal.base
        lower, upper = _bounds(variant)
        size = np.diag(self.normal.gram)[list(variant.columns)]
        return bounded(S[np.ix_(at, at)], S[at, -1], lower, upper, size)

    def _judged(self, found: tuple[float, Variant, Array], others: Sequence[Variant], unexplained: float) -> Evidence:
        drop, variant, x = found
        variant, x = variant.only(np.flatnonzero(x).tolist()), x[x != 0]
        used = len(x)
        tries = max(variant.hypothesis.tries, len(variant.hypothesis.variants))
        p = min(1.0, tries * float(chi2.sf(drop, max(used, 1))))
        bic = drop - used * np.log(self.normal.rows) - 2 * np.log(tries)
        rows = int(self._rows[list(variant.joints)].sum())
        size = float(np.sqrt(drop / max(rows, 1)))
        one = Evidence(variant, x, drop, p, bic, 0.0, size, False)
        if p * self._tried > _ALPHA:
            return replace(one, why_not="within chance")
        validation = self._validation(variant, others)
        one = replace(one, validation=validation)
        # While much is missing, the missing rest decides what a part of it does to another run.
        promised = drop * self.held.rows / self.normal.rows / (1 + unexplained / self.normal.rows)
        if validation < max(_VALIDATED, _TRANSFERRED * promised):
            return replace(one, why_not="does not help on a run that was not fitted")
        if size < _FLOOR or drop < _SHARE * unexplained:
            return replace(one, why_not="too small beside what is left")
        if drop < self._imperfect(variant, others):
            return replace(one, why_not="may be what another effect's law lacks")
        if _at_end(variant):
            return replace(one, why_not="its shape is at the end of what was tried")
        return replace(one, passes=True)

    def _imperfect(self, variant: Variant, others: Sequence[Variant]) -> float:
        """What the laws of others that act on the same joints may leave although they are the right ones."""
        least = 0.0
        if variant.hypothesis.effect in _COMMON:
            return least
        for other, drop in zip(others, self._drops(others), strict=True):
            if set(other.joints) & set(variant.joints):
                alike = variant.hypothesis.variable in _OF_SPEED and other.hypothesis.variable in _OF_SPEED
                least = max(least, (_ALIKE if alike else _BESIDE) * drop)
        return least

    def _drops(self, chosen: Sequence[Variant]) -> list[float]:
        """What each of the chosen explains beside the rest of them."""
        key = tuple(_columns(chosen))
        if key not in self._known_drops:
            self._known_drops[key] = [
                self._solve(self.normal.beside(_columns([one for one in chosen if one is not other])), other)[1]
                for other in chosen
            ]
        return self._known_drops[key]

    def _validation(self, variant: Variant, others: Sequence[Variant]) -> float:
        """Drop of the held-out sum of squares, with parameters from the fitted runs."""
        before = _columns(others)
        after = [*before, *variant.columns]
        misfits = [self.held.misfit(chosen, self.normal.solution(chosen)[0]) for chosen in (before, after)]
        return misfits[0] - misfits[1]

    # -- search ---------------------------------------------------------------------------------------------------

    def search(self, start: Sequence[Variant] = ()) -> list[Choice]:
        """Forward selection with exchange and refinement, then pairs where single hypotheses do not do."""
        chosen = list(start) or self._common_start()
        paired = False
        while len(chosen) < _MOST:
            passing = [one for one in self.evidence(chosen) if one.passes]
            common = [one for one in passing if one.variant.hypothesis.effect in _COMMON]
            first = next(iter([*common, *passing]), None)
            if first is None:
                pair = None if paired else self._pair(chosen)
                paired = True
                if pair is None:
                    break
                chosen += pair
            else:
                chosen.append(self._refined(first.variant, chosen))
            chosen = self._exchanged(chosen, chosen[-1], 1)
        chosen = self._exchanged(chosen, None, _ROUNDS)
        return [self._choice(one, [other for other in chosen if other is not one]) for one in chosen]

    def _common_start(self) -> list[Variant]:
        """Where far more is missing than one effect: all common ones together, and the best balancer; then without those
        that nothing speaks for. One after the other they hide each other.
        """
        if self.unexplained([]) < _GROSS * self.normal.rows:
            return []
        offered = [one for one in self.bank.variants if one.hypothesis.effect in _COMMON]
        chosen = [one for one in offered if one.hypothesis.effect not in _BALANCERS]
        S = self.normal.beside(_columns(chosen))
        balancers = [one for one in offered if one.hypothesis.effect in _BALANCERS]
        chosen += sorted(balancers, key=lambda one: -self._solve(S, one)[1])[:1]
        while chosen:
            found = [self.of(one, [other for other in chosen if other is not one]) for one in chosen]
            failing = [k for k, one in enumerate(found) if not one.passes]
            if not failing:
                chosen = [one.variant for one in found]
                break
            del chosen[min(failing, key=lambda k: found[k].drop)]
        return [self._refined(one, [other for other in chosen if other is not one]) for one in chosen]

    def _exchanged(self, chosen: list[Variant], new: Variant | None, rounds: int) -> list[Variant]:
        """Each one that shares a joint with ``new`` (all if None) challenged with the others in place; dropped when its
        evidence is gone.
        """
        for _ in range(rounds):
            before = list(chosen)
            for one in before:
                if one not in chosen or (new is not None and not set(one.joints) & set(new.joints)):
                    continue
                others = [other for other in chosen if other is not one]
                refined = one
                mine = self.of(one, others)
                best = self._challenger(mine, others)
                if best is not None:
                    refined = self._refined(best.variant, others)
                    mine = self.of(refined, others)
                place = chosen.index(one)
                chosen[place : place + 1] = [mine.variant] if mine.passes else []
            if chosen == before:
                break
        return chosen

    def _challenger(self, mine: Evidence, others: Sequence[Variant]) -> Evidence | None:
        """What should stand in the place of ``mine``: clearly better, or common and nearly as good as what is not."""
        passing = [one for one in self.evidence(others) if one.passes and _key(one.variant) != _key(mine.variant)]
        common = mine.variant.hypothesis.effect in _COMMON
        for one in passing:
            margin = _BETTER
            if common and one.variant.hypothesis.effect not in _COMMON:
                margin += _RARE * mine.drop
            elif not common and one.variant.hypothesis.effect in _COMMON:
                margin -= _RARE * mine.drop
            if not mine.passes or one.score > mine.score + margin:
                return one
        return None

    def _refined(self, variant: Variant, others: Sequence[Variant]) -> Variant:
        """With shapes between the tried ones where they explain more."""
        best = variant
        score = self.of(best, others).drop
        for shape in variant.hypothesis.shapes:
            points = shape.grid()
            if shape.whole or len(points) < 3:
                continue
            log = min(points) > 0
            scale = np.log if log else np.asarray
            step = 0.5 * float(np.median(np.diff(np.sort(scale(points)))))
            for _ in range(3):
                here = float(scale(best.shape[shape.name]))
                for x in (here - step, here + step):
                    value = float(np.exp(x)) if log else x
                    tried = self.bank.add(variant.hypothesis, {**best.shape, shape.name: value})
                    if tried is None:
                        continue
                    tried = tried.only(variant.used)
                    self.refresh()
                    drop = self.of(tried, others).drop
                    if drop > score + 0.5:
                        best, score = tried, drop
                step /= 2
        return best

    def _pair(self, chosen: Sequence[Variant]) -> list[Variant] | None:
        """Two that explain together what neither may alone."""
        single = self.evidence(chosen)[:_PAIRED]
        S = self.normal.beside(_columns(chosen))
        best: tuple[float, list[Variant]] = (0.0, [])
        for one, other in combinations([each.variant for each in single], 2):
            at = np.array([*one.columns, *other.columns]) - self.normal.base
            bounds = [np.concatenate(pair) for pair in zip(_bounds(one), _bounds(other), strict=True)]
            size = np.diag(self.normal.gram)[[*one.columns, *other.columns]]
            _, drop = bounded(S[np.ix_(at, at)], S[at, -1], bounds[0], bounds[1], size)
            if drop > best[0]:
                best = (drop, [one, other])
        pair = best[1]
        if pair and all(self.of(one, [*chosen, other]).passes for one, other in (pair, pair[::-1])):
            return pair
        return None

    def _choice(self, one: Variant, others: Sequence[Variant]) -> Choice:
        mine = self.of(one, others)
        near = [
            other
            for other in self.evidence(others)
            if _key(other.variant) != _key(one)
            and other.passes
            and other.score > mine.score - max(_EQUAL * mine.drop, 2.0)
        ]
        return Choice(mine, tuple(near))

    def homogeneous(self, variant: Variant, others: Sequence[Variant]) -> bool:
        """Whether the runs agree on one amplitude: each run's own along the common one, within four deviations."""
        chosen = [*_columns(others), *variant.columns]
        solution, _ = self.normal.solution(chosen)
        theta = solution[-len(variant.columns) :]
        amplitudes, variances = [], []
        for r in self._train:
            G = self.bank.grams[r]
            at = list(variant.columns)
            effect = G[:, at] @ theta
            power = float(theta @ effect[at])
            rest = np.zeros(len(G))
            rest[[*range(self.normal.base), *chosen]] = -solution
            rest[-1] = 1.0
            if power <= 1.0:
                continue
            amplitudes.append(float(effect @ rest) / power)
            variances.append(1 / power)
        if len(amplitudes) < 2:
            return True
        weight = 1 / np.array(variances)
        mean = float(weight @ amplitudes / weight.sum())
        off = np.abs(np.array(amplitudes) - mean)
        return bool(np.all(off < 4 * np.sqrt(variances) + _UNLIKE))

    # -- what cannot be seen --------------------------------------------------------------------------------------

    def invisible(self) -> list[Hypothesis]:
        """Hypotheses of which, with most of their shapes, the model takes up all but a hundredth."""
        left: dict[tuple[str, int], list[float]] = {}
        whose: dict[tuple[str, int], Hypothesis] = {}
        for variant in self.bank.variants:
            key = _key(variant)
            at = np.array(variant.columns) - self.normal.base
            left.setdefault(key, []).append(float(self.normal.left[at].max()))
            whose[key] = variant.hypothesis
        return [whose[key] for key, parts in left.items() if np.median(parts) < _VISIBLE]


def _key(variant: Variant) -> tuple[str, int]:
    return variant.hypothesis.effect, variant.hypothesis.joint


def _columns(chosen: Sequence[Variant]) -> list[int]:
    return [number for one in chosen for number in one.columns]


def _bounds(one: Variant) -> tuple[Array, Array]:
    lower = np.array([-np.inf if c.lower is None else c.lower for c in one.coefficients])
    upper = np.array([np.inf if c.upper is None else c.upper for c in one.coefficients])
    return lower, upper


def _at_end(variant: Variant) -> bool:
    """Whether a shape is at or beyond the end of what was tried: then it is another effect."""
    for shape in variant.hypothesis.shapes:
        points = shape.grid()
        if shape.whole or len(points) < 4 or min(points) <= 0:
            continue
        value = variant.shape[shape.name]
        if value <= min(points) * 0.7 or value >= max(points) * 1.4:
            return True
    return False
