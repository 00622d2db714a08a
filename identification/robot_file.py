"""Parameter sets written into the text of a robot file; everything else in it stays as it is."""

from __future__ import annotations

import re

from generator.robot.description import ParameterSet, ParameterValue

#: Digits of a written value, and the smallest amount [SI] that is not written as zero.
_DIGITS, _NOTHING = 6, 1e-6

_SECTION = re.compile(r"^parameters: *(?:#[^\n]*)?\n(?:(?:[ #][^\n]*)?\n)*", re.MULTILINE)


def rounded(value: float) -> float:
    """The number that is read back where ``value`` is written."""
    return float(_number(value))


def with_parameter_set(text: str, one: ParameterSet) -> str:
    """``text`` with the set ``one`` in place of the set of that name, else as the last of its section ``parameters``.

    Values are in SI and keep six significant digits; units and notes go with them, sources as one for the set.

    Sets are looked for as keys indented by two spaces. Raises ValueError where the section is not written one key a line.
    """
    section = _SECTION.search(text)
    if section is None:
        if re.search(r"^parameters:", text, re.MULTILINE):
            raise ValueError("section parameters is not written one key a line")
        return f"{text.rstrip()}\n\nparameters:\n{_written(one)}"
    present = re.compile(rf"^  {re.escape(one.name)}:[^\n]*\n(?:(?:    [^\n]*)?\n)*", re.MULTILINE)
    old = present.search(section[0])
    if old is None:
        changed = f"{section[0].rstrip()}\n\n{_written(one)}"
    else:
        after = section[0][old.end() :]
        changed = section[0][: old.start()] + _written(one) + ("\n" if after else "") + after
    rest = text[section.end() :]
    return text[: section.start()] + changed + ("\n" if rest else "") + rest


def _written(one: ParameterSet) -> str:
    lines = [f"  {one.name}:", f"    description: {_quoted(one.description)}", f"    source: {_quoted(one.source)}", "    values:"]
    lines += [f"      {name}: {{{_value(value)}}}" for name, value in one.values.items()]
    if one.other_values:
        lines += ["    other_values:"]
        lines += [f"      {name}: {{{_value(value)}}}" for name, value in one.other_values.items()]
    return "\n".join(lines) + "\n"


def _value(value: ParameterValue) -> str:
    parts = [f"value: {_number(value.value)}", f"unit: {value.unit}"]
    if value.relative_std is not None:
        parts.append(f"relative_std: {value.relative_std:.3g}")
    if value.note:
        parts.append(f"note: {_quoted(value.note)}")
    return ", ".join(parts)


def _number(value: float) -> str:
    """Six significant digits, an exponent without sign or padding where it is positive."""
    if abs(value) < _NOTHING:
        return "0"
    mantissa, _, exponent = f"{value:.{_DIGITS}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
