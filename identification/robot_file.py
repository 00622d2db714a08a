"""Parameter sets written into the text of a robot file; everything else in it stays as it is."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from generator.robot import fields
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.document import Text
from generator.robot.readers import with_single_ends, yaml

_SECTION = "parameters"

#: Digits of a written value, and the smallest amount [SI] that is not written as zero: rounding of a fit leaves less.
_DIGITS, _NOTHING = 6, 1e-11
_WIDTH = 120


@dataclass(frozen=True)
class _Layout:
    """How an entry is written: its column, how much further in the entries of its table stand, in braces or not."""

    column: int
    step: int = 2
    braces: bool = False

    @property
    def lead(self) -> str:
        return " " * self.column

    @property
    def within(self) -> _Layout:
        return _Layout(self.column + self.step, self.step, self.braces)


def rounded(value: float) -> float:
    """The number that is read back where ``value`` is written."""
    return float(written(value))


def with_parameter_set(text: str, one: ParameterSet, file: str = "robot file") -> str:
    """``text`` with the set ``one`` in place of the set of that name, else as the last of its section ``parameters``.

    Values are in SI and keep six significant digits; units, standard deviations and notes go with them, the source with
    the set. The set is indented as those that are there, and stands in braces where they do. Line ends become single,
    as in reading.

    Raises InputError, ``file`` its name, for a text that is not YAML or whose section is not a table.
    """
    text = with_single_ends(text).rstrip() + "\n"
    _check(text, file)
    root = yaml.composed(text)
    above = _Layout(root.start_mark.column + (2 if root.flow_style else 0), braces=root.flow_style)
    sets = next((value for key, value in root.value if key.value == _SECTION), None)
    section = _table(_SECTION, [_written(one, above.within)], above)
    bare = sets is None or isinstance(sets.value, str)
    if bare and root.flow_style:
        return _between_braces(text, root, _SECTION, section)
    if sets is None:
        end = root.end_mark.index
        return f"{text[:end].rstrip()}\n\n{section}\n{text[end:]}"
    if bare or not sets.flow_style:
        return _between_lines(text, root, sets, one)
    start, end = sets.start_mark.index, sets.end_mark.index
    if not root.flow_style and re.fullmatch(r"{\s*}", text[start:end]):
        return with_parameter_set(text[:start].rstrip() + text[end:], one, file)
    return _between_braces(text, sets, one.name, _written(one, _Layout(above.within.column, braces=True)))


def _check(text: str, file: str) -> None:
    """Refuses what has no place for a set; a section without content has one."""
    section = fields.named(yaml.read(text, file), "the robot").get(_SECTION)
    if section and not (isinstance(section.value, Text) and not section.value.content and not section.value.quoted):
        fields.named(section.value, _SECTION)


def _between_braces(text: str, table: Any, name: str, entry: str) -> str:
    """``text`` with the ``entry`` called ``name`` in a table that stands in braces."""
    for key, value in table.value:
        if key.value == name:
            return text[: key.start_mark.index] + entry.lstrip() + text[value.end_mark.index :]
    if table.value:
        # Right after the value: what follows may be a comment, or a comma that leads to no other entry.
        end = table.value[-1][1].end_mark.index
        return f"{text[:end]},\n{entry}{text[end:]}"
    end = table.end_mark.index - 1
    return f"{text[:end].rstrip()}\n{entry}\n{text[end:]}"


def _between_lines(text: str, root: Any, sets: Any, one: ParameterSet) -> str:
    """``text`` with the set ``one`` in a section that has lines of its own for each set, or none yet."""
    above = root.start_mark.column
    start, end = _lines(root, _SECTION, root.end_mark.index)
    end = _before_comments(text, end, above)
    known = [] if isinstance(sets.value, str) else [key.value for key, _ in sets.value]
    column = sets.start_mark.column
    new = _written(one, _Layout(column, column - above) if known else _Layout(above).within) + "\n"
    if one.name in known:
        start, stop = _lines(sets, one.name, end)
        stop = _after_comments(text, _before_comments(text, stop, len(text)), stop, column)
        after = text[stop:end]
        return text[:start] + new + ("\n" if after else "") + after + text[end:]
    gap = "\n" if text.count("\n", start, end) > 1 else ""
    return text[:end] + gap + new + text[end:]


def _lines(table: Any, name: str, end: int) -> tuple[int, int]:
    """Where the lines of an entry begin and end in the text, what leads over to the next entry with them.

    ``end`` is that of the table, which has no braces.
    """
    names = [key.value for key, _ in table.value]
    starts = [key.start_mark.index - key.start_mark.column for key, _ in table.value]
    k = names.index(name)
    return starts[k], [*starts, end][k + 1]


def _before_comments(text: str, end: int, column: int) -> int:
    """Where the blank lines and comments begin that stand before ``end``.

    Comments further in than ``column`` count as content.
    """
    while end:
        start = text.rfind("\n", 0, end - 1) + 1
        content = text[start:end].lstrip(yaml.BLANKS)
        if content.strip() and not (content.startswith("#") and end - start - len(content) <= column):
            break
        end = start
    return end


def _after_comments(text: str, start: int, end: int, column: int) -> int:
    """Where the blank lines and the comments further in than ``column`` end that stand from ``start`` on."""
    blank = f"[{yaml.BLANKS}]"
    found = re.match(rf"(?:{blank}{{{column + 1},}}#[^\n]*\n|{blank}*\n)*", text[start:end])
    return start + (found.end() if found else 0)


def _written(one: ParameterSet, layout: _Layout) -> str:
    inner = layout.within
    entries = [_folded("description", one.description, inner), _folded("source", one.source, inner)]
    for key, values in (("values", one.values), ("other_values", one.other_values)):
        if values or key == "values":
            lines = [f"{inner.within.lead}{name}: {{{_value(value)}}}" for name, value in values.items()]
            entries.append(_table(key, lines, inner))
    return _table(one.name, entries, layout)


def _table(name: str, entries: Sequence[str], layout: _Layout) -> str:
    """A table, its ``entries`` written for the inside of ``layout``."""
    lead = f"{layout.lead}{name}:"
    if not entries:
        return f"{lead} {{}}"
    if layout.braces:
        return f"{lead} {{\n" + ",\n".join(entries) + f"\n{layout.lead}}}"
    return "\n".join([lead, *entries])


def _folded(key: str, text: str, layout: _Layout) -> str:
    """A text of the set over as many lines as it needs; reading makes them one."""
    # Between braces a comma follows.
    wrapper = textwrap.TextWrapper(
        _WIDTH - layout.braces,
        subsequent_indent=layout.within.lead,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return wrapper.fill(f"{layout.lead}{key}: {_quoted(text)}")


def _value(value: ParameterValue) -> str:
    parts = [f"value: {written(value.value)}", f"unit: {value.unit}"]
    if value.relative_std is not None:
        parts.append(f"relative_std: {value.relative_std:.3g}")
    if value.note:
        parts.append(f"note: {_quoted(value.note)}")
    return ", ".join(parts)


def written(value: float) -> str:
    """Six significant digits, an exponent without sign or padding where it is positive."""
    if abs(value) < _NOTHING:
        return "0"
    mantissa, _, exponent = f"{value:.{_DIGITS}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
