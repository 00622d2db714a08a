"""Reports of every kind on small simulated cases, and what a reader finds in their markup."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np

from generator.cli.main import main
from identification.comparison import compare
from identification.consistent_fit import consistent_fit
from identification.inverse_model import identify
from identification.link_encoders import LinkEncoders, link_encoders
from identification.locked_output import locked_output
from identification.parameter_source import Known, Parameters
from identification.report.compare import report as compare_report
from identification.report.gains import report as gains_report
from identification.report.identify import report as identify_report
from identification.report.identify.subject import Subject
from identification.report.stiffness import report as stiffness_report
from tests import stiff_arm
from tests.diagnosis.diagnosed_arm import case
from tests.lifter import found, lifter
from tests.recorded import TRUTH, recorded, twin_text, two_links


@dataclass(frozen=True)
class Kind:
    """A kind of reports: the sub-package of identification.report that makes it, and one of what is in a folder."""

    package: str
    made: Callable[[Path], bytes]


def identified(folder: Path) -> Subject:
    """Two links, fitted on two runs and tried on a third one."""
    links = two_links(folder)
    runs = [str(recorded(links, TRUTH, seed=k, noise=0.02).save(folder / f"{'abc'[k]}.csv")) for k in range(3)]
    found = identify(links.model.robot, runs[:2], runs[2:], regressors=links)
    return identify_report.subject(found, consistent_fit(found, None, 0.03))


def lagging(folder: Path) -> LinkEncoders:
    """Two links whose encoders tell 3 ms late where they are; the second drive train twists, the first is rigid."""
    links = two_links(folder)
    run = recorded(links, TRUTH, rate=1000.0, noise=0.001)
    columns = run.columns
    late = {f"qs{j}": columns[f"q{j}"] - 3e-3 * np.gradient(columns[f"q{j}"], columns["t"]) for j in (1, 2)}
    late["qs2"] = late["qs2"] - columns["tau2"] / 2e4
    return link_encoders(links.model.robot, [str(run.with_columns(**late).save(folder / "late.csv"))])


def pages(folder: Path) -> dict[str, bytes]:
    """A report of every one of ``KINDS`` by its name, each made in a folder of its own."""
    return {kind: report_of(kind, folder / kind) for kind in KINDS}


def report_of(kind: str, folder: Path) -> bytes:
    """The report of a kind, of what is recorded into a new ``folder``."""
    folder.mkdir()
    return KINDS[kind].made(folder)


def _identify(folder: Path) -> bytes:
    subject = identified(folder)
    return identify_report.report(subject.found, subject.consistent)


def _locked(folder: Path) -> bytes:
    return stiffness_report.report(locked_output(stiff_arm.ROBOT, 2, [stiff_arm.blocked(folder / "blocked.csv")]))


def _excite(folder: Path) -> bytes:
    return _of_command("excite", _twin(folder), "--evaluations", "256", "--parameters", "twin")


def _output_error(folder: Path) -> bytes:
    robot, run = _twin(folder), folder / "A.csv"
    few = ("--duration", "6", "--noise", "0.3", "--parameters", "twin")
    assert main(["simulate", str(robot), *few, "--out", str(run)]) == 0
    return _of_command("output-error", robot, "--data", str(run), "--test", f"{run}@1:5", "--starts", "2")


def _of_command(name: str, robot: Path, *words: str) -> bytes:
    """What a command leaves of a robot file, beside it."""
    out = robot.parent / "out"
    assert main([name, str(robot), *words, "--out", str(out)]) == 0
    return (out / "report.html").read_bytes()


def _twin(folder: Path) -> Path:
    robot = folder / "two_links.yaml"
    robot.write_text(twin_text())
    return robot


def _side(name: str, factor: float) -> Parameters:
    values = {one: Known(factor * value, 0.02 * abs(value), "1") for one, value in TRUTH.items()}
    return Parameters(name, f"{name}.json", "0" * 64, values | {f"only_{name}": Known(None, None, "1")})


KINDS = {
    "identify": Kind("identify", _identify),
    "gains": Kind("gains", lambda folder: gains_report.report(found(lifter(folder), folder))),
    "steps": Kind("stiffness", lambda folder: stiffness_report.report(stiff_arm.steps(folder))),
    "locked": Kind("stiffness", _locked),
    "links": Kind("stiffness", lambda folder: stiffness_report.report(lagging(folder))),
    "compare": Kind("compare", lambda folder: compare_report.report(compare(_side("a", 1.0), _side("b", 1.1)))),
    "diagnose": Kind("diagnose", lambda folder: case(folder, "stribeck").page),
    "excite": Kind("excite", _excite),
    "output_error": Kind("output_error", _output_error),
}


class Page(HTMLParser):
    """Tags with their attributes in order; numbers of the rows of parameter tables; the charts' contents."""

    def __init__(self, page: bytes) -> None:
        super().__init__()
        self.tags: list[tuple[str, Mapping[str, str | None]]] = []
        self.rows: dict[str, list[float]] = {}
        self.charts: list[dict[str, Any]] = []
        self._name = self._inside = ""
        self._parameters = False
        self.feed(page.decode())

    @property
    def loads(self) -> list[str]:
        """Tags that would make a browser fetch something."""
        attributes = {"src", "srcset", "data", "poster", "action", "background"}
        tags = {"link", "iframe", "img", "object", "embed", "base"}
        links = [given["href"] or "" for _, given in self.tags if "href" in given]
        found = [tag for tag, given in self.tags if attributes & set(given) or tag in tags]
        return found + [link for link in links if not link.startswith("#")]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.tags.append((tag, given))
        self._inside = f"{tag} {given.get('type') or ''}".strip()
        if tag == "table":
            self._parameters = "parameters" in (given.get("class") or "")
        if tag == "tr":
            self._name = ""
        if tag == "data" and self._name and self._parameters:
            self.rows.setdefault(self._name, []).append(float(given["value"] or "nan"))

    def handle_data(self, data: str) -> None:
        if self._inside == "code" and not self._name:
            self._name = data
        if self._inside == "script application/json":
            self.charts.append(json.loads(data))

    def handle_endtag(self, tag: str) -> None:
        self._inside = ""
