"""What the tests of pages share: headless Chromium without a network, and the pixels of a PNG."""
import json
import re
import shutil
import struct
import subprocess
import sys
import zlib
from urllib.parse import unquote

from module_test_tools import check


def browser():
    for name in ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return shutil.which(name)
    print("no Chromium is installed")
    sys.exit(77)


def visit(page, folder, *more, size=(1000, 700), webgl=True, quiet=True):
    """Runs the browser on a page; gives what it printed. Any message in the page's console fails where it is to be
    quiet."""
    command = [
        browser(), "--headless", "--no-sandbox",
        *(("--use-angle=swiftshader", "--enable-unsafe-swiftshader") if webgl else
          ("--disable-gpu", "--disable-3d-apis")),
        "--user-data-dir=%s" % (folder / "profile"),
        "--window-size=%d,%d" % size, "--virtual-time-budget=20000", "--host-resolver-rules=MAP * ~NOTFOUND",
        "--enable-logging=stderr", "--v=0", *more,
        page.as_uri()
    ]
    result = subprocess.run(command, capture_output=True, text=True, timeout=240)
    check(result.returncode == 0, "the browser ended with %d: %s" % (result.returncode, result.stderr))
    console = [line for line in result.stderr.splitlines() if "CONSOLE" in line and
               not re.search("GPU stall due to ReadPixels|swiftshader", line)]
    check(not console or not quiet, "the console says: %s" % console)
    return result.stdout


def pixels(path):
    """Rows of (red, green, blue) of an 8-bit PNG without interlace."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = {2: 3, 6: 4}[color]
    check(depth == 8, "depth %d" % depth)
    raw, stride = zlib.decompress(packed), width * channels
    before, rows = bytearray(stride), []
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            a = row[x - channels] if x >= channels else 0
            b = before[x]
            c = before[x - channels] if x >= channels else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[x] = (row[x] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        before = row
        rows.append([tuple(row[x:x + 3]) for x in range(0, stride, channels)])
    return rows


def model_of(text):
    """The description in a page, as a strict JSON reader finds it."""
    def refuse(word):
        raise ValueError("%s is no JSON" % word)
    return json.loads(re.search(r'<script type="application/json" id="model">(.*?)</script>', text, re.S).group(1),
                      parse_constant=refuse)


def state_of(dom):
    """The data attributes of a page's body."""
    return dict(re.findall(r'data-([a-z-]+)="([^"]*)"', re.search(r"<body[^>]*>", dom).group(0)))


def probed(page, folder, probe, **how):
    """What a script at the end of a copy of the page has found: JSON in the body's data, by `found`."""
    copy = folder / "probe.html"
    copy.write_text(page.read_text().replace("</body>", probe + "</body>"))
    state = state_of(visit(copy, folder, "--dump-dom", **how))
    check(state.get("state") == "ready" and "found" in state, "the page did not come up: %s" % state)
    found = json.loads(unquote(state["found"]))
    check("error" not in found, "the probe failed: %s" % found)
    return found
