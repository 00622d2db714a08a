"""All that a simulated run depends on beside the robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from generator.cli.place import command_line
from generator.errors import InputError
from generator.robot.fields import nearest
from identification.trajectory import Array, Trajectory, Value

#: Columns that are logged if asked for: the reference, encoders of the links.
FURTHER = ("qr", "qs")


@dataclass(frozen=True)
class Settings:
    """Settings of one run; sequences have one value, or one a motor in order.

    ``parameters`` names a set of the robot file, else ``twin`` or ``twin_flexible``; ``pose`` [rad, m] is where the
    trajectory starts or is centred, else the middle of the limits; ``duration`` [s]; ``rate`` [Hz] of the controller,
    ``log_rate`` of the log (the same if None). ``further`` columns are of FURTHER.

    ``bandwidth`` [Hz] is that of the speed loops, ``largest`` [A, else N m, N of the rotor] cuts the current.
    ``resolution`` [rad, m] is a step of the motors' encoders (the joints' where there are no drives), ``noise`` the
    rms of the logged effort in its unit. ``delay`` [s] is how late controller and log see the motors, ``link_delay``
    how late the log sees the links. By the end of the run frictions have changed by ``friction_drift``, torque
    constants by ``constant_drift`` (parts of their first values), evenly in time.
    """

    trajectory: str = "fourier"
    trajectory_settings: Mapping[str, Value] = field(default_factory=dict)
    flexible: bool = False
    parameters: str | None = None
    pose: Sequence[float] | None = None
    duration: float = 20.0
    seed: int = 0
    noise_seed: int | None = None
    rate: float = 1000.0
    log_rate: float | None = None
    further: Sequence[str] = ()
    bandwidth: float = 6.0
    largest: Sequence[float] = (np.inf,)
    resolution: Sequence[float] = (0.0,)
    noise: Sequence[float] = (0.0,)
    delay: float = 0.0
    link_delay: float = 0.0
    friction_drift: float = 0.0
    constant_drift: float = 0.0

    @property
    def period(self) -> float:
        """Of a sample of the controller [s]."""
        return 1 / self.rate

    @property
    def samples(self) -> int:
        """Samples of the controller in the run."""
        return round(self.duration * self.rate)

    @property
    def every(self) -> int:
        """Which samples are logged: each one, each second one and so on."""
        return round(self.rate / (self.log_rate or self.rate))

    @property
    def set_name(self) -> str:
        """The parameter set."""
        return self.parameters or ("twin_flexible" if self.flexible else "twin")

    def late(self, delay: float) -> int:
        """A delay in samples of the controller."""
        return round(delay * self.rate)


def each(values: Sequence[float], n: int, option: str) -> Array:
    """One value a motor (n); raises InputError for another count than one or n."""
    if len(values) not in (1, n):
        raise InputError(command_line(option), f"{len(values)} numbers", f"one, or one for each of {n} motors")
    return np.array(np.broadcast_to(np.asarray(values, dtype=float), (n,)))


def check(settings: Settings) -> None:
    """Raises InputError for a number that is out of its range; the place is the option of the command."""
    for option, value, least in (
        ("--duration", settings.duration, 0.0),
        ("--rate", settings.rate, 0.0),
        ("--bandwidth", settings.bandwidth, 0.0),
        *(("--largest", one, 0.0) for one in settings.largest if one != np.inf),
        ("--friction-drift", settings.friction_drift, -1.0),
        ("--torque-constant-drift", settings.constant_drift, -1.0),
    ):
        if not least < value < np.inf:
            raise InputError(command_line(option), f"{value:g}", f"a number above {least:g}")
    for option, values in (
        ("--resolution", settings.resolution),
        ("--noise", settings.noise),
        ("--delay", [settings.delay]),
        ("--link-delay", [settings.link_delay]),
    ):
        for value in values:
            if not 0 <= value < np.inf:
                raise InputError(command_line(option), f"{value:g}", "a number that is not negative")
    for option, seed in (("--seed", settings.seed), ("--noise-seed", settings.noise_seed or 0)):
        if seed < 0:
            raise InputError(command_line(option), f"{seed}", "a whole number that is not negative")
    if settings.samples < 2:
        raise InputError(command_line("--duration"), f"{settings.duration:g} s is one sample", "a longer run")
    if settings.log_rate is not None:
        ratio = settings.rate / settings.log_rate if settings.log_rate > 0 else 0.0
        if ratio < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            whole = f"--rate, {settings.rate:g} Hz, divided by a whole number"
            raise InputError(command_line("--log-rate"), f"{settings.log_rate:g}", whole)
    if settings.link_delay and "qs" not in settings.further:
        raise InputError(command_line("--link-delay"), "no encoders of the links are logged", "--also qs")


def chosen(kind: Trajectory, given: Mapping[str, Value]) -> dict[str, Value]:
    """Values of all settings of a trajectory, those ``given`` [SI] before the defaults.

    Raises InputError for a setting that the trajectory has not and for a value out of its range.
    """
    place = command_line("--set")
    values = {name: one.default for name, one in kind.settings.items()}
    for name, value in given.items():
        if name not in kind.settings:
            known = ", ".join(f"{one}={setting.default}" for one, setting in kind.settings.items())
            raise InputError(place, f"trajectory {kind.name} has no setting {name!r}", known)
        setting = kind.settings[name]
        if setting.choices:
            if value not in setting.choices:
                raise InputError(place, f"{name} is {value!r}", f"one of {', '.join(setting.choices)}")
        elif isinstance(value, str) or not setting.above < value < np.inf:
            raise InputError(place, f"{name} is {value}", f"a number above {setting.above:g}, {setting.meaning}")
        values[name] = value
    return values


def trajectory_of(name: str, known: Mapping[str, Trajectory]) -> Trajectory:
    """The trajectory of a name; raises InputError where there is none."""
    if name not in known:
        raise InputError(command_line("--trajectory"), f"there is no trajectory {name!r}", nearest(name, known))
    return known[name]
