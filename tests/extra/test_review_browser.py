"""The review page in a browser: nothing fails, nothing is fetched, pictures are drawn, labels keep apart."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from html import unescape
from pathlib import Path

import numpy as np
import pytest

from generator.backends import review
from generator.derivation import derive
from generator.resources import find_robot, robots
from generator.robot.readers import read
from tests.extra.browser import document, visit

#: Run in a copy of the page: where the pictures are, which labels of the arm overlap, how wide the page is.
_MEASURE = """
<script>
const rectangle = node => node.getBoundingClientRect();
const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
    && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
const sticksOut = (own, frame) => own.left < frame.left - 1 || own.right > frame.right + 1
    || own.top < frame.top - 1 || own.bottom > frame.bottom + 1;
const overlaps = [];
for (const picture of document.querySelectorAll("svg.arm, svg.plot")) {
  const labels = [...picture.querySelectorAll("text")];
  labels.forEach((a, i) => labels.slice(i + 1).forEach(b => {
    if (meet(rectangle(a), rectangle(b))) overlaps.push(a.textContent + " / " + b.textContent);
  }));
}
const out = [...document.querySelectorAll("svg text")]
    .filter(node => sticksOut(rectangle(node), rectangle(node.closest("svg")))).map(node => node.textContent);
const pictures = [...document.querySelectorAll("svg")].map(rectangle)
    .map(box => [box.left, box.top, box.right, box.bottom].map(Math.round));
const told = { pictures, overlaps, out, width: document.documentElement.scrollWidth, window: window.innerWidth };
const holder = document.createElement("pre");
holder.id = "told";
holder.textContent = JSON.stringify(told);
document.body.append(holder);
</script>
"""


#: Robots whose page is looked at each time: one of the report's, and a branch with a slide.
ALWAYS = ("kr500", "tree_two_arms")


@dataclass(frozen=True)
class Measures:
    """Boxes of the pictures [px], labels that overlap or leave their picture, width of the page and of the window."""

    pictures: list[tuple[int, int, int, int]]
    overlaps: list[str]
    out: list[str]
    width: int
    window: int

    def check(self) -> None:
        assert self.overlaps == []
        assert self.out == []
        assert self.width <= self.window


@cache
def page(name: str) -> str:
    return str(review.emit(derive(read(find_robot(name))))["review.html"])


def written(name: str, folder: Path) -> Path:
    path = folder / "review.html"
    path.write_text(page(name), encoding="utf-8")
    return path


def measured(path: Path, width: int) -> Measures:
    copy = path.with_name("measured.html")
    copy.write_text(path.read_text(encoding="utf-8").replace("</body>", f"{_MEASURE}</body>"), encoding="utf-8")
    told = document(copy, path.parent, width, 1000).split('<pre id="told">')[1].split("</pre>")[0]
    return Measures(**json.loads(unescape(told)))


@pytest.mark.parametrize(
    "name",
    [path.stem if path.stem in ALWAYS else pytest.param(path.stem, marks=pytest.mark.long) for path in robots()],
)
def test_the_page_is_quiet_complete_and_tidy(name: str, tmp_path: Path) -> None:
    path = written(name, tmp_path)
    told = measured(path, 1440)
    told.check()
    seen = visit(path, tmp_path, 1440, max(bottom for *_, bottom in told.pictures) + 50)
    assert seen.console == ()
    assert seen.requests == ()
    assert len(told.pictures) >= 3
    for box in told.pictures:
        region = seen.region(*box)
        assert np.var(region.astype(float)) > 20
        assert len(np.unique(region, axis=0)) > 12


@pytest.mark.parametrize("name", ["kr500", "kr500_table5", "tree_two_arms"])
def test_the_page_is_tidy_on_a_narrow_screen(name: str, tmp_path: Path) -> None:
    measured(written(name, tmp_path), 500).check()


def test_the_watch_would_see_a_failing_page(tmp_path: Path) -> None:
    """The checks above can fail: an error, a request and an empty picture are noticed."""
    path = tmp_path / "bad.html"
    path.write_text(
        "<!DOCTYPE html><html><body><svg width='200' height='100'></svg>"
        "<script>missing();</script><img src='http://outside.invalid/x.png'></body></html>"
    )
    seen = visit(path, tmp_path, 400, 300)
    assert any("missing is not defined" in line for line in seen.console)
    assert seen.requests == ("http://outside.invalid/x.png",)
    assert np.var(seen.region(10, 10, 200, 100).astype(float)) == 0
