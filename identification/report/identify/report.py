"""The report of an identification, as one call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from generator.words import plural
from identification.consistent_fit import ConsistentFit
from identification.inverse_model import Identification
from identification.observed import Observed
from identification.reconstruction import reconstructed
from identification.report.identify import sections
from identification.report.identify.subject import ALL, CONSISTENT, ESSENTIAL, ShownRun, Subject
from identification.report.page import page
from identification.results import document
from identification.sensitivity import Variation


def report(
    found: Identification, consistent: ConsistentFit | None = None, variations: Sequence[Variation] = ()
) -> bytes:
    """The page on ``found``, beside what ``document`` of the results says of it."""
    about = subject(found, consistent, variations)
    robot = found.robot
    lead = f"Dynamic parameters from {plural(len(found.train), 'run')} by the inverse dynamic model and least squares"
    return page(f"{robot.name}: identification", lead, sections, about, f"the robot file of {robot.name}", robot.digest)


def subject(found: Identification, consistent: ConsistentFit | None, variations: Sequence[Variation] = ()) -> Subject:
    """All that the sections need; the torques of the runs are computed from the rows at hand."""
    models: dict[str, Mapping[str, float]] = {
        ALL: found.full.solution.values,
        ESSENTIAL: found.essential.solution.values,
    }
    if consistent is not None:
        models[CONSISTENT] = {**found.problem.fixed, **consistent.standard, **consistent.base}
    runs = [*((one, False) for one in found.train), *((one, True) for one in found.test)]
    names = _names([one.sampled.run.name for one, _ in runs])
    shown = tuple(_shown(name, *run, models) for name, run in zip(names, runs, strict=True))
    return Subject(found, consistent, document(found, consistent, variations), models, shown)


def _shown(name: str, observed: Observed, held_out: bool, models: Mapping[str, Mapping[str, float]]) -> ShownRun:
    torques = {one.joint: one for one in reconstructed(observed, models)}
    return ShownRun(f"{name} (held out)" if held_out else name, held_out, observed, torques)


def _names(files: Sequence[str]) -> list[str]:
    """Names without folders where these suffice; a run that is there twice is numbered."""
    short = [Path(one).name for one in files]
    names = short if len(set(short)) == len(set(files)) else list(files)
    return [name if names.count(name) == 1 else f"{name} #{names[:k].count(name) + 1}" for k, name in enumerate(names)]
