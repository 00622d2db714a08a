"""The report of an identification of drive gains, as one call."""

from __future__ import annotations

from identification.drive_gains import DriveGains
from identification.gains_results import document
from identification.report.gains import sections
from identification.report.gains.subject import Subject
from identification.report.page import page


def report(found: DriveGains) -> bytes:
    """The page on ``found``."""
    robot = found.robot
    lead = "Torque constants and parameters by total least squares, from runs without and with a known payload"
    about = Subject(found, document(found))
    return page(f"{robot.name}: drive gains", lead, sections, about, f"the robot file of {robot.name}", robot.digest)
