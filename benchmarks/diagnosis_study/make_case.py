"""One case on disk: ``python -m benchmarks.diagnosis_study.make_case --robot kr500_like --law stribeck --joint 3
--size 3 --mode free --seed 1 --out DIR``.

Without ``--law`` nothing is hidden. ``--law`` and ``--joint`` may be given several times.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from benchmarks.diagnosis_study.case import FREE, KNOWN, Case, Hidden
from benchmarks.diagnosis_study.making import made
from benchmarks.diagnosis_study.runs import MOTIONS
from benchmarks.diagnosis_study.study import STUDY
from tests.plant.library import LAWS
from tests.plant.robots import ROBOTS


def main() -> int:
    """Make what the arguments say; the truth goes to the terminal as well."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", choices=sorted(ROBOTS), required=True)
    parser.add_argument("--law", choices=sorted(LAWS), action="append", default=[])
    parser.add_argument("--joint", type=int, action="append", default=[])
    parser.add_argument("--size", type=float, help="in multiples of the noise; the law's typical size without it")
    parser.add_argument("--mode", choices=("free", "known"), default="free")
    parser.add_argument("--motion", choices=sorted(MOTIONS), default="fourier")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    told = parser.parse_args()
    reserved = sorted(set(told.law) & set(STUDY.reserved))
    if reserved:
        parser.error(f"{', '.join(reserved)}: kept for the study itself")
    joints = told.joint or [1] * len(told.law)
    hidden = tuple(Hidden(law, joint, told.size) for law, joint in zip(told.law, joints, strict=True))
    case = Case("single", told.robot, KNOWN if told.mode == "known" else FREE, told.seed, hidden, told.motion)
    done = made(case)
    done.write(told.out)
    print(json.dumps(done.truth, indent=2))
    return 0


if __name__ == "__main__":
    sys.exit(main())
