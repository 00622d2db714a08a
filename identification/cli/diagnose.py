"""Find where a robot's model and recorded runs disagree, name the missing effect, and add it to the robot's file.

Runs are as in `counterpoise identify`; FILE@FROM:TO takes a part of one, with times in s. Periodic motion with several
periods per run is best. The runs RUN are fitted. Effects must improve the validation runs too. The test runs show how
good the new model is; they may remove findings, never add them. Without --validate, each run in turn is predicted from
the others. Without --test, the last of three or more runs is the test run, else the end of each run. DIR receives
diagnosis.json, report.html, the new robot file and the code generated from it.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.resources import find_robot
from identification.extras import needing

if TYPE_CHECKING:
    from identification.diagnosis.columns.hypothesis import Hypothesis
    from identification.diagnosis.diagnosis import Diagnosis
    from identification.diagnosis.mending.mended import Mended
    from identification.diagnosis.verdict.finding import Told
    from identification.diagnosis.verdict.where import Where


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, RUN, --validate, --test, --prior, --dry-run, --out."""
    takes_robot(parser)
    parser.add_argument("data", metavar="RUN", nargs="+", help="runs to fit")
    parser.add_argument(
        "--validate",
        metavar="RUN",
        nargs="+",
        default=[],
        help="validation runs; an effect must improve them too",
    )
    parser.add_argument(
        "--test",
        metavar="RUN",
        nargs="+",
        default=[],
        help="runs kept for the final test; they may remove findings, never add them",
    )
    parser.add_argument(
        "--prior", metavar="SET", help="parameter set of the robot that is known, within its standard deviations"
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="only find where they disagree; name no effect, write no robot file"
    )
    takes_out(parser, "where the files go (default: diagnosed/ROBOT)")


def run(arguments: argparse.Namespace) -> None:
    """Diagnoses, writes the results, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise diagnose")):
        from identification.diagnosis.command import Request, diagnosed
        from identification.report.diagnose.report import report
        from identification.report.page import REPORT

    path = find_robot(arguments.robot)
    robot = read(path)
    folder = arguments.out or Path("diagnosed") / robot.name
    wanted = Request(arguments.data, arguments.validate, arguments.test, arguments.prior, arguments.dry_run)
    found, new, files = diagnosed(path, robot, wanted, folder, lambda *about: {REPORT: report(*about)})
    print("\n".join([*summary(found), *tested(new)]))
    print(f"files            {', '.join(files)} in {folder}/")


def tested(new: Mended | None) -> list[str]:
    """Lines on the untouched runs."""
    if new is None:
        return []
    from identification.diagnosis.runs.played import together

    lines = [f"note: {note}" for note in new.notes]
    for kind, played in (("before", new.before), ("after", new.after)):
        found = together(played)
        total = f"||e||/||Y - mean|| {found.total.relative_to_mean:.2f} %" if found.total.rows else "no row that counts"
        lines.append(f"test, {kind + ':':<10} {total}, by joint {found.by_joint()}")
    return lines


def summary(found: Diagnosis) -> list[str]:
    """Lines for the terminal: the verdict, where, what, how sure."""
    lines = [f"{found.robot.name}: {found.verdict} ({found.mode})"]
    lines += [f"note: {note}" for note in found.notes]
    if found.before.joint:
        lines.append(f"where            {_place(found.before)}")
    for one in found.findings:
        lines.append(f"{one.status:<16} {one.hypothesis.named}")
        lines += [f"                 {_value(each)}" for each in one.told]
        if not one.determined:
            lines.append("                 the runs tell its torque, but not these values one by one")
        lines += [f"                 not firm: {doubt}" for doubt in one.doubts]
        for other in one.alternatives:
            text = f"or {other.named}; to tell them apart: {other.separating_experiment}"
            lines.append(f"                 {text}")
    if found.after.joint:
        lines.append(f"unexplained      {_place(found.after)}")
    if found.invisible:
        lines.append(f"invisible        {_listed(found.invisible)}; report.html says what would show them")
    return lines


def _listed(hypotheses: Sequence[Hypothesis]) -> str:
    """``payload [1, 2, 3], position_offset [1, 3]``."""
    joints: dict[str, list[int]] = {}
    for one in hypotheses:
        joints.setdefault(one.effect, []).extend(number for number in one.numbers if number)
    return ", ".join(f"{effect} {sorted(set(numbers)) or 'of the robot'}" for effect, numbers in joints.items())


def _value(one: Told) -> str:
    """``vs 0.053 +- 0.0014 rad/s``."""
    return f"{one.name} {one.text('' if one.unit == '1' else f' {one.unit}')}"


def _place(where: Where) -> str:
    """``joint 2, over qd, ...``."""
    event = "" if where.event in ("", where.region) else f", {where.event}"
    return f"joint {where.joint}, {where.words or 'over nothing in particular'}{event}"
