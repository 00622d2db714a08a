"""What speaks for a hypothesis beside others: its drop of the sum of squares, chance, and a run that was not fitted.

A hypothesis may be taken when nothing speaks against it. ``Weighing._judged`` asks in this order: chance, for all that
was tried; another effect, known friction or noise of the positions, of which its drop may be a part; a run that was not
fitted; its size, beside the noise and beside what is still unexplained; what laws that were taken lack; what the
joint's friction lacks; the end of what was tried of its shape; and joints of few rows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from scipy.stats import chi2

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank, Variant, columns_of
from identification.diagnosis.columns.growing import Products
from identification.diagnosis.columns.hypothesis import BODY, LOAD, Key
from identification.diagnosis.columns.normal_equations import (
    FAR,
    Normal,
    Places,
    Prior,
    after,
    inverse,
    square,
    told_apart,
)
from identification.diagnosis.noise.errors_in_variables import Pretence, Redrawn, redrawn
from identification.diagnosis.search import known_friction, more_friction
from identification.diagnosis.search.beyond_laws import BeyondLaws
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.few_rows import few_rows, small
from identification.diagnosis.search.held_out import HeldOut
from identification.diagnosis.search.imperfect_laws import lacking
from identification.diagnosis.search.likely import common, likely
from identification.diagnosis.search.tried import at_end, chance

#: Drop of the sum of squares, variant, coefficients.
_Found = tuple[float, Variant, Array]

#: Chance, over everything tried, that a name is given to nothing.
_ALPHA = 1e-3
#: Least drop of the validation's sum of squares, and its least part of what the fit promises.
_VALIDATED, _TRANSFERRED = 6.0, 0.25
#: Part of a column's square that a fit which knows nothing beforehand leaves of it, below which what is known shows it
#: alone; the standard deviations by which the validation's drop may then be less than promised; and those within which
#: runs agree with a known value that they contradicted.
_UNSEEN, _CHANCE, _AGREED = 0.01, 2.0, 2.5
#: Least whole size beside the noise of common and of other effects; and least part of what is unexplained above it, of
#: common ones, of others that are likely, and of the rest.
_FLOOR, _RARE_FLOOR, _SHARE, _LIKELY_SHARE, _RARE_SHARE = 0.06, 0.15, 0.01, 0.05, 0.1
#: A power that is none.
_TINY = 1e-300
#: Part of what an effect explains that it explains without what refines it, and the same of a body beside known ones:
#: the runs may outweigh what is known of these where it shows as its weight does, and not where as its products.
_MAIN, _MAIN_OF_BODY = 0.5, 0.1
#: Part of what an effect explains that is not of the noise of positions.
_TRUE = 0.5
#: Hypotheses, by what they explain, that are tried on the validating runs.
_JUDGED = 16
#: Shapes of a hypothesis that are, and by what part of the best one's drop they may explain less.
_SHAPES, _NEAR = 6, 0.03


class Weighing:
    """Evidence from a bank whose runs ``train`` are fitted and ``validate`` are not.

    Without any to validate each fitted run is predicted by the others. ``noisy`` are runs, by number, with the noise
    of their positions once more. The fit is a ``free`` one where a ``prior`` is of what the robot's file states alone.
    """

    def __init__(
        self,
        bank: Bank,
        train: Sequence[int],
        validate: Sequence[int],
        prior: Prior | None,
        noisy: Mapping[int, Redrawn] | None = None,
        free: bool = False,
    ) -> None:
        self.bank, self.train, self.validate, self._prior = bank, tuple(train), tuple(validate), prior
        self.free = free or prior is None
        self._tried = _keys(bank)
        self._held_out = HeldOut(bank, train, validate, prior)
        self._noisy = dict(noisy or {})
        #: By the columns of each of those chosen, of which one at its bounds has none.
        self._known_drops: dict[tuple[tuple[int, ...], ...], list[float]] = {}
        self.normal = self._normal(self.train)
        self._products = Products(self.normal.gram)
        self._pretence = self._pretence_along(self.train, self.normal)
        self.rows = np.sum([bank.rows(r) for r in self.train], axis=0)
        self._seen = bank.count
        self.few = few_rows(bank)

    def along(self, bank: Bank) -> Weighing:
        """The same of another bank of the runs."""
        noisy = redrawn(bank.runs, bank.scenes)
        return Weighing(bank, self.train, self.validate, self._prior, noisy, self.free)

    def refresh(self) -> None:
        """After columns may have been added."""
        seen, self._seen = self._seen, self.bank.count
        if seen < self._seen:
            gram = self._products.join(self._seen - seen)
            gram[seen:-1] = np.sum([self.bank.grams[r][seen:-1] for r in self.train], axis=0)
            gram[:, seen:-1] = gram[seen:-1].T
            self.normal = self.normal.grown(gram)
            self._tried = _keys(self.bank)

    @property
    def all(self) -> Normal:
        """Of the fitted and the validating runs."""
        return self._normal((*self.train, *self.validate))

    def fitted(self, variants: Sequence[Variant], with_validating: bool = False) -> tuple[Array, Array]:
        """Base parameters and the coefficients of ``variants`` (p + k), fitted to the runs that train, or to those that
        validate as well, without what noise of the positions takes of them, which moves no coefficient beyond its
        bounds; and their covariance.
        """
        normal, pretence = (self.all, self._pretence_of_all) if with_validating else (self.normal, self._pretence)
        solution, covariance = normal.solution(columns_of(variants))
        if pretence.nothing or not len(solution):
            return solution, covariance
        corrected = solution - covariance @ pretence.beside(variants)
        for i, (lower, upper) in enumerate(pair for one in variants for pair in zip(*one.bounds, strict=True)):
            corrected[normal.base + i] = np.clip(corrected[normal.base + i], lower, upper)
        return corrected, covariance

    @cached_property
    def _pretence_of_all(self) -> Pretence:
        return self._pretence_along((*self.train, *self.validate), self.all)

    def _pretence_along(self, runs: Sequence[int], normal: Normal) -> Pretence:
        noisy = {r: self._noisy[r] for r in runs if r in self._noisy}
        return Pretence(self.bank, noisy, normal.whole[: normal.base, : normal.base])

    def fitted_to(self, runs: Sequence[int], variants: Sequence[Variant]) -> dict[int, float]:
        """Values of the base columns and of those of ``variants``, by number, fitted to some runs."""
        return self._normal(runs).by_number(columns_of(variants))

    def _normal(self, runs: Sequence[int]) -> Normal:
        rows = sum(int(self.bank.rows(r).sum()) for r in runs)
        return Normal(self._gram(runs), len(self.bank.base), rows, self._prior, self.bank.preset)

    def _gram(self, runs: Sequence[int]) -> Array:
        total = self.bank.grams[runs[0]].copy()
        for r in runs[1:]:
            total += self.bank.grams[r]
        return total

    def evidence(self, chosen: Sequence[Variant]) -> list[Evidence]:
        """Of the best variants of the hypotheses that are not chosen and explain most, the best first."""
        S = self.normal.beside(columns_of(chosen))
        taken = {one.key for one in chosen}
        found: dict[Key, list[_Found]] = {}
        for variant in self.bank.variants:
            key = variant.key
            if key not in taken:
                x, drop = self._solve(S, variant)
                found.setdefault(key, []).append((drop, variant, x))
        unexplained = self.unexplained(chosen)
        ranked = sorted(found.values(), key=lambda shapes: -max(drop for drop, *_ in shapes))
        first = [shapes for shapes in ranked[_JUDGED:] if likely(shapes[0][1], chosen)]
        judged = [self._best(shapes, chosen, unexplained) for shapes in (*ranked[:_JUDGED], *first)]
        return sorted((one for one in judged if one.drop > 0), key=lambda one: -one.score)

    def best_shape(self, variants: Sequence[Variant], others: Sequence[Variant]) -> Evidence:
        """Of the variant that explains most; among nearly equal ones a run that was not fitted decides."""
        S = self.normal.beside(columns_of(others))
        found = [(drop, variant, x) for variant in variants for x, drop in [self._solve(S, variant)]]
        return self._best(found, others, self.unexplained(others))

    def _best(self, found: Sequence[_Found], others: Sequence[Variant], unexplained: float) -> Evidence:
        ranked = sorted(found, key=lambda one: -one[0])
        least = (1 - _NEAR) * ranked[0][0]
        near = [one for one in ranked if one[0] >= least][:_SHAPES]
        return max((self._judged(one, others, unexplained) for one in near), key=lambda one: one.score)

    def of(self, variant: Variant, others: Sequence[Variant]) -> Evidence:
        """Evidence of one variant beside others."""
        x, drop = self.beside(variant, others)
        return self._judged((drop, variant, x), others, self.unexplained(others))

    def beside(self, variant: Variant, others: Sequence[Variant]) -> tuple[Array, float]:
        """Coefficients of a variant beside others, within their bounds, and the drop of the sum of squares."""
        part = self.normal.part(variant.columns, columns_of(others))
        return variant.best(part[:-1, :-1], part[:-1, -1], self.normal.least(variant.columns))

    def gain(self, variant: Variant, others: Sequence[Variant]) -> float:
        """Drop of the sum of squares of what was not fitted."""
        return self._held_out.gain(variant, self.beside(variant, others)[0], columns_of(others))[0]

    def unexplained(self, chosen: Sequence[Variant]) -> float:
        """What the sum of squares is above the noise."""
        return max(self.misfit(chosen) - self.normal.rows, 0.0)

    def misfit(self, chosen: Sequence[Variant]) -> float:
        """The sum of squares that is left, without that of known values."""
        solution, _ = self.normal.solution(columns_of(chosen))
        return self.normal.misfit(columns_of(chosen), solution)

    def _solve(self, S: Array, variant: Variant) -> tuple[Array, float]:
        at = np.array(variant.columns) - self.normal.base
        return variant.best(square(S, at), S[at, -1], self.normal.least(variant.columns))

    def _judged(self, found: _Found, others: Sequence[Variant], unexplained: float) -> Evidence:
        drop, variant, x = self._asked_for(found, others)
        variant, x = variant.only(np.flatnonzero(x).tolist()), x[x != 0]
        p = chance(drop, variant)
        bic = drop - self.price(variant)
        believed = not self.free or variant.believed(x)
        one = Evidence(variant, x, drop, p, bic, 0.0, self._sizes(drop, variant, x, others), False, "", believed)
        if p * self._tried > _ALPHA:
            return replace(one, why_not="within chance")
        if not self._itself(drop, variant, others):
            return replace(one, why_not="what it explains is another effect")
        if not self._beyond_friction(drop, variant, others):
            return replace(one, why_not="what it explains is another value of friction that is known")
        # What another fit tells it tells with the noise of the positions alike at every value.
        true = drop if variant.preset is not None else self._without_position_noise(variant, others)
        if true < _TRUE * drop or chance(true, variant) * self._tried > _ALPHA:
            return replace(one, why_not="what it explains is noise of the positions")
        validation, promised = self._held_out.gain(variant, x, columns_of(others))
        one = replace(one, validation=validation)
        # While much is missing, the missing rest decides what a part of it does to another run.
        promised /= 1 + unexplained / self.normal.rows
        if validation < self._asked_of_others(variant, others, promised):
            return replace(one, why_not="does not help on a run that was not fitted")
        if one.whole < (_FLOOR if common(variant) else _RARE_FLOOR):
            return replace(one, why_not="smaller than what is named")
        share = _SHARE if common(variant) else _LIKELY_SHARE if likely(variant, others) else _RARE_SHARE
        if drop < share * unexplained:
            return replace(one, why_not="too small beside what is left")
        drops = self._drops(others)
        laws = BeyondLaws(self.bank, self.normal, self.train)
        if drop < lacking(variant, others, drops) and not laws.explains(variant, drop, others, drops):
            return replace(one, why_not="may be what another effect's law lacks")
        more = more_friction.adds(variant, others)
        if more and drop < more_friction.left(self.bank, self.normal, self.train, variant, others):
            return replace(one, why_not="may be a part of what the joint's friction lacks")
        if at_end(variant):
            return replace(one, why_not="its shape is at the end of what was tried")
        if small(one, self.few):
            return replace(one, why_not="small beside what noise of few rows may hold", small=True)
        return replace(one, passes=True)

    def cost(self, chosen: Sequence[Variant]) -> float:
        """The sum of squares that is left, with that of known values and the price of what was chosen: the less, the
        better.
        """
        return float(self.normal.part([], columns_of(chosen))[0, 0]) + sum(map(self.price, chosen))

    def price(self, variant: Variant) -> float:
        """What the information criterion charges for the values that are fitted and the shapes that are tried."""
        free = len(variant.columns) + variant.hypothesis.free
        return float(free * np.log(self.normal.rows) + 2 * np.log(variant.tries))

    def _asked_of_others(self, variant: Variant, others: Sequence[Variant], promised: float) -> float:
        """The least drop of the sum of squares of what was not fitted, of a variant beside ``others``.

        What only the prior tells from the base parameters the fitted runs may show to the end: however much a run that
        was not fitted holds of it, it adds little, with a standard deviation of twice the root of what is promised.
        """
        if _TRANSFERRED * promised < _VALIDATED and self._by_prior(variant, others):
            return promised - _CHANCE * 2 * float(np.sqrt(max(promised, 0.0)))
        return max(_VALIDATED, _TRANSFERRED * promised)

    def _by_prior(self, variant: Variant, others: Sequence[Variant]) -> bool:
        """Whether a fit that knows nothing beforehand takes up what a variant makes, and it tells why the runs
        contradict more values that are known than it has coefficients, or that of which it is another value, and makes
        them contradict no other.
        """
        if self.free or self._prior is None:
            return False
        p, G = self.normal.base, self.normal.gram
        at = np.array([*range(p), *variant.columns])
        left = after(square(G, at), p).diagonal()
        if np.any(left > _UNSEEN * G.diagonal()[at[p:]]):
            return False
        solutions = [self.normal.solution(columns_of(each)) for each in (others, [*others, variant])]
        far, near = (self._prior.far(x[:p], covariance[:p, :p])[self._parameters] for x, covariance in solutions)
        told = (far > FAR) & (near < _AGREED)
        own = [self.bank.base.index(one.name) for one in variant.coefficients if variant.hypothesis.of_parameter]
        enough = told[own].all() if own else told.sum() > len(variant.columns) + variant.hypothesis.free
        return bool(enough and not np.any((near > FAR) & (far < FAR)))

    @property
    def _parameters(self) -> slice:
        """Places of the base parameters, after which come values of the file's elastic drive trains."""
        return slice(len(self.bank.scenes[0].regressors.names))

    def _sizes(self, drop: float, variant: Variant, x: Array, others: Sequence[Variant]) -> dict[int, float]:
        """By coordinate, the rms beside the noise's of what lowers the sum of squares: it is shared by the joints as
        that is which the model and ``others`` leave of the torque of coefficients x.
        """
        rows = {k: max(self.rows[k], 1) for k in variant.coordinates}
        if len(rows) == 1:
            return {k: float(np.sqrt(drop / count)) for k, count in rows.items()}
        weights = dict(zip(variant.columns, x.tolist(), strict=True))
        power = self.powers(weights, self._fitted_beside(others), variant.coordinates)
        whole = max(sum(power.values()), _TINY)
        return {k: float(np.sqrt(drop * power[k] / whole / count)) for k, count in rows.items()}

    def powers(self, weights: Mapping[int, float], beside: Places, joints: Sequence[int]) -> dict[int, float]:
        """By coordinate, the white sum of squares of what the columns ``beside`` leave, where they are fitted, of other
        columns by number times their ``weights``.
        """
        own, G = np.array([*weights], dtype=int), self.normal.whole
        taken = inverse(square(G, beside)) @ (G[np.ix_(beside, own)] @ [*weights.values()])
        left = dict(zip((*weights, *beside.tolist()), (*weights.values(), *-taken), strict=True))
        return {k: self.bank.power(left, k, self.train) for k in joints}

    def _fitted_beside(self, others: Sequence[Variant]) -> Places:
        """The columns that are fitted beside a variant, by number."""
        return told_apart(self.normal.numbers(columns_of(others)), self.normal.preset)[0]

    def _asked_for(self, found: _Found, others: Sequence[Variant]) -> _Found:
        """Without coefficients that only refine, where they explain chance, or more than what they refine.

        Once what they refine is at its bounds, and gone, they are all that is left.
        """
        drop, variant, x = found
        kept = [i for i, one in enumerate(variant.coefficients) if not one.refines]
        if not kept or len(kept) == len(x):
            return found
        plain = variant.only(kept)
        values, less = self.beside(plain, others)
        body = variant.hypothesis.kind in (BODY, LOAD) and not self.free
        main = _MAIN_OF_BODY if body else _MAIN
        refined = chi2.sf(drop - less, len(x) - len(kept)) < _ALPHA and less > main * drop
        return found if refined else (less, plain, values)

    def _itself(self, drop: float, variant: Variant, others: Sequence[Variant]) -> bool:
        """Whether the essential coefficients explain beyond chance, and a part of it, what the others do not."""
        if not any(one.essential for one in variant.hypothesis.coefficients):
            return True
        rest = [i for i, one in enumerate(variant.coefficients) if not one.essential]
        less = self.beside(variant.only(rest), others)[1] if rest else 0.0
        count = len(variant.columns) - len(rest)
        return _beyond(drop, less, count)

    @cached_property
    def _friction(self) -> Places:
        return known_friction.friction(self.bank.robot, self.bank.base)

    def _beyond_friction(self, drop: float, variant: Variant, others: Sequence[Variant]) -> bool:
        """Whether it explains beyond chance, and a part of it, what no other value does of friction of which something
        is known.
        """
        if self.free:
            return True
        less, same = known_friction.explained(self.normal, variant.columns, columns_of(others), self._friction)
        return not same or _beyond(drop, less, len(variant.columns) - same)

    def _without_position_noise(self, variant: Variant, others: Sequence[Variant]) -> float:
        """What a variant explains beside others without what noise of the positions makes it explain."""
        part = self.normal.part(variant.columns, columns_of(others))
        products = part[:-1, -1] - self.pretended(variant, others)
        return variant.best(part[:-1, :-1], products, self.normal.least(variant.columns))[1]

    def pretended(self, variant: Variant, others: Sequence[Variant]) -> Array:
        """Of the products of a variant's columns beside others with the torque, what noise of the positions makes
        (k): the columns beside which they stand are of the same positions.
        """
        if self._pretence.nothing:
            return np.zeros(len(variant.columns))
        every, G = self.normal.numbers(columns_of(others)), self.normal.whole
        beside = self._fitted_beside(others)
        explained = inverse(square(G, beside)) @ self._pretence.beside(others)[np.isin(every, beside)]
        return np.asarray(self._pretence.of(variant) - G[np.ix_(np.array(variant.columns), beside)] @ explained)

    def _drops(self, chosen: Sequence[Variant]) -> list[float]:
        """What each of the chosen explains beside the rest of them."""
        key = tuple(one.columns for one in chosen)
        if key not in self._known_drops:
            self._known_drops[key] = [
                self.beside(other, [one for one in chosen if one is not other])[1] for other in chosen
            ]
        return self._known_drops[key]

    def visible(self, variant: Variant) -> bool:
        """Whether the model leaves a part of the torque that it would make."""
        return not all(map(self.normal.hides, variant.columns))


def _keys(bank: Bank) -> int:
    """How many hypotheses its variants are of."""
    return len({one.key for one in bank.variants})


def _beyond(drop: float, less: float, count: int) -> bool:
    """Whether ``count`` more coefficients explain beyond chance, and a part of it, what others explain ``less`` of."""
    return bool(count > 0 and drop - less > _SHARE * drop and chi2.sf(drop - less, count) < _ALPHA)
