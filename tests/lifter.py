"""An arm whose third motor is coupled to its second joint, and its currents with and without a payload."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from generator.robot.readers import read
from identification.drive_gains import DriveGains, drive_gains
from identification.observation import Motion, Regressors
from identification.sidecar import Payload
from tests.recorded import Array, Recorded, fourier

#: A vertical axis, two horizontal ones, the third motor coupled to the second joint.
ARM = """\
name: lifter
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0, limits: [-170 deg, 170 deg]}
  - {j: 2, sigma: 0, alpha: pi/2, d: 0.2 m, theta: q2, r: 0, limits: [-160 deg, 160 deg]}
  - {j: 3, sigma: 0, alpha: 0, d: 0.7 m, theta: q3, r: 0, limits: [-160 deg, 160 deg]}
  - {j: 4, sigma: 2, alpha: 0, d: 0.5 m, theta: 0, r: 0, tool: true}
drives:
  gear_ratios: [-120, 100, -80]
  coupling: {convention: direct, N32: 20}
  torque_constants: {unit: N m/A, use: warm, warm: [0.6, 0.6, 0.5]}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
  - {effect: offset, joints: all}
"""
#: N of the file above, row by motor, and the true torque constants [N m/A].
N = np.array([[-120.0, 0, 0], [0, 100, 0], [0, 20, -80]])
KT = np.array([0.53, 0.65, 0.44])
#: A payload of 20 kg in the tool frame: XX XY XZ YY YZ ZZ MX MY MZ M.
PAYLOAD = np.array([0.3, 0, 0, 0.5, 0, 0.6, 1.5, -0.8, 0.4, 20.0])


def lifter(folder: Path) -> Regressors:
    """The arm, from a file in ``folder``."""
    path = folder / "lifter.yaml"
    path.write_text(ARM)
    return Regressors(read(path))


def truth(arm: Regressors) -> dict[str, float]:
    """Base parameters of an arm of bars; 5 to 20 times what friction and rotors are."""
    values = dict.fromkeys(arm.names, 0.0)
    standard = {"ZZ1": 2.0, "XX2": 0.3, "YY2": 2.6, "ZZ2": 2.7, "MX2": 7.0, "MY2": 0.3, "M2": 22.0, "MZ2": 0.5}
    standard |= {"XX3": 0.1, "YY3": 0.9, "ZZ3": 0.9, "MX3": 2.4, "MY3": -0.2, "M3": 10.0, "MZ3": 0.2, "XY3": 0.05}
    standard |= {
        f"{stem}{j}": size / j for j in (1, 2, 3) for stem, size in (("Ia", 6), ("Fv", 20), ("Fc", 9), ("Off", 2))
    }
    for name, terms in arm.model.grouping.numeric().items():
        values[name] = sum(coefficient * standard.get(one, 0.0) for one, coefficient in terms.items())
    return values


def currents(arm: Regressors, seed: int, loaded: bool, slow: float = 1.0) -> tuple[Array, Motion, Array]:
    """Times, motion and the currents that it takes; ``slow`` stretches time."""
    t, motion = fourier(arm.model.robot, 20.0, 200.0, seed, slowest=0.15)
    motion = Motion(motion.q, motion.qd / slow, motion.qdd / slow**2)
    tau = arm.torques(truth(arm), motion)
    if loaded:
        tau = tau + np.array([PAYLOAD @ W for W in arm.payload(motion)])
    return t * slow, motion, np.linalg.solve(N.T, tau) / KT[:, None]


def saved(path: Path, t: Array, motion: Motion, i: Array, noise: float, seed: int) -> str:
    i = i + noise * i.std(axis=1)[:, None] * np.random.default_rng(seed).normal(size=i.shape)
    columns = {"t": t} | {f"q{j}": motion.q[j - 1] for j in (1, 2, 3)} | {f"i{j}": i[j - 1] for j in (1, 2, 3)}
    return str(Recorded(columns).save(path))


def found(arm: Regressors, folder: Path, noise: float = 0.02, seed: int = 0, slow: float = 1.0) -> DriveGains:
    a, b = (currents(arm, number, loaded, slow) for number, loaded in ((1, False), (2, True)))
    empty = saved(folder / "a.csv", *a, noise, 2 * seed)
    loaded = saved(folder / "b.csv", *b, noise, 2 * seed + 1)
    return drive_gains(arm.model.robot, [empty], [loaded], Payload("L", {"M": 20.0}), {"M": 0.02}, regressors=arm)
