"""Whether the runs are of this robot, with columns, units and signs as they are said to be."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.diagnosis import UNEXPLAINED, Diagnosis
from identification.diagnosis.runs.prepared import Prepared, joined
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.loop import plain_fit
from identification.observation import Regressors
from identification.residuals import Residual, Residuals
from identification.signs import REVERSED, another_sign, directed
from identification.suspicion import misread, of_one_sense, ordered, suspect

#: Least singular value that a run tells parameters from, and a product that is none.
_RANK, _NOTHING = 1e-9, 1e-300


def of_one_sign(runs: Sequence[Prepared], regressors: Regressors, prior: Prior | None) -> None:
    """Raises InputError where columns of one of ``runs`` are swapped, and where its torques have another sign than
    those of the others, or than parameters that are known beforehand (``prior``) make of its motion; of one joint where
    its own inertia and friction say so as well.
    """
    ordered([run.sampled for run in runs], regressors)
    scenes = [Scene(run.sampled, regressors, {}) for run in runs]
    bank = Bank(runs, scenes)
    for r in _reversed(bank):
        raise another_sign(runs[r].sampled.run.place, "those of the other runs")
    if prior is None:
        return
    known = dict(zip(regressors.names, prior.mean.tolist(), strict=True))
    expected = [run.decimated(scene.torque_of(known, scene.motion)) for run, scene in zip(runs, scenes, strict=True)]
    for run, like in zip(runs, expected, strict=True):
        if _opposed(run.tau[run.kept], like[run.kept]):
            raise another_sign(run.sampled.run.place, "the known parameters")
    torques = [run.tau for run in runs]
    numbers = regressors.model.robot.numbers
    right = {n for k, n in enumerate(numbers) if not _opposed(joined(runs, torques, k), joined(runs, expected, k))}
    if len(right) < len(numbers):
        _as_inertia_and_friction(bank, regressors, right)


def _opposed(tau: Array, like: Array) -> bool:
    return bool(tau @ like < REVERSED * np.linalg.norm(tau) * np.linalg.norm(like))


def _as_inertia_and_friction(bank: Bank, regressors: Regressors, right: Collection[int]) -> None:
    """Raises InputError where the runs alone say that inertia and friction of a joint are of the other sign, but for
    joints number ``right``: what is known may lack more than it has, as of an arm that a balancer holds.
    """
    solution, covariance = plain_fit(bank, range(len(bank.runs)))
    values, std = (dict(zip(bank.base, x.tolist(), strict=True)) for x in (solution, np.sqrt(np.diag(covariance))))
    directed(bank.runs[0].sampled.run.place, regressors.model, values, std, right)


def explained(found: Diagnosis) -> list[str]:
    """What is to be told of joints that stay unexplained though everything was looked for.

    Raises InputError where columns are swapped beside what was found, where friction and inertia, or one column, have
    the other sign, and where all that was found leaves most of the torques unexplained.
    """
    bank = found.search.bank
    runs = [run.sampled for run in bank.runs]
    regressors, left = bank.scenes[0].regressors, _left(found)
    base, values = bank.base, found.search.values
    std = np.sqrt(np.diag(found.search.covariance))[: len(base)]
    # Beside another law of its joint the model's own friction may come out as what that one has too much.
    rest = {one.joint: one.size for one in found.after.lack if one.told}
    aside = {
        one.joints[0]
        for one in found.findings
        if len(one.joints) == 1 and one.evidence.size > rest.get(one.joints[0], 0.0)
    }
    directed(runs[0].run.place, regressors.model, values, dict(zip(base, std.tolist(), strict=True)), aside)
    of_one_sense(runs, regressors, left)
    return [*suspect(runs, regressors, left), *(misread(runs[0], regressors) if found.verdict == UNEXPLAINED else ())]


def _left(found: Diagnosis) -> Residuals:
    """What the model with the findings leaves of each joint in the rows that count."""
    runs = found.search.bank.runs
    torques = [run.tau for run in runs]
    return Residuals(
        {
            k: Residual.of(joined(runs, found.residuals_after, k), joined(runs, torques, k))
            for k in range(found.search.bank.dof)
        }
    )


def _reversed(bank: Bank) -> list[int]:
    """Runs whose torques are the other way than those of most: base parameters of each of two such runs alone make
    torques that are far from the other's.
    """
    products = [_products(bank, r) for r in range(len(bank.runs))]
    alone = [np.linalg.lstsq(A, b, rcond=_RANK)[0] for A, b, _ in products]
    made = [[x @ b / np.sqrt(max(float(x @ A @ x) * square, _NOTHING)) for A, b, square in products] for x in alone]
    away = np.array(made) < REVERSED
    opposite = away & away.T
    usual = int(np.argmin(opposite.sum(axis=1)))
    return np.flatnonzero(opposite[usual]).tolist()


def _products(bank: Bank, run: int) -> tuple[Array, Array, float]:
    """Of the base columns with each other (p x p) and with the torque (p), and its square: of the rows of a run, each
    joint's in parts of its torque's size.
    """
    p = len(bank.base)
    A, b, square = np.zeros((p, p)), np.zeros(p), 0.0
    for k in range(bank.dof):
        numbers, rows, tau, kept = bank.raw(run, k)
        at = [i for i, number in enumerate(numbers) if number < p]
        size = np.linalg.norm(tau[kept])
        if size > 0:
            where = np.array(numbers)[at]
            columns, torque = rows[at][:, kept] / size, tau[kept] / size
            A[np.ix_(where, where)] += columns @ columns.T
            b[where] += columns @ torque
            square += 1.0
    return A, b, square
