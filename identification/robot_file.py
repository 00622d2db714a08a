"""Parameter sets written into the text of a robot file; everything else in it stays as it is."""

from __future__ import annotations

import re
import textwrap

from generator.robot.description import ParameterSet, ParameterValue

#: Digits of a written value, and the smallest amount [SI] that is not written as zero.
_DIGITS, _NOTHING = 6, 1e-6
_WIDTH = 120

#: The section with its sets, up to where blank lines and comments lead over to the next section or the end.
_SECTION = re.compile(
    r"^parameters: *(?:#[^\n]*)?\n(?P<sets>(?:(?:[ #][^\n]*)?\n)*?)(?=(?:(?:#[^\n]*)?\n)*(?:[^ #\n]|\Z))", re.MULTILINE
)


def rounded(value: float) -> float:
    """The number that is read back where ``value`` is written."""
    return float(_number(value))


def with_parameter_set(text: str, one: ParameterSet) -> str:
    """``text`` with the set ``one`` in place of the set of that name, else as the last of its section ``parameters``.

    Values are in SI and keep six significant digits; units, standard deviations and notes go with them, the source with
    the set. Sets are looked for as keys indented by two spaces.

    Raises ValueError where the section is not written one key a line.
    """
    text = text.rstrip() + "\n"
    section = _SECTION.search(text)
    if section is None:
        if re.search(r"^parameters:", text, re.MULTILINE):
            raise ValueError("section parameters is not written one key a line")
        return f"{text}\nparameters:\n{_written(one)}"
    sets, new = section["sets"], _written(one)
    old = re.search(rf"^  {re.escape(one.name)}:[^\n]*\n(?:(?:    [^\n]*)?\n)*", sets, re.MULTILINE)
    if old is None:
        sets = f"{sets}\n{new}" if sets else new
    else:
        after = sets[old.end() :]
        sets = sets[: old.start()] + new + ("\n" if after else "") + after
    return text[: section.start("sets")] + sets + text[section.end("sets") :]


def _written(one: ParameterSet) -> str:
    lines = [f"  {one.name}:", _folded("description", one.description), _folded("source", one.source)]
    for key, values in (("values", one.values), ("other_values", one.other_values)):
        if values or key == "values":
            lines += [f"    {key}:", *(f"      {name}: {{{_value(value)}}}" for name, value in values.items())]
    return "\n".join(lines) + "\n"


def _folded(key: str, text: str) -> str:
    """A text of the set over as many lines as it needs; reading makes them one."""
    wrapper = textwrap.TextWrapper(_WIDTH, subsequent_indent=" " * 6, break_long_words=False, break_on_hyphens=False)
    return wrapper.fill(f"    {key}: {_quoted(text)}")


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
