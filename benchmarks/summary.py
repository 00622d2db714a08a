"""The comparison with other libraries in short: one robot, ratios of time to the generated code's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from benchmarks.chart import Group

Row = Mapping[str, object]

_NAMES = ("robot", "function")


def summary(rows: Sequence[Row]) -> list[dict[str, object]]:
    """A row for each function of the first robot: our time, then the other libraries' as multiples of it."""
    result = []
    for row in _of_first_robot(rows):
        own, others = _times(row)
        result.append(
            {
                str(row["robot"]): row["function"],
                "ns a call": own,
                **{peer: f"{time / own:.1f} ×" for peer, time in others.items()},
            }
        )
    return result


def bars(rows: Sequence[Row]) -> list[Group]:
    """The same for the picture."""
    groups = []
    for row in _of_first_robot(rows):
        own, others = _times(row)
        name = str(row["function"]).replace("_", " ")
        groups.append(Group(name, {peer: time / own for peer, time in others.items()}))
    return groups


def _of_first_robot(rows: Sequence[Row]) -> list[Row]:
    """Rows that count and that other libraries have a part in."""
    kept = [row for row in rows if row["robot"] == rows[0]["robot"]]
    return [row for row in kept if any(_is_time(row, peer) and not _is_ours(peer) for peer in row)]


def _times(row: Row) -> tuple[float, dict[str, float]]:
    """Our time, of the first of our columns, and the others'."""
    times = {name: float(str(row[name])) for name in row if _is_time(row, name)}
    own = next(time for name, time in times.items() if _is_ours(name))
    return own, {name: time for name, time in times.items() if not _is_ours(name)}


def _is_time(row: Row, name: str) -> bool:
    return name not in _NAMES and "/" not in name and isinstance(row[name], float)


def _is_ours(name: str) -> bool:
    return name.startswith("Counterpoise")
