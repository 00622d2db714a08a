"""The report of a designed motion, as one call."""

from __future__ import annotations

from identification.excitation.results import Excitation
from identification.report.excite import sections
from identification.report.page import page


def report(found: Excitation) -> bytes:
    """The page on ``found``."""
    robot = found.robot
    lead = f"A motion of {found.duration:g} s to identify from, and what will be known after it"
    return page(f"{robot.name}: excitation", lead, sections, found, f"the robot file of {robot.name}", robot.digest)
