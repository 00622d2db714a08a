"""A recorded run: what was logged, and the truth behind it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tests.plant.robot import Array, Robot
from tests.plant.trajectory import Trajectory

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


@dataclass(frozen=True)
class Truth:
    """Without noise and quantisation, at the logged instants (T x n each), on the joint side.

    ``q`` are the links, ``th`` the motors over the true ratios; ``current`` flows, ``command`` was asked for;
    ``heat`` of the windings; ``friction`` of all laws that are friction; ``load`` is what the gears transmit;
    ``torque`` (T x m) of each effect that is a torque.
    """

    q: Array
    qd: Array
    qdd: Array
    th: Array
    thd: Array
    thdd: Array
    current: Array
    command: Array
    heat: Array
    friction: Array
    load: Array
    torque: Array


@dataclass(frozen=True)
class Noise:
    """Of the currents: standard deviations (n) [A], and one shape of spectrum for all of them.

    ``share`` of the variance is a first-order low pass with its corner at ``corner`` [Hz], the rest is white.
    """

    std: Array
    share: float
    corner: float
    rate: float

    def shape(self, frequency: Array) -> Array:
        """One-sided power spectral density [1/Hz] at 0 <= f < rate/2 for a standard deviation of one."""
        a = np.exp(-2 * np.pi * self.corner / self.rate)
        z = np.exp(-2j * np.pi * np.asarray(frequency) / self.rate)
        coloured = (1 - a**2) / np.abs(1 - a * z) ** 2
        return np.asarray((self.share * coloured + 1 - self.share) * 2 / self.rate)


@dataclass(frozen=True)
class Run:
    """Logged signals at ``rate`` [Hz]: T rows.

    ``t`` [s]; ``qm`` motor angles and ``i`` currents (T x n); ``qs`` link-side encoders and ``temperature`` where
    there are such sensors; ``reference`` of the joints. ``q`` and ``tau`` are qm and i by the ratios and constants of
    the robot's data. ``period`` is in rows, 0 without one. ``steps`` of integration were made in a controller's
    period.
    """

    robot: Robot
    effects: tuple[Effect, ...]
    trajectory: Trajectory
    machine: Machine
    rate: float
    start_time: float
    reference: Array
    truth: Truth
    steps: int
    qm: Array = field(default_factory=lambda: np.empty((0, 0)))
    i: Array = field(default_factory=lambda: np.empty((0, 0)))
    qs: Array | None = None
    temperature: Array | None = None
    noise: Noise | None = None

    @property
    def t(self) -> Array:
        """Times (T) [s] from 0."""
        return np.asarray(np.arange(len(self.reference)) / self.rate)

    @property
    def period(self) -> int:
        """Rows of a period, 0 without one."""
        return round(self.trajectory.period * self.rate)

    @property
    def q(self) -> Array:
        """Joint positions (T x n) by the data's ratios."""
        return np.asarray(np.linalg.solve(self.robot.ratios, self.qm.T).T)

    @property
    def taum(self) -> Array:
        """Motor torques (T x n) by the data's torque constants."""
        return np.asarray(self.i * self.robot.column("constant"))

    @property
    def tau(self) -> Array:
        """Joint torques (T x n) by the data's ratios and torque constants."""
        return np.asarray(self.taum @ self.robot.ratios)

    @property
    def torque_noise(self) -> Array:
        """Standard deviation (n) of the noise in ``tau``."""
        assert self.noise is not None
        return np.asarray(np.sqrt(((self.noise.std * self.robot.column("constant")) ** 2) @ self.robot.ratios**2))


def write_csv(run: Run, path: Path, position: str = "qm", effort: str = "i", reference: bool = False) -> None:
    """A run file: header, then a row a sample. ``position`` is qm or q, ``effort`` i, taum or tau; qr on request; qs
    and temp where logged.

    Raises ValueError for other words.
    """
    if position not in ("qm", "q") or effort not in ("i", "taum", "tau"):
        raise ValueError(f"{position}, {effort}: expected qm or q, and i, taum or tau")
    blocks: list[tuple[str, Array]] = [(position, getattr(run, position)), (effort, getattr(run, effort))]
    if run.qs is not None:
        blocks.append(("qs", run.qs))
    if reference:
        blocks.append(("qr", run.reference))
    if run.temperature is not None:
        blocks.append(("temp", run.temperature))
    names = ["t", *(f"{name}{k + 1}" for name, block in blocks for k in range(block.shape[1]))]
    values = np.column_stack([run.t, *(block for _, block in blocks)])
    np.savetxt(path, values, fmt="%.12g", delimiter=",", header=",".join(names), comments="")
