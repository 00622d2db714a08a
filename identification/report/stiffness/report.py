"""The report of an identification of stiffness, as one call."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from identification.report.page import page
from identification.report.stiffness import sections
from identification.report.stiffness.subject import Found, Subject


def report(found: Found, results: Mapping[str, Any]) -> bytes:
    """The page on ``found``; ``results`` are the content of its results.json."""
    robot, method = found.robot, results["method"]["name"]
    about = Subject(found, results)
    lead = f"{method[:1].upper()}{method[1:]}"
    return page(f"{robot.name}: stiffness", lead, sections, about, f"the robot file of {robot.name}", robot.digest)
