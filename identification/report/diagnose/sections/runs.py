"""The runs and their roles."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification import outcome
from identification.diagnosis.runs.prepared import Prepared
from identification.report.diagnose.subject import Subject
from identification.report.runs_table import runs_table
from identification.report.titles import titles
from identification.report.told import facts

TITLE = "Runs and method"
ORDER = 120


def render(subject: Subject) -> Markup:
    found = subject.found
    count = len(found.roles.train)
    kinds = {
        kind: [outcome.run(one.sampled.run, one.sampled.filters) for one in runs]
        for kind, runs in (("fitted", found.runs[:count]), ("validates", found.runs[count:]))
    }
    names = titles([one.sampled.run.name for one in found.runs])
    periods = {name: _period(one) for name, one in zip(names, found.runs, strict=True)}
    about = {
        "tests": ", ".join(titles(found.roles.test)) or "none",
        "noise": "autoregressive, measured joint by joint and run by run",
        "evidence": "chi-squared beyond all that was tried, a drop on runs that were not fitted, bounds of physics",
        "mode": found.mode,
        **periods,
    }
    return join(runs_table(kinds), element("h3", "Method"), facts(about))


def _period(one: Prepared) -> str:
    return one.unlike or f"repeats every {one.repeats * one.sampled.run.period:.4g} s"
