"""Check a robot file: its form, its effects, its parameter sets, and its groupings against the regressor's rank."""

from __future__ import annotations

import argparse

from generator.cli.shared_arguments import takes_robot
from generator.progress import stage
from generator.resources import find_robot
from generator.words import plural


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT."""
    takes_robot(parser)


def run(arguments: argparse.Namespace) -> None:
    """Prints one line if the file is good, and one for each limit it should have and each value that cannot be; raises
    InputError if not.
    """
    from generator.derivation import derive
    from generator.effects.library import missing_limits
    from generator.robot.readers import read
    from generator.symbolic.parameter_sets import impossible, impossible_bodies, regrouped, resolved_sets

    path = find_robot(arguments.robot)
    with stage("reading and deriving"):
        robot = read(path)
        model = derive(robot, names=())
        resolved_sets(model)
    print(
        f"{path}: {robot.name} is good: {plural(len(robot.moving), 'moving joint')}, "
        f"{plural(len(model.base_parameters), 'base parameter')}, {plural(len(robot.parameter_sets), 'parameter set')}"
    )
    for place, problem in missing_limits(robot):
        print(f"note: {place}: {problem}")
    for title, one in robot.parameter_sets.items():
        for note in impossible(model, regrouped(model, one.values), f" of the set {title}"):
            print(note)
        for note in impossible_bodies(model, one.values, f" of the set {title}"):
            print(note)
