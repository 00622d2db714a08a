"""Times of day in place of seconds, with a date or without: 12:03:04.5, 2026-03-02T12:03:04.5+01:00."""

from __future__ import annotations

import re
from collections.abc import Iterable
from datetime import date

import numpy as np

from identification.arrays import Array

_DAY, _HOUR, _MINUTE = 86400.0, 3600, 60
_DATE = r"(?:(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)[T ])?"
_TIME = r"(?P<hour>[01]?\d|2[0-3]):(?P<minute>[0-5]\d):(?P<second>[0-5]\d)(?P<part>[.,]\d+)?"
_ZONE = r"(?:Z|(?P<sign>[+-])(?P<ahead>\d\d):?(?P<minutes>\d\d))?"
_FORM = re.compile(rf"{_DATE}{_TIME}{_ZONE}", re.ASCII)


def is_clock_time(text: str) -> bool:
    """Whether a text is a time of day."""
    return _since_midnight(text.strip()) is not None


def seconds(texts: Iterable[str]) -> Array:
    """Seconds (N) from the first of times of day; NaN where a text is none. Without dates a run may go past midnight
    if less than half a day lies between two rows.
    """
    times = [_since_midnight(text.strip()) for text in texts]
    first_day, first = next((one for one in times if one is not None), (0, 0.0))
    # Days are whole, so that the digits of a second's parts are not lost in them.
    t = np.array([np.nan if one is None else (one[0] - first_day) * _DAY + (one[1] - first) for one in times])
    if not first_day:
        t[1:] += _DAY * np.cumsum(np.diff(t) < -_DAY / 2)
    return t


def _since_midnight(text: str) -> tuple[int, float] | None:
    """The number of the day, zero without a date, and seconds since its midnight in the zone that the text tells; None
    where it is no time of day.
    """
    found = _FORM.fullmatch(text)
    if found is None:
        return None
    whole = _HOUR * int(found["hour"]) + _MINUTE * int(found["minute"]) + int(found["second"])
    if found["sign"]:
        ahead = _HOUR * int(found["ahead"]) + _MINUTE * int(found["minutes"])
        whole -= ahead if found["sign"] == "+" else -ahead
    part = float((found["part"] or "0").replace(",", "."))
    try:
        day = date(*(int(found[name]) for name in ("year", "month", "day"))).toordinal() if found["year"] else 0
    except ValueError:
        return None
    return day, whole + part
