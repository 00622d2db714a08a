"""Print a robot's groupings, geometry, effects and parameter names: the text of review/groupings.md."""

from __future__ import annotations

import argparse

from generator.cli.shared_arguments import takes_robot
from generator.progress import stage
from generator.resources import find_robot


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT."""
    takes_robot(parser)


def run(arguments: argparse.Namespace) -> None:
    """Prints the groupings in Markdown."""
    from generator.backends import review
    from generator.derivation import derive
    from generator.robot.readers import read

    path = find_robot(arguments.robot)
    with stage("deriving the groupings"):
        text = review.groupings(derive(read(path)))
    print(text, end="")
