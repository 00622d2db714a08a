"""Arguments that several commands take, so that each has one name and one help text."""

from __future__ import annotations

import argparse


def takes_robot(parser: argparse.ArgumentParser) -> None:
    """ROBOT, as ``find_robot`` takes it."""
    parser.add_argument("robot", metavar="ROBOT", help="a name in robots/ or the path of a robot file")
