"""Which hypotheses the data ask for: forward selection with exchange, refinement of shapes, and pairs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import inf

import numpy as np

from identification.diagnosis.columns.bank import Variant, columns_of
from identification.diagnosis.columns.hypothesis import Key
from identification.diagnosis.columns.normal_equations import bounded, square
from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.likely import balances, common, likely, misplaces, pulls
from identification.diagnosis.search.refinement import refined
from identification.diagnosis.search.scaling import scales_all
from identification.diagnosis.search.sliding import replaces
from identification.diagnosis.search.swings_heard import heard
from identification.diagnosis.search.valleys import Valleys
from identification.diagnosis.search.weighing import Weighing
from identification.diagnosis.search.whole_orders import nearest, odds

#: What is unexplained, in parts of the noise, from which several effects must be missing.
_GROSS = 20.0
#: By how much a challenger must be better, and how far an equal one may be behind, as a part of the evidence.
_BETTER, _EQUAL = 6.0, 0.01
#: Part of the evidence by which a rare effect must be better than a common one.
_RARE = 0.1
#: Most effects that are not common, of a robot and of a joint; rounds of exchange at the end.
_MOST, _MOST_OF_JOINT, _ROUNDS = 12, 3, 3
#: Rivals of a choice whose shapes are refined before they are compared, and the part of its drop that they must have;
#: the same part of a rare effect's for a common one to be preferred.
_RIVALS, _RIVAL = 3, 0.4
#: Falls for each effect that was chosen, up to which what falls is replaced.
_REPLACED = 3
#: Hypotheses whose pairs are tried when single ones do not do.
_PAIRED = 20


@dataclass(frozen=True)
class Choice:
    """A variant that was taken, with its evidence beside the others and what may stand in its place.

    ``odds`` are those of its whole orders against what lies between, infinite where it has none. ``apart`` tells
    whether no other of the shapes that are tried alone explains as much.
    """

    evidence: Evidence
    alternatives: tuple[Evidence, ...] = ()
    odds: float = inf
    apart: bool = True


class Selection:
    """The search for what is missing, by the evidence that ``weighing`` finds."""

    def __init__(self, weighing: Weighing) -> None:
        self.weighing = weighing
        #: Odds of whole orders, by the columns and those beside them.
        self._odds: dict[tuple[tuple[int, ...], tuple[int, ...]], float] = {}
        self._valleys = Valleys(weighing)

    def search(self, start: Sequence[Variant] = ()) -> list[Choice]:
        """Forward selection with exchange and refinement, then pairs where single hypotheses do not do. What passes of
        ``start`` is returned instead if the result is clearly worse.
        """
        chosen = list(start) or self._first()
        paired = False
        seen: set[frozenset[Key]] = set()
        refused: set[Key] = set()
        most = max(_MOST, _MOST_OF_JOINT * self.weighing.bank.dof)
        while sum(not common(one) for one in chosen) < most:
            known = frozenset(one.key for one in chosen)
            if known in seen:
                break
            offered = [one for one in self.weighing.evidence(chosen) if one.variant.key not in refused]
            offered.sort(key=lambda one: not likely(one.variant, chosen))
            whole = (self._whole(one, chosen) for one in offered if one.passes)
            first = next((one for one in whole if self._sound(one, chosen)), None)
            if first is None:
                pair = None if paired else self._pair(chosen)
                paired = True
                if pair is None:
                    break
                chosen += pair
            else:
                chosen.append(self._shaped(first.variant, chosen))
            chosen = self._exchanged(chosen, chosen[-1], 1)
            if first is not None and frozenset(each.key for each in chosen) == known:
                refused.add(first.variant.key)
            else:
                seen.add(known)
                refused.clear()
        found = self.choices(self._exchanged(chosen, None, _ROUNDS), replacing=True)
        lost = {one.key for one in start} - {one.evidence.variant.key for one in found}
        begun = self.standing(start) if lost else []
        return self.choices(begun) if self._lost([one.evidence.variant for one in found], begun) else found

    def _lost(self, found: Sequence[Variant], begun: Sequence[Variant]) -> bool:
        """Whether some of ``begun`` is not ``found`` any more, and what is found costs more than ``begun`` by more than
        may be given up for common effects.
        """
        if {one.key for one in begun} <= {one.key for one in found}:
            return False
        nothing, now, before = map(self.weighing.cost, ([], found, begun))
        return now - before > _BETTER + _RARE * (nothing - now)

    def choices(self, chosen: Sequence[Variant], replacing: bool = False) -> list[Choice]:
        """Those that pass beside each other, with what may stand in their places; none that tells the same twice and
        not alike. ``replacing`` is that of ``standing``.
        """
        standing = self.standing(chosen, replacing)
        found = [self._choice(one, [other for other in standing if other is not one]) for one in standing]
        alike = [one for one in found if _agrees(one.evidence)]
        return found if len(alike) == len(found) else self.choices([one.evidence.variant for one in alike], replacing)

    def _first(self) -> list[Variant]:
        """What the search begins with: what is told of several joints by another fit, behind which small parts of it on
        each of them would hide, and what is common where far more than that is missing.
        """
        variants = self.weighing.bank.variants
        told = [one for one in variants if one.preset is not None and len(one.hypothesis.joints) > 1]
        return self._with_common(self.standing(told))

    def _with_common(self, told: Sequence[Variant]) -> list[Variant]:
        """What is ``told``, and where far more is missing than one effect beside it: all common ones together and the
        best balancer, then without those that nothing speaks for. One after the other they hide each other.
        """
        chosen = list(told)
        if self.weighing.unexplained(chosen) < _GROSS * self.weighing.normal.rows:
            return chosen
        offered: dict[Key, list[Variant]] = {}
        for one in self.weighing.bank.variants:
            if common(one) or (balances(one.hypothesis.effect) and one.hypothesis.usual):
                offered.setdefault(one.key, []).append(one)
        chosen += [shapes[0] for (effect, _), shapes in offered.items() if not balances(effect)]
        balancers = [one for (effect, _), shapes in offered.items() if balances(effect) for one in shapes]
        if balancers:
            chosen.append(self.weighing.best_shape(balancers, chosen).variant)
        chosen = self.standing(chosen)
        return [self._shaped(one, [other for other in chosen if other is not one]) for one in chosen]

    def standing(self, chosen: Sequence[Variant], replacing: bool = False) -> list[Variant]:
        """Those that pass beside each other: the weakest that does not is taken away, one after the other. Where
        ``replacing``, what passes on its joints takes its place: beside all that it leaves unexplained, others would
        seem too small.
        """
        chosen, seen = list(chosen), set[frozenset[Key]]()
        most = _REPLACED * len(chosen)
        while chosen:
            rest = [[other for other in chosen if other is not one] for one in chosen]
            found = [self.weighing.of(one, others) for one, others in zip(chosen, rest, strict=True)]
            failing = [k for k, others in enumerate(rest) if not self._sound(found[k], others)]
            if not failing:
                return [one.variant for one in found]
            weakest = min(failing, key=lambda k: found[k].drop)
            seen.add(frozenset(one.key for one in chosen))
            again = replacing and len(seen) <= most
            place = self._in_place_of(found[weakest], rest[weakest], seen) if again else []
            chosen[weakest : weakest + 1] = place
        return chosen

    def _in_place_of(self, fallen: Evidence, others: list[Variant], seen: Collection[frozenset[Key]]) -> list[Variant]:
        """What passes beside ``others`` on the joints of what has fallen, if that has not been ``seen`` together."""
        there = {one.key for one in others}
        rivals = [
            one
            for one in self._rivals(fallen, others)
            if _agrees(one) and _share_joints(one.variant, fallen.variant) and there | {one.variant.key} not in seen
        ]
        best = self._best(rivals, replace(fallen, passes=False), others)
        return [] if best is None else [self._shaped(best.variant, others)]

    def _exchanged(self, chosen: list[Variant], new: Variant | None, rounds: int) -> list[Variant]:
        """Each one that shares a joint with ``new`` (all if None) challenged with the others in place; dropped when its
        evidence is gone.
        """
        for _ in range(rounds):
            before = list(chosen)
            for one in before:
                if one not in chosen or (new is not None and not _share_joints(one, new)):
                    continue
                others = [other for other in chosen if other is not one]
                mine = self.weighing.of(self._shaped(self._entire(one), others), others)
                sound = mine if self._sound(mine, others) else replace(mine, passes=False)
                best = self._best(self._rivals(mine, others), sound, others)
                if best is not None:
                    mine = self.weighing.of(self._shaped(best.variant, others), others)
                place = chosen.index(one)
                standing = (self._two_common(mine, others) or [mine.variant]) if self._sound(mine, others) else []
                chosen[place : place + 1] = standing
            if chosen == before:
                break
        return chosen

    def _entire(self, one: Variant) -> Variant:
        """With all its coefficients: beside fewer others some may have been at their bounds, or within chance."""
        return self.weighing.bank.add(one.hypothesis, one.shape, offered=False) or one

    def _best(self, rivals: Sequence[Evidence], mine: Evidence, others: Sequence[Variant]) -> Evidence | None:
        """The best of ``rivals``, which come best first, that should stand in the place of ``mine``, whichever of the
        two came first: rather a common one than a rare one on the same joints that does not outweigh it.
        """
        best: Evidence | None = None
        for one in rivals:
            usual = likely(one.variant, others)
            if best is not None and not (
                usual and _share_joints(one.variant, best.variant) and one.drop > _RIVAL * best.drop
            ):
                continue
            one = self._whole(one, others)
            if not self._sound(one, others) or (mine.passes and not self._displaces(one, mine, others)):
                continue
            if usual:
                return one if best is None or self._displaces(one, best, others) else best
            best = one
        return best

    def _displaces(self, one: Evidence, mine: Evidence, others: Sequence[Variant]) -> bool:
        """Whether ``one`` is clearly better; what is common gives way to what is not only for much more, and takes its
        place back for less.
        """
        usual, mine_usual = (likely(each.variant, others) for each in (one, mine))
        if usual == mine_usual:
            return one.score > mine.score + _BETTER
        return not _outweighs(mine, one) if usual else _outweighs(one, mine) and not self._hidden(mine, one, others)

    def _hidden(self, usual: Evidence, rare: Evidence, others: Sequence[Variant]) -> bool:
        """Whether what is common is nearly as much as what is rare without other rare effects on its joints, behind
        which it hides.
        """
        hiding = [one for one in others if _share_joints(one, usual.variant) and _rare(one, others)]
        if not hiding or not _share_joints(rare.variant, usual.variant):
            return False
        besides = [one for one in others if one not in hiding]
        of_usual, of_rare = (self.weighing.beside(one.variant, besides)[1] for one in (usual, rare))
        return of_rare <= of_usual + _BETTER + _RARE * of_usual

    def _sound(self, one: Evidence, others: Sequence[Variant]) -> bool:
        """Whether it passes, no order that is no whole number would do better, and it does all that its kind does: what
        scales a torque scales all of it, what slides replaces friction, what swings is heard.
        """
        if not one.passes or self._odds_of(one.variant, others) <= 1:
            return False
        weighing = self.weighing
        does = scales_all(weighing, one.variant, others) and replaces(weighing, one.variant, others)
        return does and heard(weighing.bank, weighing.train, one.variant, one.coefficients)

    def _odds_of(self, one: Variant, others: Sequence[Variant]) -> float:
        key = (one.columns, tuple(columns_of(others)))
        if key not in self._odds:
            self._odds[key] = odds(self.weighing, one, others)
        return self._odds[key]

    def _whole(self, one: Evidence, others: Sequence[Variant]) -> Evidence:
        """With the whole order that explains most, near its own, where it has one."""
        moved = nearest(self.weighing, one.variant, others)
        return one if moved is one.variant else self.weighing.of(moved, others)

    def _shaped(self, one: Variant, others: Sequence[Variant]) -> Variant:
        """With the shape that explains most beside ``others``, from whichever of its starts leads there."""
        balancer = balances(one.hypothesis.effect)
        if balancer:
            self._valleys.search(one, others)
        if balancer or one.hypothesis.starts:
            same = [other for other in self.weighing.bank.variants if other.key == one.key]
            one = self.weighing.best_shape([one, *same], others).variant
        each = [refined(self.weighing, start, others) for start in (one, *self._of_other_forms(one, others))]
        if len(each) > 1:
            weighed = [self.weighing.of(shaped, others) for shaped in each]
            each = [max(weighed, key=lambda form: (form.passes, form.score)).variant]
        return nearest(self.weighing, each[0], others)

    def _of_other_forms(self, one: Variant, others: Sequence[Variant]) -> list[Variant]:
        """The best variant of each other form: with other shapes, or other values of those that are tried alone, where
        others are searched. Before those are, another form may seem the better one.
        """
        forms: dict[tuple[tuple[str, float | None], ...], list[Variant]] = {}
        for other in self.weighing.bank.variants:
            if other.key == one.key and other.hypothesis.free:
                forms.setdefault(_form(other), []).append(other)
        forms.pop(_form(one), None)
        return [self.weighing.best_shape(same, others).variant for same in forms.values()]

    def _rivals(self, mine: Evidence, others: Sequence[Variant]) -> list[Evidence]:
        """Other hypotheses in the place of ``mine``, the best first.

        Where shapes are compared, those of the nearest rivals are refined too: on its grid alone the right one loses.
        One spring may be another's special case, without any.
        """
        found = [one for one in self.weighing.evidence(others) if one.variant.key != mine.variant.key]
        if not mine.variant.hypothesis.shapes and not pulls(mine.variant.hypothesis.effect):
            return found
        near = [one for one in found if one.drop > _RIVAL * mine.drop and one.variant.hypothesis.shapes]
        near = [one for one in near if one.variant.coordinates == mine.variant.coordinates][:_RIVALS]
        for one in near:
            self._valleys.search(one.variant, others)
        return [one for one in self.weighing.evidence(others) if one.variant.key != mine.variant.key]

    def _pair(self, chosen: Sequence[Variant]) -> list[Variant] | None:
        """Two that explain together what neither may alone."""
        single = self.weighing.evidence(chosen)[:_PAIRED]
        _, pair = self._best_pair([one.variant for one in single], chosen)
        return pair or None

    def _two_common(self, mine: Evidence, others: Sequence[Variant]) -> list[Variant]:
        """Two common effects of the joint that explain together as much as ``mine``, which is rare; none else."""
        if likely(mine.variant, others):
            return []
        taken = {one.key for one in others}
        bank = self.weighing.bank
        same = [one for one in bank.variants if common(one) and one.coordinates == mine.variant.coordinates]
        drop, pair = self._best_pair([one for one in same if one.key not in taken], others)
        bic = drop - sum(len(one.columns) for one in pair) * np.log(self.weighing.normal.rows)
        return [] if mine.bic > bic + _BETTER + _RARE * drop else pair

    def _best_pair(self, offered: Sequence[Variant], chosen: Sequence[Variant]) -> tuple[float, list[Variant]]:
        """The two of ``offered`` that explain most together beside ``chosen``, and how much; none where one does not
        pass beside the other.
        """
        S = self.weighing.normal.beside(columns_of(chosen))
        best: tuple[float, list[Variant]] = (0.0, [])
        for one, other in combinations(offered, 2):
            at = np.array([*one.columns, *other.columns]) - self.weighing.normal.base
            bounds = [np.concatenate(pair) for pair in zip(one.bounds, other.bounds, strict=True)]
            least = self.weighing.normal.least([*one.columns, *other.columns])
            _, drop = bounded(square(S, at), S[at, -1], bounds[0], bounds[1], least)
            if drop > best[0]:
                best = (drop, [one, other])
        drop, pair = best
        if pair and all(self.weighing.of(one, [*chosen, other]).passes for one, other in (pair, pair[::-1])):
            return drop, pair
        return 0.0, []

    def _choice(self, one: Variant, others: Sequence[Variant]) -> Choice:
        mine = self.weighing.of(one, others)
        usual = likely(one, others)
        near = []
        for other in self.weighing.evidence(others):
            if other.variant.key == one.key or not self._sound(other, others) or not _agrees(other):
                continue
            margin = -max(_EQUAL * max(mine.drop, mine.score), _BETTER)
            springs = pulls(one.hypothesis.effect) and pulls(other.variant.hypothesis.effect)
            if usual and not likely(other.variant, others) and not springs:
                margin = _RARE / 2 * mine.drop - _BETTER
            if misplaces(one.hypothesis) and misplaces(other.variant.hypothesis):
                # Whichever of them it is, a base leans about two axes at once.
                margin -= max(self.weighing.price(other.variant) - self.weighing.price(one), 0.0)
            if other.score > mine.score + margin and self._instead(other.variant, one, others):
                near.append(other)
        return Choice(mine, tuple(near), self._odds_of(one, others), self._apart(mine, others))

    def _instead(self, other: Variant, one: Variant, others: Sequence[Variant]) -> bool:
        """Whether ``other`` may stand in the place of ``one``: on other joints only what is not found beside it too."""
        return _share_joints(one, other) or not self.weighing.of(other, [*others, one]).passes

    def _apart(self, mine: Evidence, others: Sequence[Variant]) -> bool:
        """Whether it explains clearly more than its hypothesis with another value of a shape that is not searched."""
        one = mine.variant
        tried = [shape.name for shape in one.hypothesis.shapes if not shape.free]
        same = [
            each
            for each in self.weighing.bank.variants
            if each.key == one.key and each.shape.keys() == one.shape.keys()
        ]
        unlike = [each for each in same if any(each.shape[name] != one.shape[name] for name in tried)]
        drops = [self.weighing.beside(each.only(one.used), others)[1] for each in unlike]
        return all(drop < mine.drop - _BETTER for drop in drops)


def _share_joints(one: Variant, other: Variant) -> bool:
    return not set(one.coordinates).isdisjoint(other.coordinates)


def _rare(one: Variant, among: Sequence[Variant]) -> bool:
    return not likely(one, [other for other in among if other is not one])


def _form(one: Variant) -> tuple[tuple[str, float | None], ...]:
    """Names of its shapes, and the values of those that are tried alone."""
    return tuple((shape.name, None if shape.free else one.shape[shape.name]) for shape in one.hypothesis.shapes)


def _agrees(one: Evidence) -> bool:
    """Whether what its coefficients and its shape tell of the same may be of one thing."""
    agrees = one.variant.hypothesis.agrees
    return agrees is None or agrees(one.coefficients, one.variant.shape)


def _outweighs(rare: Evidence, usual: Evidence) -> bool:
    """Whether what is rare is believed and explains more than what is common by far, in the fitted runs and with the
    others.
    """
    margin = _BETTER + _RARE * usual.drop
    return rare.believed and rare.bic > usual.bic + margin and rare.score > usual.score + margin
