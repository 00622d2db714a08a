"""All that a simulated run depends on beside the robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from identification.arrays import Array
from identification.default_sets import FLEXIBLE, RIGID
from identification.sidecar import Payload
from identification.trajectory import Value

#: Columns that are logged if asked for: the reference, encoders of the links, temperatures of the drives.
FURTHER = ("qr", "qs", "temp")
#: Time [s] of a run whose trajectory has no length of its own.
_LASTS = 20.0


@dataclass(frozen=True)
class Settings:
    """Settings of one run; sequences have one value, or one a motor in order.

    ``parameters`` names a set of the robot file, else ``twin`` or ``twin_flexible``; ``pose`` [rad, m] is where the
    trajectory starts or is centred, else the middle of the limits; ``duration`` [s] is else that of the trajectory, or
    20 s where it has none of its own; ``rate`` [Hz] is the controller's, ``log_rate`` the log's (the same if None).
    ``further`` columns are of FURTHER.

    ``bandwidth`` [Hz] is that of the speed loops, ``largest`` [A, else N m, N of the rotor] cuts the current.
    ``resolution`` [rad, m] is a step of the motors' encoders (the joints' where there are no drives), ``noise`` the
    rms of the logged effort in its unit, ``wrench_noise`` that of logged forces [N], and of moments [N m] if it has
    two values. ``delay`` [s] is how late controller and log see the motors, ``link_delay``
    how late the log sees the links. ``payload`` is on the tool in the whole run.

    At warmth 1 frictions have changed by ``friction_drift``, torque constants by ``constant_drift`` (parts of their
    first values), and the drives' temperature has risen from ``temperature`` by ``rise`` [K].
    """

    trajectory: str = "fourier"
    trajectory_settings: Mapping[str, Value] = field(default_factory=dict)
    flexible: bool = False
    parameters: str | None = None
    pose: Sequence[float] | None = None
    duration: float | None = None
    seed: int = 0
    noise_seed: int | None = None
    rate: float = 1000.0
    log_rate: float | None = None
    further: Sequence[str] = ()
    bandwidth: float = 6.0
    largest: Sequence[float] = (np.inf,)
    resolution: Sequence[float] = (0.0,)
    noise: Sequence[float] = (0.0,)
    wrench_noise: Sequence[float] = (0.0,)
    delay: float = 0.0
    link_delay: float = 0.0
    friction_drift: float = 0.0
    constant_drift: float = 0.0
    warm_up: float | None = None
    temperature: float = 293.15
    rise: float = 30.0
    payload: Payload | None = None

    @property
    def period(self) -> float:
        """Of a sample of the controller [s]."""
        return 1 / self.rate

    @property
    def lasts(self) -> float:
        """Time of the run [s]; a trajectory's own length is no part of the settings, see ``checks.timed``."""
        return _LASTS if self.duration is None else self.duration

    @property
    def samples(self) -> int:
        """Samples of the controller in the run."""
        return round(self.lasts * self.rate)

    @property
    def every(self) -> int:
        """Which samples are logged: each one, each second one and so on."""
        return round(self.rate / (self.log_rate or self.rate))

    @property
    def set_name(self) -> str:
        """The parameter set."""
        return self.parameters or self.default_set

    @property
    def default_set(self) -> str:
        """The parameter set where none is told."""
        return FLEXIBLE if self.flexible else RIGID

    def warmth(self, t: Array) -> Array:
        """How warm the drives are at times (N) [s]: 1 - exp(-t/T) with T the time ``warm_up`` [s].

        Without that time it grows evenly to 1 at the end.
        """
        return t / (self.samples * self.period) if self.warm_up is None else 1 - np.exp(-t / self.warm_up)

    def late(self, delay: float) -> int:
        """A delay in samples of the controller."""
        return round(delay * self.rate)
