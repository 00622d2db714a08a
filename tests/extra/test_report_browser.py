"""Reports in a browser: nothing fails, nothing is fetched, charts are drawn, choices on the page go together."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.extra.browser import document, visit
from tests.reports import KINDS, report_of

#: What make test-extra looks at, and what only make test-long does.
FIRST = ("identify", "diagnose")
FURTHER = [kind for kind in KINDS if kind not in FIRST]

#: Run in a copy of the page: where the charts are and what they say of themselves; then all buttons are pressed.
_MEASURE = """
<script>
const visible = () => [...document.querySelectorAll(".chart")].filter(chart => chart.offsetParent !== null);
const boxes = visible().map(chart => chart.getBoundingClientRect())
    .map(box => [box.left, box.top, box.right, box.bottom].map(Math.round));
const undrawn = [];
for (const button of document.querySelectorAll(".options button")) {
  if (button.offsetParent === null) continue;
  const { group } = button.closest(".choice").dataset;
  button.click();
  const name = `${group} ${button.value}`;
  for (const chart of visible()) if (!chart.querySelector(".main-svg")) undrawn.push(name);
  for (const other of document.querySelectorAll(`.choice[data-group="${group}"]`)) {
    const pressed = [...other.querySelectorAll(":scope > .options > button[aria-pressed=true]")].map(one => one.value);
    if (pressed.length !== 1 || pressed[0] !== button.value) undrawn.push(`${name}: ${pressed}`);
  }
}
const told = { boxes, undrawn, width: document.documentElement.scrollWidth, window: window.innerWidth };
const holder = document.createElement("pre");
holder.id = "told";
holder.textContent = JSON.stringify(told);
document.body.append(holder);
</script>
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], bytes]:
    """The report of a kind, made once."""
    return cache(lambda kind: report_of(kind, tmp_path_factory.mktemp("reports") / kind))


def measured(page: bytes, folder: Path, width: int) -> dict[str, Any]:
    copy = folder / "measured.html"
    copy.write_bytes(page.replace(b"</body>", f"{_MEASURE}</body>".encode()))
    told = document(copy, folder, width, 1000).split('<pre id="told">')[1].split("</pre>")[0]
    found: dict[str, Any] = json.loads(unescape(told))
    return found


@pytest.mark.parametrize("kind", [*FIRST, *(pytest.param(kind, marks=pytest.mark.long) for kind in FURTHER)])
def test_a_report_is_quiet_and_its_charts_are_drawn(written: Callable[[str], bytes], kind: str, tmp_path: Path) -> None:
    told = measured(written(kind), tmp_path, 1440)
    assert told["undrawn"] == []
    assert told["width"] <= told["window"]
    path = tmp_path / "report.html"
    path.write_bytes(written(kind))
    seen = visit(path, tmp_path, 1440, max(bottom for *_, bottom in told["boxes"]) + 50)
    assert seen.console == ()
    assert seen.requests == ()
    assert len(told["boxes"]) >= 1
    for box in told["boxes"]:
        region = seen.region(*box)
        assert np.var(region.astype(float)) > 20
        assert len(np.unique(region, axis=0)) > 12


def test_a_report_fits_a_narrow_screen(written: Callable[[str], bytes], tmp_path: Path) -> None:
    told = measured(written("identify"), tmp_path, 500)
    assert told["width"] <= told["window"]
    assert told["undrawn"] == []
