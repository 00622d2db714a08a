"""The quantities that a model is made of, against the textbook recursion and against each other."""

from __future__ import annotations

import numpy as np

from tests.newton_euler import Arm
from tests.subject import Subject, Vector, close

CORE = ("inverse_dynamics", "regressor", "inertia_matrix", "gravity", "direct_dynamics")


def conditioning(arm: Subject, q: Vector) -> float:
    """How far M(q) magnifies rounding in the direct model."""
    return float(np.linalg.cond(arm.expected("inertia_matrix", {"q": q[: arm.dof]})["M"]))


def check_core(arm: Subject, seed: int) -> None:
    """The core of the model: inverse, M, gravity, regressor, direct."""
    q, qd, qdd = arm.state(seed)
    textbook, bodies = Arm(arm.robot, arm.values), arm.bodies_alone
    assert close(bodies.output("inverse_dynamics", q=q, qd=qd, qdd=qdd), textbook.torques(q, qd, qdd))
    assert close(bodies.output("inertia_matrix", q=q), textbook.inertia_matrix(q))
    assert close(bodies.output("gravity", q=q), textbook.gravity(q))
    tau = arm.output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    assert close(tau, arm.kept.expected("inverse_dynamics", {"q": q, "qd": qd, "qdd": qdd})["tau"])
    W = arm.output("regressor", q=q, qd=qd, qdd=qdd)
    assert close(W @ list(arm.base_values.values()), tau)
    assert close(arm.output("direct_dynamics", q=q, qd=qd, tau=tau), qdd, 1e-11 * max(100.0, conditioning(arm, q)))
