"""Whether the runs are of this robot, with columns, units and signs as they are said to be."""

from __future__ import annotations

import numpy as np

from generator.errors import InputError
from identification.arrays import Array
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.runs.prepared import Prepared, joined
from identification.residuals import Residual, Residuals
from identification.suspicion import directed, ordered, suspect

#: Correlation of a run's torques with what the model makes of them from which their signs are others.
_REVERSED = -0.5


def doubts(found: Diagnosis, prior: Prior | None, dry: bool) -> list[str]:
    """What is to be told of joints that stay unexplained though everything was looked for.

    Raises InputError where columns are swapped, where the torques have the other sign, in all runs or in one of them,
    and where all that was found, unless the diagnosis was ``dry``, leaves most of the torques unexplained. Parameters
    that are known beforehand (``prior``) tell a sign as well.
    """
    bank = found.search.bank
    runs = [run.sampled for run in bank.runs]
    regressors, left = bank.scenes[0].regressors, _left(found)
    if dry:
        ordered(runs, regressors, left)
        return []
    for run, scene, e in zip(bank.runs, bank.scenes, found.residuals_after, strict=True):
        _alike(run, run.tau - e, "those of the other runs")
        if prior is not None:
            mean = dict(zip(bank.base, prior.mean.tolist(), strict=False))
            _alike(run, run.decimated(scene.torque_of({**scene.values, **mean}, scene.motion)), "the known parameters")
    base, values = bank.base, found.search.values
    std = np.sqrt(np.diag(found.search.covariance))[: len(base)]
    # Beside another law of its joint the model's own friction may come out as what that one has too much.
    rest = {one.joint: one.size for one in found.after.lack if one.told}
    explained = {
        one.joints[0]
        for one in found.findings
        if len(one.joints) == 1 and one.evidence.size > rest.get(one.joints[0], 0.0)
    }
    directed(runs[0].run.place, regressors.model, values, dict(zip(base, std.tolist(), strict=True)), explained)
    return suspect(runs, regressors, left)


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


def _alike(run: Prepared, model: Array, whose: str) -> None:
    """Raises InputError where a run's torques are far from those (n x rows) of a model, the other way."""
    tau, expected = run.tau[run.kept], model[run.kept]
    if tau @ expected < _REVERSED * np.linalg.norm(tau) * np.linalg.norm(expected):
        problem = f"the torques have another sign than {whose}"
        raise InputError(run.sampled.run.place, problem, "one sign in all runs; a sidecar can change it")
