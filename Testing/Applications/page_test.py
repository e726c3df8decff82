"""Opens the page of `voxelcore core --html` in headless Chromium, without a network.
usage: page_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from module_test_tools import check, run, two_blocks, write_nrrd
from page_tools import pixels, state_of, visit

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
        found = state_of(dom)
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
