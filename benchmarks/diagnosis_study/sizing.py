"""How large a hidden effect is on the fitted runs, and which size of the law makes it as large as wanted.

The measure: rms of the whitened effect, after projection on all that the mode can fit, over the rms of the whitened
noise, up to LIMIT, over the rows of the joints on which the effect acts. Rows in which a joint nearly stands are left
out, as a diagnosis leaves them out: they are zero in the effect and in what is fitted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.diagnosis_study.case import Hidden
from benchmarks.diagnosis_study.prior import deviation
from tests.plant.effect import Effect
from tests.plant.known_effects import textbook
from tests.plant.law import value_of
from tests.plant.library import LAWS
from tests.plant.robot import BODY, Array, Robot
from tests.plant.run import Run
from tests.plant.simulate import make_run
from tests.plant.size import effect_torque, free_fit, whiten
from tests.plant.trajectory import Trajectory

#: Up to which frequency [Hz] effect and noise are compared.
LIMIT = 20.0
#: Part of the norm left after projection below which an effect is invisible.
INVISIBLE = 0.01
#: Raw size over the noise below which an effect adds nothing, whatever the mode.
NOTHING = 1e-3
#: Joints act whose whitened torque is at least this part of the largest joint's.
_ACTS = 0.1
#: Speed over its rms below which a joint stands; rows about such a row that are left out as well.
_SLOW, _ABOUT = 0.04, 25
_TOLERANCE, _TRIES = 0.05, 6
#: Torque [N m, N] that is none.
_SAME = 1e-9
#: Multiples of a law's typical size that are still plausible.
_PLAUSIBLE = 10.0


class OutOfReach(Exception):
    """No size of the law makes the effect as large as wanted: ``hidden`` is what was."""

    def __init__(self, hidden: Hidden) -> None:
        super().__init__(f"{hidden.law} on joint {hidden.joint} does not come to {hidden.size:g} times the noise")
        self.hidden = hidden


@dataclass(frozen=True)
class Size:
    """``raw`` and ``left`` after projection, in multiples of the noise; ``part`` of the norm left; ``joints`` (from 1)
    on which the effect acts; ``torque`` its rms [N m, N] on the most affected of them.
    """

    raw: float
    left: float
    part: float
    joints: tuple[int, ...]
    torque: float


def moving(run: Run) -> Array:
    """Rows (T x n) in which no speed that friction depends on is near zero, 1 or 0."""
    kept = np.ones(run.truth.qd.shape)
    alongs = {tuple(effect.along(run.robot)) for effect in run.effects if effect.what.friction}
    for along in alongs:
        speed = run.truth.thd @ np.array(along)
        slow = np.abs(speed) < _SLOW * np.sqrt(np.mean(speed**2))
        kept[np.convolve(slow, np.ones(2 * _ABOUT + 1), "same") > 0] *= np.array(along) == 0
    return kept


class Fit:
    """What a mode can fit on some runs, once for all sizes of an effect."""

    def __init__(self, runs: Sequence[Run], effect: Effect | None, known: bool) -> None:
        self._kept = [moving(run) for run in runs]
        self._columns = []
        for run, kept in zip(runs, self._kept, strict=True):
            basis = free_fit(run, effect) * kept[:, :, None]
            self._columns.append(whiten(run, basis, LIMIT))
        W = np.concatenate([x.reshape(-1, x.shape[2]) for x in self._columns])
        # In known-parameters mode a column may be used as far as its parameter is uncertain.
        scale = deviations(runs[0], effect, W.shape[1]) if known else 1 / np.maximum(np.linalg.norm(W, axis=0), 1e-300)
        self._W = W * scale
        gram = self._W.T @ self._W
        values, vectors = np.linalg.eigh(gram)
        if known:
            self._inverse = (vectors / (values + 1)) @ vectors.T
        else:
            good = values > 1e-11 * values[-1]
            self._inverse = (vectors[:, good] / values[good]) @ vectors[:, good].T

    def size(self, runs: Sequence[Run], torques: Sequence[Array]) -> Size:
        """Of torques (T x n each) along the runs."""
        white = [whiten(run, tau * kept, LIMIT) for run, tau, kept in zip(runs, torques, self._kept, strict=True)]
        shares = [np.mean(kept) for kept in self._kept]
        rows = sum(len(x) * share for x, share in zip(white, shares, strict=True))
        e = np.concatenate(white)
        flat = e.reshape(-1)
        left = (flat - self._W @ (self._inverse @ (self._W.T @ flat))).reshape(e.shape)
        of_joint = np.sqrt(np.sum(e**2, axis=0) / rows)
        acts = of_joint >= _ACTS * float(of_joint.max(initial=0.0))

        def over(x: Array) -> float:
            return float(np.sqrt(np.mean(np.sum(x[:, acts] ** 2, axis=0)) / rows))

        strongest = int(np.argmax(of_joint))
        rms = float(np.sqrt(np.mean(np.concatenate([tau[:, strongest] for tau in torques]) ** 2)))
        raw = over(e)
        part = float(np.linalg.norm(left)) / max(float(np.linalg.norm(e)), 1e-300)
        return Size(raw, over(left), part, tuple(int(j) + 1 for j in np.flatnonzero(acts)), rms)


def deviations(run: Run, effect: Effect | None, columns: int) -> Array:
    """Standard deviations of the parameters of ``free_fit``'s columns, from the prior's relative ones."""
    robot = run.robot
    result = [deviation(name, run.machine.body[j][k]) for j in range(robot.joints) for k, name in enumerate(BODY)]
    rotors = [joint.rotor for joint in robot.chain]
    for other in run.effects:
        if other == effect:
            continue
        if other.law == "wrist_inertia":
            rotors.append(other.amount(robot))
        elif other.what.torque and other.amount(robot):
            result.append(deviation(other.law, other.amount(robot)))
    result += [deviation("rotor_inertia", rotor) for rotor in rotors]
    assert len(result) == columns
    return np.array(result)


def mismatch(runs: Sequence[Run], known: bool) -> float:
    """What the laws of the robot file leave unexplained of the robot's own, over the noise, after the fit."""
    torques = []
    for run in runs:
        torque = np.zeros_like(run.truth.q)
        for k, effect in enumerate(run.machine.torques):
            # Friction turns with the motors.
            law = textbook(effect, run.robot, run.truth.th, run.truth.thd)
            if law is not None:
                torque += np.outer(run.truth.torque[:, k] - law, effect.along(run.robot))
        torques.append(torque)
    if max(float(np.max(np.abs(tau * moving(run)))) for run, tau in zip(runs, torques, strict=True)) < _SAME:
        return 0.0
    return Fit(runs, None, known).size(runs, torques).left


