"""A headless browser as the tests use it: screenshots, console messages, and what the page asked the network for."""

from __future__ import annotations

import json
import struct
import subprocess
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tests.extra.tools import tool

#: Screenshots are taken at this scale: enough to see that something is drawn, and four times quicker to decode.
_SCALE = 0.5
COMMANDS = ("chromium", "chromium-browser", "google-chrome")
#: The browser's own services are kept quiet and offline: no name resolves.
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--hide-scrollbars",
    f"--force-device-scale-factor={_SCALE}",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--enable-logging=stderr",
)


@dataclass(frozen=True)
class Visit:
    """What one visit to a page left: pixels (height, width, 3), console messages, addresses that it asked for."""

    pixels: NDArray[np.uint8]
    console: tuple[str, ...]
    requests: tuple[str, ...]

    def region(self, left: float, top: float, right: float, bottom: float) -> NDArray[np.uint8]:
        """Pixels (k, 3) of a box given in the page's own pixels."""
        rows, columns = slice(int(top * _SCALE), int(bottom * _SCALE)), slice(int(left * _SCALE), int(right * _SCALE))
        return self.pixels[rows, columns].reshape(-1, 3)


def visit(page: Path, folder: Path, width: int, height: int) -> Visit:
    """Opens a file in a window of the given size [px]; ``folder`` takes the browser's profile and logs."""
    picture, log = folder / "picture.png", folder / "net.json"
    told = _run(page, folder, width, height, f"--screenshot={picture}", f"--log-net-log={log}").stderr
    console = tuple(line for line in told.splitlines() if ":CONSOLE" in line)
    return Visit(decoded(picture.read_bytes()), console, _requests(log))


def document(page: Path, folder: Path, width: int, height: int) -> str:
    """The document as the browser has it after its scripts have run."""
    return _run(page, folder, width, height, "--dump-dom").stdout


def _run(page: Path, folder: Path, width: int, height: int, *flags: str) -> subprocess.CompletedProcess[str]:
    command = [
        tool(*COMMANDS),
        *_FLAGS,
        f"--user-data-dir={folder / 'profile'}",
        f"--window-size={width},{height}",
        *flags,
    ]
    return subprocess.run([*command, page.as_uri()], capture_output=True, text=True, check=True, timeout=120)


def _requests(log: Path) -> tuple[str, ...]:
    """Addresses other than files that the page asked for; the browser's own services have no origin: not counted."""
    record = json.loads(log.read_text())
    start = record["constants"]["logEventTypes"]["URL_REQUEST_START_JOB"]
    asked = (
        event["params"] for event in record["events"] if event["type"] == start and "url" in event.get("params", {})
    )
    return tuple(
        p["url"] for p in asked if not p["url"].startswith(("file:", "data:")) and p.get("initiator") != "not an origin"
    )


def decoded(png: bytes) -> NDArray[np.uint8]:
    """Pixels (height, width, 3) of a PNG with eight bits a channel, not interlaced."""
    at, packed, header = 8, b"", b""
    while at < len(png):
        (size,), kind = struct.unpack(">I", png[at : at + 4]), png[at + 4 : at + 8]
        body = png[at + 8 : at + 8 + size]
        header = body if kind == b"IHDR" else header
        packed += body if kind == b"IDAT" else b""
        at += size + 12
    width, height, depth, colour = struct.unpack(">IIBB", header[:10])
    assert depth == 8
    channels = {2: 3, 6: 4}[colour]
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels)
    pixels = np.zeros((height, width * channels), np.uint8)
    above = np.zeros(width * channels, np.uint8)
    for row, line in enumerate(lines):
        above = pixels[row] = _unfiltered(int(line[0]), line[1:], above, channels)
    return pixels.reshape(height, width, channels)[:, :, :3]


def _unfiltered(kind: int, line: NDArray[np.uint8], above: NDArray[np.uint8], channels: int) -> NDArray[np.uint8]:
    """One row with its filter undone (PNG specification, section 9)."""
    if kind == 0:
        return line
    if kind == 1:
        return np.cumsum(line.reshape(-1, channels), axis=0, dtype=np.uint8).ravel()
    if kind == 2:
        return line + above
    row = bytearray(line.tobytes())
    up = above.tobytes()
    for k in range(len(row)):
        left = row[k - channels] if k >= channels else 0
        if kind == 3:
            row[k] = (row[k] + (left + up[k]) // 2) & 255
        else:
            corner = up[k - channels] if k >= channels else 0
            row[k] = (row[k] + _paeth(left, up[k], corner)) & 255
    return np.frombuffer(bytes(row), np.uint8)


def _paeth(left: int, up: int, corner: int) -> int:
    guess = left + up - corner
    return min((left, up, corner), key=lambda near: abs(guess - near))
