"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

_ABSENT = "-"


def table(rows: Sequence[Mapping[str, object]]) -> str:
    """Rows of named cells as a table, empty for no rows; columns in the order in which they first occur.

    Numbers stand on the right. A cell that a row lacks is a dash.
    """
    if not rows:
        return ""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    numeric = {column for column in columns if any(_is_number(row.get(column)) for row in rows)}
    rule = ["---:" if column in numeric else "---" for column in columns]
    cells = [[_cell(row.get(column)) for column in columns] for row in rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in (columns, rule, *cells))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _cell(value: object) -> str:
    if value is None:
        return _ABSENT
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)
