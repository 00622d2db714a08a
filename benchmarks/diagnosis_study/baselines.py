"""What simpler ways name on the same runs: stepwise BIC, a held-out gate alone, sparse regression (STLSQ).

They see the rows and the candidates that the diagnosis made, each joint weighted by its noise, as weighted least
squares has it; BIC is asked on the white rows of the diagnosis as well. Their names are ``(effect, joint)``.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pysindy.optimizers import STLSQ

from benchmarks.diagnosis_study.case import KNOWN, Case
from benchmarks.diagnosis_study.runs import FITTED, NAMES
from generator.robot.readers import read
from identification.dataset import load
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.columns.whitening import Colour
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.search.loop import Search, search
from identification.diagnosis.search.weighing import Weighing
from identification.observation import Regressors
from identification.recipes import Recipe
from tests.plant.robot_file import PRIOR

Name = tuple[str, int]

#: Where each of them stops, if nothing else stops it.
_MOST = 12
#: Of sparse regression: least part of a standardised torque, ridge, and rounds (Brunton, Proctor and Kutz 2016).
_THRESHOLD, _RIDGE, _ROUNDS = 0.05, 1e-6, 20


def stepwise(weighing: Weighing, worth: Callable[[Weighing, Variant, list[Variant]], float]) -> list[Name]:
    """Forward selection: the candidate of the largest ``worth`` beside the chosen ones, while it is above zero."""
    chosen: list[Variant] = []
    while len(chosen) < _MOST:
        offered = weighing.evidence(chosen)
        found = [(worth(weighing, one.variant, chosen), k) for k, one in enumerate(offered)]
        best, k = max(found, default=(0.0, 0))
        if best <= 0:
            break
        chosen.append(offered[k].variant)
    return [_name(one) for one in chosen]


def information(weighing: Weighing, variant: Variant, chosen: list[Variant]) -> float:
    """Drop of the sum of squares less k ln(rows), for a shape too: the Bayesian criterion (Schwarz 1978)."""
    normal = weighing.normal
    drop = _misfit(weighing, chosen) - _misfit(weighing, [*chosen, variant])
    count = len(variant.columns) + len(variant.hypothesis.shapes)
    return drop - count * float(np.log(normal.rows))


def held_out(weighing: Weighing, variant: Variant, chosen: list[Variant]) -> float:
    """Drop of the sum of squares on the run that was not fitted."""
    return weighing.gain(variant, chosen)


def sparse(weighing: Weighing) -> list[Name]:
    """Sequentially thresholded least squares on every candidate's best shape; a name is kept if a coefficient is.

    PySINDy's, on rows that have the same sums of squares and products as the whitened ones after projection.
    """
    S, p = weighing.normal.schur, weighing.normal.base
    whole = np.diag(weighing.normal.gram)
    variants = [one.variant for one in weighing.evidence([]) if np.all(whole[list(one.variant.columns)] > 0)]
    at = np.array(_columns(variants))
    whose = [k for k, one in enumerate(variants) for _ in one.columns]
    size = np.sqrt(np.maximum(np.diag(S)[at - p], 1e-12 * whole[at]))
    torque = np.sqrt(max(float(S[-1, -1]), 1e-300))
    products = S[np.ix_([*(at - p), -1], [*(at - p), -1])] / np.outer([*size, torque], [*size, torque])
    values, vectors = np.linalg.eigh(products)
    rows = np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that nothing is kept is an answer
        fit = STLSQ(threshold=_THRESHOLD, alpha=_RIDGE, max_iter=_ROUNDS).fit(rows[:, :-1], rows[:, -1:])
    kept = np.flatnonzero(fit.coef_[0])
    return [_name(variants[k]) for k in dict.fromkeys(whose[i] for i in kept)]


def named_by_baselines(folder: Path, case: Case) -> dict[str, list[list[Any]]]:
    """Their names on a case's files, by the baseline."""
    found = _search(folder, case)
    plain = weighted(found)
    names = {
        "stepwise BIC, white rows": stepwise(found.weighing, information),
        "stepwise BIC": stepwise(plain, information),
        "held-out gate": stepwise(plain, held_out),
        "STLSQ": sparse(plain),
    }
    return {way: [list(one) for one in named] for way, named in names.items()}


def weighted(found: Search) -> Weighing:
    """The same rows and candidates, each joint weighted by its residual's standard deviation alone.

    The bank of the search is what is weighted: its own selection is of no use afterwards.
    """
    bank, weights = found.bank, found.weights
    colours = []
    for run in range(len(bank.runs)):
        left = [bank.residual(run, joint, weights, white=False) for joint in range(bank.dof)]
        kept = [bank.raw(run, joint)[3] for joint in range(bank.dof)]
        colours.append([Colour((np.ones(1),), (float(np.std(e[k])),)) for e, k in zip(left, kept, strict=True)])
    bank.whiten(colours)
    return Weighing(bank, found.train, found.validate, found.weighing.normal.prior)


def _search(folder: Path, case: Case) -> Search:
    robot = read(folder / "robot.yaml")
    regressors = Regressors(robot)
    runs = [prepared(load(str(folder / f"{name}.csv"), robot), Recipe(), regressors) for name in NAMES[: FITTED + 1]]
    prior = prior_of(regressors.model, PRIOR) if case.mode == KNOWN else None
    return search(runs, range(FITTED), [FITTED], regressors, prior)


def _misfit(weighing: Weighing, chosen: Sequence[Variant]) -> float:
    at = _columns(chosen)
    return weighing.normal.misfit(at, weighing.normal.solution(at)[0])


def _columns(variants: Sequence[Variant]) -> list[int]:
    return [number for one in variants for number in one.columns]


def _name(variant: Variant) -> Name:
    return variant.hypothesis.effect, variant.hypothesis.joint
