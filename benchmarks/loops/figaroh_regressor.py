"""FIGAROH's observation matrix, timed in its own environment: MODEL SAMPLES RESULTS are its arguments.

MODEL is a saved Pinocchio model; SAMPLES an .npz with q, qd, qdd (n x nv each). RESULTS (.npz) receives ``W``,
``nanoseconds`` a sample (processor time), those of a plain loop over Pinocchio's Python function, ``loop``, and
FIGAROH's ``version``.
"""

from __future__ import annotations

import sys
import time
from importlib.metadata import version
from types import SimpleNamespace

import numpy as np
import pinocchio as pin
from figaroh.tools.regressor import build_regressor_basic  # type: ignore[import-not-found]

_PASSES = 3


def main() -> None:
    """Measures, and writes the results."""
    model = pin.Model()
    model.loadFromBinary(sys.argv[1])
    robot = SimpleNamespace(model=model, data=model.createData())
    samples = np.load(sys.argv[2])
    q, qd, qdd = (samples[name] for name in ("q", "qd", "qdd"))
    configuration = {
        "has_friction": True,
        "has_actuator_inertia": True,
        "has_joint_offset": True,
        "is_joint_torques": True,
        "act_idxv": list(range(model.nv)),
    }

    def plain() -> None:
        for k in range(len(q)):
            pin.computeJointTorqueRegressor(model, robot.data, q[k], qd[k], qdd[k])

    theirs, loop = [], []
    for _ in range(_PASSES):
        begin = time.process_time()
        W = build_regressor_basic(robot, q, qd, qdd, configuration)
        middle = time.process_time()
        plain()
        theirs.append(middle - begin)
        loop.append(time.process_time() - middle)
    scale = 1e9 / len(q)
    np.savez(sys.argv[3], W=W, nanoseconds=scale * min(theirs), loop=scale * min(loop), version=version("figaroh"))


if __name__ == "__main__":
    main()
