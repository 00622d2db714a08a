"""The report of an identification of stiffness, as one call."""

from __future__ import annotations

from identification.report.page import page
from identification.report.stiffness import sections
from identification.report.stiffness.subject import Subject
from identification.stiffness_results import Found, document


def report(found: Found) -> bytes:
    """The page on ``found``."""
    about = Subject(found, document(found))
    robot, method = found.robot, about.results["method"]["name"]
    lead = f"{method[:1].upper()}{method[1:]}"
    return page(f"{robot.name}: stiffness", lead, sections, about, f"the robot file of {robot.name}", robot.digest)
