"""Opens the page of `voxelcore core --html` in headless Chromium, without a network.
usage: page_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from module_test_tools import check, run, two_blocks, write_nrrd

# What a user does, done by a script at the end of a copy of the page; what came of it stands in the body's data.
PROBE = """<script>
setTimeout(function () {
  var seen = [], view = document.getElementById('view'), under = document.getElementById('under');
  function finish() {
    var c = document.getElementById('coloring');
    document.body.dataset.colorings = Array.from(c.options).map(o => o.value).join(',');
    c.value = 'Label';
    c.dispatchEvent(new Event('change'));
    document.body.dataset.scale = document.getElementById('scale').style.display;
    var rows = document.querySelectorAll('#labels .name');
    document.body.dataset.labels = Array.from(rows).map(r => r.textContent).join(',');
    rows[0].click();
    document.body.dataset.chosen = document.querySelectorAll('#labels .chosen').length;
    document.getElementById('none').click();
    document.body.dataset.seen = seen.join(' | ');
    document.body.dataset.done = '1';
  }
  var spots = [];
  for (var y = 0.3; y < 0.75; y += 0.05) for (var x = 0.35; x < 0.7; x += 0.05) spots.push([x, y]);
  (function next() {
    if (!spots.length) return finish();
    var s = spots.pop();
    view.dispatchEvent(new MouseEvent('mousemove', { clientX: s[0] * innerWidth, clientY: s[1] * innerHeight, buttons: 0 }));
    setTimeout(function () {
      if (under.textContent) seen.push(under.textContent);
      next();
    }, 60);
  })();
}, 300);
</script>"""


def browser():
    for name in ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return shutil.which(name)
    print("no Chromium is installed")
    sys.exit(77)


def visit(page, folder, *more):
    """Runs the browser on a page; gives what it printed. Any message in the page's console fails."""
    command = [browser(), "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
               "--user-data-dir=%s" % (folder / "profile"), "--window-size=1000,700", "--virtual-time-budget=20000",
               "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", "--v=0", *more, page.as_uri()]
    result = subprocess.run(command, capture_output=True, text=True, timeout=240)
    check(result.returncode == 0, "the browser ended with %d: %s" % (result.returncode, result.stderr))
    console = [line for line in result.stderr.splitlines() if "CONSOLE" in line and
               not re.search("GPU stall due to ReadPixels|swiftshader", line)]
    check(not console, "the console says: %s" % console)
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


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_nrrd(folder / "blocks.nrrd", two_blocks())
        (folder / "blocks.txt").write_text("3 </script><b>left\n8 right & back\n")
        page = folder / "page.html"
        run(program, "core", folder / "blocks.nrrd", "-o", folder / "c.vtp", "--with-skeleton", "--html", page)
        text = page.read_text()
        check("default-src 'none'" in text, "the page may use the network")
        check(not re.search(r"""(?:src|href)\s*=\s*["']?\s*(?:https?:)?//""", text), "the page refers to the network")

        picture = folder / "page.png"
        visit(page, folder, "--screenshot=%s" % picture)
        if len(sys.argv) > 2:
            os.makedirs(sys.argv[2], exist_ok=True)
            shutil.copy(picture, sys.argv[2])
        rows = pixels(picture)
        middle = [p for row in rows[100:600] for p in row[260:860]]
        colored = sum(max(p) - min(p) > 40 for p in middle)
        white = sum(min(p) > 250 for p in middle)
        check(colored > 3000, "only %d pixels are coloured: nothing is drawn" % colored)
        check(white > 30000, "only %d pixels are white" % white)
        check(sum(p[1] > 180 and p[2] < 120 for p in middle) > 10, "no yellow: thick parts are not shown as such")

        copy = folder / "probe.html"
        copy.write_text(text.replace("</body>", PROBE + "</body>"))
        dom = visit(copy, folder, "--dump-dom")
        found = dict(re.findall(r'data-([a-z]+)="([^"]*)"', dom[dom.rindex("<body"):dom.rindex("<body") + 20000]))
        check(found.get("state") == "ready" and found.get("done") == "1", "the page did not come up: %s" % found)
        check(found["colorings"] == "Radius,Lambda,ErosionThickness,Label", "colourings %s" % found["colorings"])
        check(found["scale"] == "none", "the colour bar stays with labels")
        check("&lt;b&gt;left" in found["labels"] or "<b>left" in found["labels"], "labels %s" % found["labels"])
        check(found["chosen"] == "1", "no label is chosen")
        check(re.search(r"\(3\)Radius: [0-9.]+ mm", found["seen"]) and re.search(r"\(8\)Radius: [0-9.]+ mm", found["seen"]) and
              "LPS" in found["seen"], "under the pointer: %s" % found["seen"][:300])

        # A budget is kept, and said; the result itself is not touched.
        small = folder / "small.html"
        run(program, "phantom", "gyroid", "--size", "48", "-o", folder / "g.nrrd")
        run(program, "core", folder / "g.nrrd", "-o", folder / "g.vtp", "--lambda", "0", "--html", small,
            "--html-triangles", "20000")
        plain = folder / "plain.vtp"
        run(program, "core", folder / "g.nrrd", "-o", plain, "--lambda", "0")
        check(plain.read_bytes() == (folder / "g.vtp").read_bytes(), "decimation reached the result")
        shown, whole = (int(re.search(r'"%s":(\d+)' % key, small.read_text()).group(1)) for key in ("triangles", "allTriangles"))
        check(whole > 60000 and 5000 < shown <= 22000, "%d of %d triangles for a budget of 20000" % (shown, whole))
        dom = visit(small, folder, "--dump-dom")
        check('data-state="ready"' in dom and "of %d; files hold all of them" % whole in dom, "the page does not say so")


main()