def sized(
    robot: Robot,
    trajectories: Sequence[Trajectory],
    own: Sequence[Effect],
    effect: Effect,
    target: float | None,
    known: bool,
    seed: int,
) -> tuple[Effect, Size, list[Run]]:
    """The effect as large as wanted on the runs together, to a twentieth; at its typical size where ``target`` is None
    or where the mode cannot see it. With the runs that show it.

    Raises OutOfReach where no size below the law's largest, and below ten times its typical one, will do.
    """
    law = LAWS[effect.law]
    amount = effect.amount(robot)
    largest = min(value_of(law.largest, robot, effect.joint - 1), _PLAUSIBLE * abs(amount))
    fit: Fit | None = None
    for _ in range(_TRIES):
        tried = effect.sized(amount)
        runs = [make_run(robot, one, [tried], seed=seed + k, own=own) for k, one in enumerate(trajectories)]
        fit = fit or Fit(runs, tried, known)
        size = fit.size(runs, [effect_torque(run, tried) for run in runs])
        if target is None or size.part < INVISIBLE or size.raw < NOTHING or abs(size.left / target - 1) <= _TOLERANCE:
            return tried, size, runs
        if size.left == 0:
            break
        amount *= min(max(target / size.left, 0.02), 50.0)
        if abs(amount) > largest:
            break
    raise OutOfReach(Hidden(effect.law, effect.joint, target, effect.other))
