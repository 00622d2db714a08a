"""From runs to the effects that are missing: prepare, whiten, select, and once more with the model that was found."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from identification.arrays import Array
from identification.diagnosis.candidates import hypotheses
from identification.diagnosis.columns import lengths
from identification.diagnosis.columns.acting import Acting
from identification.diagnosis.columns.bank import Bank, Lasting, Variant, columns_of
from identification.diagnosis.columns.hypothesis import SHAPE, Hypothesis
from identification.diagnosis.columns.maps import maps
from identification.diagnosis.columns.normal_equations import Normal, Prior
from identification.diagnosis.columns.whitening import Colour, colour, stretches
from identification.diagnosis.noise.effort_rounding import effort_rounding
from identification.diagnosis.noise.errors_in_variables import Redrawn, redrawn
from identification.diagnosis.noise.least_noise import least
from identification.diagnosis.noise.measured import colours
from identification.diagnosis.noise.passing import Passing, passing, undisturbed
from identification.diagnosis.noise.rounding import rounding
from identification.diagnosis.runs import stated_elasticity
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search import doubling
from identification.diagnosis.search.other_lengths import searched
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.search.settling import settled, swinging
from identification.diagnosis.search.weighing import Weighing
from identification.observation import Regressors

#: Times that columns which depend on the model are made, all but the first with what was found; one more with a gain
#: that is to be settled.
_PASSES = 3
#: Times that the model is fitted before, where columns of it depend on its values.
_FITS = 5


@dataclass(frozen=True)
class Search:
    """What came of it: the bank, what weighs its evidence, the choices, and the base parameters with them in place.

    ``rounded`` (n x rows each) is what rounding of positions and efforts makes of the runs' torques [N m, N], with the
    least that counts as noise; ``maps`` are those of the motion, by joint and run, none where all runs repeat. Rows of
    what was ``passing`` by count nowhere.
    """

    bank: Bank
    weighing: Weighing
    choices: tuple[Choice, ...]
    values: Mapping[str, float]
    covariance: Array
    offered: tuple[Hypothesis, ...]
    train: tuple[int, ...]
    validate: tuple[int, ...]
    rounded: tuple[Array, ...]
    maps: Sequence[Sequence[Array]] = ()
    passing: tuple[Passing, ...] = ()

    @property
    def repeats(self) -> bool:
        """Whether a run repeats, so that its noise is known apart from the model."""
        return any(run.period for run in self.bank.runs)

    @property
    def variants(self) -> list[Variant]:
        """What was chosen."""
        return [one.evidence.variant for one in self.choices]

    @property
    def start(self) -> dict[int, float]:
        """Values of the base columns without the choices, by number, fitted to all runs."""
        return self._fitted(())

    @property
    def weights(self) -> dict[int, float]:
        """Values of all columns in use, by number, fitted to all runs: a motion that the fitted runs do not have must
        not look like something that the model lacks.
        """
        return self._fitted(self.variants)

    def keeping(self, choices: Sequence[Choice]) -> Search:
        """The same with fewer choices; columns stay as the last search made them, with all that was found in place."""
        solution, covariance = self.weighing.fitted([one.evidence.variant for one in choices])
        values = self.bank.values(solution)
        return replace(self, choices=tuple(choices), values=values, covariance=covariance)

    def _fitted(self, variants: Sequence[Variant]) -> dict[int, float]:
        solution, _ = self.weighing.fitted(variants, True)
        return self.weighing.normal.by_number(columns_of(variants), solution)


@dataclass(frozen=True)
class _Found:
    """By what a turn makes its columns: variants that were found before, base parameters, and both as they act."""

    chosen: Sequence[Variant]
    values: Mapping[str, float]
    acting: Acting


@dataclass(frozen=True)
class _Noise:
    """What counts as noise beside its colours: as ``Search`` has it, and ``noisy`` runs as ``Weighing`` has them."""

    rounded: tuple[Array, ...]
    noisy: Mapping[int, Redrawn]
    maps: Sequence[Sequence[Array]]


def search(
    runs: Sequence[Prepared],
    train: Sequence[int],
    validate: Sequence[int],
    regressors: Regressors,
    prior: Prior | None = None,
    progress: Callable[[str], None] = lambda _: None,
    dry: bool = False,
) -> Search:
    """The effects missing in the model of ``regressors``, from the runs number ``train``, held against ``validate``.

    None is looked for in a ``dry`` search.
    """
    free, prior = prior is None, _with_drive_trains(prior, regressors)
    values = first_values(runs, train, regressors, prior)
    if passed := () if dry else _passing(runs, regressors, values):
        runs = [undisturbed(run, passed) for run in runs]
        values = first_values(runs, train, regressors, prior)
    before = _Found((), values, Acting())
    lasting, longer = Lasting(), lengths.hypotheses(regressors.model)
    for turn in range(_PASSES + 1):
        progress("making the columns of every candidate" if turn == 0 else "making them anew with what was found")
        bank = _bank(runs, regressors, before, free or turn + 1 >= _PASSES, lasting)
        offered, later = _offered(bank, train)
        start = _carried_on(bank, [*offered, *later, *longer], before.chosen)
        progress("measuring the noise")
        noise = _whitened(bank)
        weighing = Weighing(bank, train, validate, prior, noise.noisy, free)
        progress("weighing the evidence")
        choices = [] if dry else searched(weighing, start, later, longer)
        found, covariance = _fitted(weighing, choices)
        # Beside a gain that is not settled no parameter of what it scales has its value.
        doubles = doubling.doubling(found.acting)
        if _stays(found.acting, before.acting, regressors) or turn + 1 == _PASSES + doubles:
            break
        before = _settled(weighing, found, before, turn + 1 < _PASSES, doubles, progress)
    return Search(
        bank=bank,
        weighing=weighing,
        choices=tuple(choices),
        values=found.values,
        covariance=covariance,
        offered=tuple(offered),
        train=tuple(train),
        validate=tuple(validate),
        rounded=noise.rounded,
        maps=noise.maps,
        passing=passed,
    )


def _passing(runs: Sequence[Prepared], regressors: Regressors, values: Mapping[str, float]) -> tuple[Passing, ...]:
    """What passes by in the runs, beside what values of the base parameters explain."""
    bank = Bank(runs, [Scene(run.sampled, regressors, values) for run in runs])
    weights = {number: values[name] for number, name in enumerate(bank.base) if name in values}
    return passing(runs, [bank.residuals(r, weights) for r in range(len(runs))])


def _with_drive_trains(prior: Prior | None, regressors: Regressors) -> Prior | None:
    """With what is known of the parameters by which elastic drive trains of the robot file count, if it has any."""
    more = stated_elasticity.names(regressors.model.robot)
    if not more:
        return prior
    p = len(regressors.names)
    unknown = Prior(np.zeros(p), np.zeros((p, p)))
    return (prior or unknown).beside(list(map(stated_elasticity.precision, more)))


def _bank(runs: Sequence[Prepared], regressors: Regressors, before: _Found, settled: bool, lasting: Lasting) -> Bank:
    """Of scenes in which acts what was found ``before``, beside values of the base parameters that are ``settled``."""
    clear = [run.without_standstill(before.acting.jumps) for run in runs]
    scenes = [Scene(run.sampled, regressors, before.values, before.acting, settled) for run in clear]
    return Bank(clear, scenes, lasting)


def _offered(bank: Bank, train: Sequence[int]) -> tuple[Sequence[Hypothesis], Sequence[Hypothesis]]:
    """What the runs number ``train`` may show, its columns now in the bank; and other shapes of what the file has,
    which are looked for where that does not do.
    """
    every = hypotheses([bank.scenes[r] for r in train])
    offered, later = ([one for one in every if (one.kind == SHAPE) is last] for last in (False, True))
    bank.offer(offered)
    return offered, later


def _carried_on(bank: Bank, offered: Sequence[Hypothesis], chosen: Sequence[Variant]) -> list[Variant]:
    """What was ``chosen`` in the turn before, among the columns of this one, as far as they have it."""
    return [again for old in chosen if (again := _again(bank, offered, old)) is not None]


def _again(bank: Bank, offered: Sequence[Hypothesis], old: Variant) -> Variant | None:
    """The variant of the last turn among the columns of this one."""
    for variant in bank.variants:
        same = variant.key == old.key
        if same and dict(variant.shape) == dict(old.shape):
            return variant
    for one in offered:
        same = one.key == old.key
        if same and one.variants[0].keys() == old.shape.keys():
            return bank.add(one, {**old.shape, **one.given})
    return None


def _whitened(bank: Bank) -> _Noise:
    """The noise of the runs of a ``bank``, by whose colours its rows are white now."""
    runs, scenes = bank.runs, bank.scenes
    noise = _Noise(_rounded(runs, scenes), redrawn(runs, scenes), maps(runs, scenes))
    bank.whiten(colours(bank, noise.rounded, noise.maps, noise.noisy))
    return noise


def _rounded(runs: Sequence[Prepared], scenes: Sequence[Scene]) -> tuple[Array, ...]:
    """Of each run, what rounding of positions and efforts makes of torques, and the least that counts as noise."""
    return tuple(
        rounding(run, scene, r) + effort_rounding(run, scene) + least(run, r)
        for r, (run, scene) in enumerate(zip(runs, scenes, strict=True))
    )


def _fitted(weighing: Weighing, choices: Sequence[Choice]) -> tuple[_Found, Array]:
    """What was chosen with the base parameters beside it, and the covariance of all coefficients."""
    chosen = [one.evidence.variant for one in choices]
    solution, covariance = weighing.fitted(chosen)
    acting = Acting.found(weighing.bank, chosen, solution)
    return _Found(chosen, weighing.bank.values(solution), acting), covariance


def _stays(acting: Acting, before: Acting, regressors: Regressors) -> bool:
    """Whether columns made anew by what is ``acting`` now would be those that were made by what was ``before``."""
    depends = acting.again or (regressors.reads_load and bool(acting.variants))
    return acting.jumps == before.jumps and (not depends or acting.near(before))


def _settled(
    weighing: Weighing, found: _Found, before: _Found, early: bool, doubles: bool, progress: Callable[[str], None]
) -> _Found:
    """What the next turn makes its columns by: what was ``found``, with how drive trains swing settled while it is
    ``early``, or else with a gain that ``doubles`` a torque or halves it.
    """
    if early and swinging(found.chosen):
        progress("settling how drive trains swing")
        return _Found(*settled(weighing, found.chosen))
    if doubles:
        progress("settling how large a gain is")
        return _Found(*doubling.settled(weighing, found.chosen, before.values))
    return found


def first_values(
    runs: Sequence[Prepared], train: Sequence[int], regressors: Regressors, prior: Prior | None
) -> dict[str, float]:
    """Base parameters of the model without anything new, each joint weighted by its own residual."""
    values: dict[str, float] = {}
    for _ in range(_FITS if _depends(regressors) else 1):
        bank = Bank(runs, [Scene(run.sampled, regressors, values) for run in runs])
        values = bank.values(plain_fit(bank, train, prior)[0])
    return values


def _depends(regressors: Regressors) -> bool:
    """Whether columns of the model depend on its values: they read a load, or what elastic drive trains do is linear
    near their values alone.
    """
    return regressors.reads_load or bool(stated_elasticity.names(regressors.model.robot))


def plain_fit(bank: Bank, train: Sequence[int], prior: Prior | None = None) -> tuple[Array, Array]:
    """Values of the base columns (p), each joint weighted by its own residual, and their covariance (p x p)."""
    deviations = np.ones(bank.dof)
    solution, covariance = np.zeros(len(bank.base)), np.zeros((len(bank.base),) * 2)
    for _ in range(3):
        bank.whiten([[_flat(one) for one in deviations] for _ in bank.runs])
        normal = Normal(np.sum([bank.grams[r] for r in train], axis=0), len(bank.base), 1, prior)
        solution, covariance = normal.solution([])
        weights = dict(enumerate(solution.tolist()))
        for joint in range(bank.dof):
            parts = []
            for r in train:
                kept = bank.raw(r, joint)[3]
                parts += stretches(bank.residual(r, joint, weights, white=False), kept)
            deviations[joint] = colour(parts, order=0).deviations[0]
    return solution, covariance


def _flat(deviation: float) -> Colour:
    return Colour((np.ones(1),), (float(deviation),))
