"""The report of an identification by output error, as one call."""

from __future__ import annotations

from generator.words import plural
from identification.output_error.multi_start import OutputError
from identification.output_error.results import document
from identification.report.output_error import sections
from identification.report.output_error.subject import Subject
from identification.report.page import page


def report(found: OutputError) -> bytes:
    """The page on ``found``."""
    robot = found.robot
    lead = f"Dynamic parameters by output error in open loop, from {plural(len(found.train), 'run')}"
    about = Subject(found, document(found))
    return page(f"{robot.name}: output error", lead, sections, about, f"the robot file of {robot.name}", robot.digest)
