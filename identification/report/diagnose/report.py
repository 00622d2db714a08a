"""The report of a diagnosis, as one call."""

from __future__ import annotations

from identification.diagnosis.diagnosis import KNOWN, Diagnosis
from identification.diagnosis.mending.mended import Mended
from identification.report.diagnose import sections
from identification.report.diagnose.subject import Subject
from identification.report.page import page


def report(found: Diagnosis, mended: Mended | None = None) -> bytes:
    """The page on ``found``; ``mended`` is what became of the robot file, None where nothing was written."""
    robot = found.robot
    how = "beside parameters that were known" if found.mode == KNOWN else "all parameters fitted"
    lead = f"Where model and measurement disagree, and what the model lacks; {how}"
    about = Subject(found, mended)
    return page(f"{robot.name}: diagnosis", lead, sections, about, f"the robot file of {robot.name}", robot.digest)
