"""Several doubtful effects on one joint, which together stand for one that is not in the library."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from identification.diagnosis.verdict.finding import FIRM, Finding

#: Why something stays unexplained where findings are so many.
PATCHED = "patched"
#: Findings on one joint, none of them firm, from which they say no more than that something acts there.
_SEVERAL = 3


def patched(found: Sequence[Finding]) -> int:
    """The number of the joint that takes several tentative findings and no firm one, the first by evidence; 0 if none
    does. What acts on several joints is of none.
    """
    by_joint: dict[int, list[Finding]] = defaultdict(list)
    for one in found:
        by_joint[one.hypothesis.joint].append(one)
    for number, several in by_joint.items():
        if number and len(several) >= _SEVERAL and all(one.status != FIRM for one in several):
            return number
    return 0
