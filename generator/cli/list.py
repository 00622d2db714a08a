"""List the robots in robots/ with their parameter sets."""

from __future__ import annotations

import argparse

from generator.errors import InputError
from generator.resources import robots


def configure(parser: argparse.ArgumentParser) -> None:
    """No arguments."""


def run(arguments: argparse.Namespace) -> None:
    """Prints one robot per line: name, moving joints, parameter sets, description.

    Raises InputError for the first file that is bad, after the good ones.
    """
    from generator.robot.readers import read

    known, refused = [], []
    for path in robots():
        try:
            known.append(read(path))
        except InputError as error:
            refused.append(error)
    rows = [("robot", "joints", "parameter sets", "description")]
    rows += [
        (robot.name, str(len(robot.moving)), ", ".join(robot.parameter_sets) or "-", robot.description)
        for robot in known
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for name, joints, sets, description in rows:
        print(f"{name:{widths[0]}}  {joints:>{widths[1]}}  {sets:{widths[2]}}  {description}")
    if refused:
        raise refused[0]
