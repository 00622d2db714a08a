"""Compare two sets of parameter values, one by one: relative differences, and whether they can be noise.

A and B are results (results.json, or a model of it: results.json:essential, results.json:consistent) or parameter sets
of robots (ROBOT:SET). Differences are in percent of A. DIR receives comparison.json and report.html.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from generator.cli.shared_arguments import takes_out
from generator.command_line import command_line
from generator.words import plural
from identification.extras import needing

if TYPE_CHECKING:
    from identification.comparison import Comparison, Difference
    from identification.parameter_source import Known


def configure(parser: argparse.ArgumentParser) -> None:
    """A, B, --out."""
    parser.add_argument("a", metavar="A", help="the reference values: RESULTS.json or ROBOT:SET")
    parser.add_argument("b", metavar="B", help="the values to compare with A")
    takes_out(parser, "where the files go (default: no files)")


def run(arguments: argparse.Namespace) -> None:
    """Compares and prints a row a parameter."""
    with needing(command_line("counterpoise compare")):
        from identification.comparison import compare
        from identification.comparison_results import save, spare_reports
        from identification.parameter_source import parameters
        from identification.report.page import REPORT

    found = compare(parameters(arguments.a), parameters(arguments.b))
    if arguments.out is not None:
        spare_reports(found, arguments.out, REPORT)
    lines = [_table(found)]
    if arguments.out is not None:
        from identification.report.compare.report import report

        files = save(found, arguments.out, {REPORT: report(found)})
        lines.append(f"files            {', '.join(files)} in {arguments.out}/")
    print("\n".join(lines))


def _table(found: Comparison) -> str:
    from identification.comparison import AGREE

    width = max(map(len, [*found.differences, "parameter"]))
    lines = [f"A {found.a.name}, B {found.b.name}"]
    lines.append(f"{'parameter'.ljust(width)} {'A':>12} {'B':>12} {'e %':>9} {'std of A %':>10}  unit")
    lines += [_row(one, width) for one in found.differences.values()]
    common = list(found.common)
    told = [one for one in common if one.agrees is not None]
    agreeing = sum(1 for one in told if one.agrees)
    lines.append(
        f"{plural(len(common), 'parameter')} in common; {agreeing} of {len(told)} with a std agree within {AGREE:g} std"
    )
    return "\n".join(lines)


def _row(one: Difference, width: int) -> str:
    percent = "" if one.percent is None else f"{one.percent:.1f}"
    apart = "" if one.agrees is not False else f"  {one.deviations:.1f} std apart"
    return (
        f"{one.name.ljust(width)} {_value(one.a):>12} {_value(one.b):>12} {percent:>9} {_relative(one.a):>10}"
        f"  {one.unit}{apart}"
    )


def _value(one: Known | None) -> str:
    if one is None:
        return "-"
    return "unknown" if one.value is None else f"{one.value:.6g}"


def _relative(one: Known | None) -> str:
    if one is None or one.std is None or not one.value:
        return ""
    return f"{100 * one.std / abs(one.value):.3g}"
