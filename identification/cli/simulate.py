"""Simulate a robot under its controller and write the run as the controller would record it.

The robot has the values of a parameter set of its file: by default twin, or twin_flexible with --flexible. FILE is a
CSV with motor positions and currents (joint positions and torques if the robot has no drives), which identify reads. A
YAML file beside it lists everything that was simulated. The same settings give the same bytes on one machine.

docs/simulate.md describes the trajectories and their settings for --set; an unknown name lists them. Options for
motors take one value, or one value per motor in order.
"""

from __future__ import annotations

import argparse
import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.command_line import command_line
from generator.errors import InputError
from generator.given_once import given_once
from generator.progress import bar, stage
from generator.resources import find_robot
from generator.words import plural
from generator.writing import spare, writable
from identification.default_sets import FLEXIBLE, RIGID
from identification.extras import needing

if TYPE_CHECKING:
    from identification.simulation.settings import Settings
    from identification.trajectory import Value


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --out, the model, the trajectory, the controller, what is measured."""
    takes_robot(parser)
    takes_out(parser, "the run (default: simulated/ROBOT/TRAJECTORY_SEED.csv)", metavar="FILE")
    parser.add_argument("--flexible", action="store_true", help="with elastic drive trains")
    parser.add_argument(
        "--parameters",
        metavar="SET",
        help=f"parameter set of the robot file (default: {RIGID}; {FLEXIBLE} with --flexible)",
    )
    _motion(parser.add_argument_group("motion"))
    _controller(parser.add_argument_group("controller"))
    _log(parser.add_argument_group("what is measured"))
    parser.add_argument(
        "--payload",
        metavar="NAME=VALUE",
        nargs="+",
        help="a body on the tool with these values, such as M=150 MZ=-15 [kg, kg m, kg m2]",
    )
    _temperature(parser.add_argument_group("temperature"))


def _motion(group: argparse._ActionsContainer) -> None:
    group.add_argument("--trajectory", metavar="NAME", default="fourier", help="the motion (default: fourier)")
    group.add_argument("--set", metavar="NAME=VALUE", nargs="+", default=[], help="settings of the trajectory")
    group.add_argument(
        "--pose", metavar="Q", type=float, nargs="+", help="start or centre [rad, m] (default: middle of the limits)"
    )
    group.add_argument(
        "--duration", metavar="S", type=float, help="time of the run (default: 20; that of a played file)"
    )
    group.add_argument("--seed", metavar="N", type=int, default=0, help="seed of trajectory and noise (default: 0)")
    group.add_argument("--noise-seed", metavar="N", type=int, help="seed of the noise (default: that of --seed)")


def _controller(group: argparse._ActionsContainer) -> None:
    group.add_argument("--rate", metavar="HZ", type=float, default=1000.0, help="sampling rate (default: 1000)")
    group.add_argument(
        "--bandwidth", metavar="HZ", type=float, default=6.0, help="bandwidth of the speed loops (default: 6)"
    )
    group.add_argument(
        "--largest",
        metavar="A",
        type=float,
        nargs="+",
        default=[float("inf")],
        help="limit of the currents (default: none)",
    )


def _log(group: argparse._ActionsContainer) -> None:
    group.add_argument("--log-rate", metavar="HZ", type=float, help="rate of the log (default: as --rate)")
    group.add_argument(
        "--also",
        metavar="STEM",
        nargs="+",
        default=[],
        help="further columns; qr: reference, qs: encoders of the links, temp: temperatures of the drives",
    )
    group.add_argument(
        "--resolution",
        metavar="RAD",
        type=float,
        nargs="+",
        default=[0.0],
        help="step of the motors' encoders [rad, m] (default: 0)",
    )
    group.add_argument(
        "--noise",
        metavar="A",
        type=float,
        nargs="+",
        default=[0.0],
        help="rms of the noise [A; N m or N without torque constants] (default: 0)",
    )
    group.add_argument(
        "--wrench-noise",
        metavar="N",
        type=float,
        nargs="+",
        default=[0.0],
        help="rms of the wrench's noise: forces [N], then moments [N m] (default: 0)",
    )
    group.add_argument("--delay", metavar="S", type=float, default=0.0, help="delay of motor positions (default: 0)")
    group.add_argument(
        "--link-delay", metavar="S", type=float, default=0.0, help="delay of link positions (default: 0)"
    )


def _temperature(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--friction-drift",
        metavar="R",
        type=float,
        default=0.0,
        help="relative change of friction at warmth 1, such as -0.2 (default: 0)",
    )
    group.add_argument(
        "--torque-constant-drift",
        metavar="R",
        type=float,
        default=0.0,
        help="relative change of the torque constants at warmth 1, such as -0.05 (default: 0)",
    )
    group.add_argument(
        "--warm-up",
        metavar="S",
        type=float,
        help="warmth is 1 - exp(-t/S) (default: it grows evenly to 1 at the end)",
    )
    group.add_argument(
        "--temperature", metavar="K", type=float, default=293.15, help="of the drives at the start (default: 293.15)"
    )
    group.add_argument(
        "--temperature-rise", metavar="K", type=float, default=30.0, help="rise at warmth 1 (default: 30)"
    )


def run(arguments: argparse.Namespace) -> None:
    """Simulates, writes the run and its sidecar, prints a summary."""
    from generator.robot.readers import read

    with needing(command_line("counterpoise simulate")):
        from identification.simulation.checks import check, timed
        from identification.simulation.machine import compiled
        from identification.simulation.run_file import files_of, free, save
        from identification.simulation.simulate import simulate

    settings = _settings(arguments)
    path = find_robot(arguments.robot)
    robot = read(path)
    out = arguments.out or Path("simulated") / robot.name / f"{settings.trajectory}_{settings.seed}.csv"
    if out.suffix != ".csv":
        raise InputError(command_line("--out"), f"a file that ends in {out.suffix!r}", "one that ends in .csv")
    played = (Path(value) for value in settings.trajectory_settings.values() if isinstance(value, str))
    for source in (path, *(file for file in played if os.path.isfile(file))):
        spare(source, files_of(out))
    settings = timed(settings)
    check(settings, robot)
    writable(out.parent)
    free(out)
    with contextlib.ExitStack() as stack:
        with stage(f"compiling the simulation of {robot.name}"):
            machine = stack.enter_context(compiled(robot))
        with bar(f"simulating {settings.lasts:g} s") as progress:
            found = simulate(machine, settings, progress)
    files = save(found, robot.name, robot.digest, out)
    rows = len(found.columns["t"])
    print(f"{robot.name}: {plural(rows, 'row')} of {', '.join(found.columns)}")
    print(f"files            {', '.join(map(str, files))}")


def _settings(arguments: argparse.Namespace) -> Settings:
    from identification.sidecar import given
    from identification.simulation.settings import Settings

    given_once(arguments.set, command_line("--set"))
    return Settings(
        trajectory=arguments.trajectory,
        trajectory_settings=dict(map(_setting, arguments.set)),
        flexible=arguments.flexible,
        parameters=arguments.parameters,
        pose=arguments.pose,
        duration=arguments.duration,
        seed=arguments.seed,
        noise_seed=arguments.noise_seed,
        rate=arguments.rate,
        log_rate=arguments.log_rate,
        further=arguments.also,
        bandwidth=arguments.bandwidth,
        largest=arguments.largest,
        resolution=arguments.resolution,
        noise=arguments.noise,
        wrench_noise=arguments.wrench_noise,
        delay=arguments.delay,
        link_delay=arguments.link_delay,
        friction_drift=arguments.friction_drift,
        constant_drift=arguments.torque_constant_drift,
        warm_up=arguments.warm_up,
        temperature=arguments.temperature,
        rise=arguments.temperature_rise,
        payload=None if arguments.payload is None else given(arguments.payload, command_line("--payload")),
    )


def _setting(word: str) -> tuple[str, Value]:
    """A word such as ``harmonics=5`` or ``profile=smooth``."""
    name, equals, text = word.partition("=")
    if not equals:
        raise InputError(command_line("--set"), f"{word!r}", "NAME=VALUE")
    try:
        return name, float(text)
    except ValueError:
        return name, text
