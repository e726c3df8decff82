"""Opens the page of `voxelcore core --html` in headless Chromium, without a network.
usage: page_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from module_test_tools import check, run, two_blocks, write_nrrd
from page_tools import model_of, pixels, probed, visit

# What a user does, done by a script at the end of a copy of the page; what came of it stands in the body's data.
PROBE = """<script>
(async function () {
  const $ = id => document.getElementById(id), wait = ms => new Promise(done => setTimeout(done, ms));
  const found = {}, fire = (element, name) => element.dispatchEvent(new Event(name, { bubbles: true }));
  const names = () => [...document.querySelectorAll('#labels li')].filter(row => !row.hidden)
    .map(row => row.querySelector('.name').textContent);
  const point = (name, x, y) => $('view').dispatchEvent(
    new PointerEvent(name, { clientX: x, clientY: y, pointerType: 'mouse', pointerId: 1 }));
  await wait(300);
  found.folded = document.body.classList.contains('folded');
  found.view = $('view').getBoundingClientRect().width / innerWidth;
  $('fold').click();
  await wait(100);
  found.foldedAfter = document.body.classList.contains('folded');
  found.expanded = $('fold').getAttribute('aria-expanded');
  found.viewAfter = $('view').getBoundingClientRect().width / innerWidth;
  found.panelAfter = $('panel').getBoundingClientRect().height;
  if (found.foldedAfter) $('fold').click();
  await wait(100);

  found.seen = [];
  const box = $('view').getBoundingClientRect();
  for (let y = 0.2; y < 0.85; y += 0.08) {
    for (let x = 0.2; x < 0.85; x += 0.08) {
      point('pointermove', box.left + x * box.width, box.top + y * box.height);
      await wait(50);
      if (!$('under').hidden) found.seen.push($('under').textContent);
    }
  }

  found.colorings = [...$('coloring').options].map(o => o.value);
  found.labels = names();
  $('search').value = 'RIGHT';
  fire($('search'), 'input');
  found.searched = names();
  found.count = $('count').textContent;
  $('none').click();
  $('search').value = '';
  fire($('search'), 'input');
  found.boxes = [...document.querySelectorAll('#labels input')].map(input => input.checked);
  found.countAfter = $('count').textContent;
  $('all').click();
  document.querySelectorAll('#labels .name')[0].click();
  found.chosen = document.querySelectorAll('#labels [aria-pressed="true"]').length;
  document.querySelectorAll('#labels .name')[0].click();

  // The picture is read where it becomes a file: decoding the file again takes time that a headless browser does not
  // give.
  let saved = null, name = '', data = null, width = 0;
  const make = URL.createObjectURL, toBlob = HTMLCanvasElement.prototype.toBlob;
  URL.createObjectURL = blob => { saved = blob; return make(blob); };
  HTMLAnchorElement.prototype.click = function () { name = this.download; };
  HTMLCanvasElement.prototype.toBlob = function (...rest) {
    data = this.getContext('2d').getImageData(0, 0, this.width, this.height).data;
    width = this.width;
    toBlob.apply(this, rest);
  };
  $('save').click();
  for (let i = 0; i < 100 && !saved; ++i) await wait(50);
  found.saved = { name, type: saved.type, bytes: saved.size, width: width / $('view').clientWidth,
                  colored: 0, white: 0 };
  for (let i = 0; i < data.length; i += 4) {
    const low = Math.min(data[i], data[i + 1], data[i + 2]), high = Math.max(data[i], data[i + 1], data[i + 2]);
    if (high - low > 40) ++found.saved.colored;
    if (low > 250) ++found.saved.white;
  }

  found.unnamed = [...document.querySelectorAll('button, input, select')].filter(element =>
    !element.textContent.trim() && !element.getAttribute('aria-label') &&
    !(element.labels && element.labels.length)).map(element => element.id);
  $('ground').click();
  found.dark = getComputedStyle(document.body).backgroundColor;
  $('coloring').value = 'Label';
  fire($('coloring'), 'change');
  found.range = $('range').hidden;
  document.body.dataset.found = encodeURIComponent(JSON.stringify(found));
})().catch(error => {
  document.body.dataset.found = encodeURIComponent(JSON.stringify({ error: String(error.stack) }));
});
</script>"""


# Solid surfaces from the front, nothing in them: how many pixels of one picture are the scale bar's, how many the
# body's.
MEASURE = """<script>
setTimeout(function () {
  const slider = document.getElementById('surface-opacity');
  document.getElementById('medial').click();
  slider.value = 100;
  slider.dispatchEvent(new Event('input'));
  document.getElementById('front').click();
  const sheet = Page.view.picture(), words = document.getElementById('stage').dataset.scale;
  const data = sheet.getContext('2d').getImageData(0, 0, sheet.width, sheet.height).data;
  const longest = (from, to, until, counts) => {
    let most = 0;
    for (let y = Math.round(from * sheet.height); y < to * sheet.height; ++y) {
      let count = 0;
      for (let x = 0; x < until * sheet.width; ++x) {
        const at = 4 * (y * sheet.width + x);
        if (counts(data[at], data[at + 1], data[at + 2])) ++count;
      }
      most = Math.max(most, count);
    }
    return most;
  };
  document.body.dataset.found = encodeURIComponent(JSON.stringify({ words,
    bar: longest(0.95, 1, 0.5, (r, g, b) => Math.max(r, g, b) < 90),
    body: longest(0.45, 0.55, 0.85, (r, g, b) => Math.min(r, g, b) < 235) }));
}, 200);
</script>"""


def check_scale_bar(program, folder, spacing):
    """The bar is as long as it says, by the width of a body of 30 voxels in the same picture."""
    size, voxels = 40, bytearray(40 ** 3)
    for k in range(10, 25):
        for j in range(12, 28):
            at = (k * size + j) * size
            voxels[at + 5:at + 35] = b"\1" * 30
    header = "NRRD0004\ntype: uint8\ndimension: 3\nspacings: %s\nsizes: 40 40 40\nencoding: raw\n\n" % " ".join(
        3 * [spacing])
    (folder / "bar.nrrd").write_bytes(header.encode() + bytes(voxels))
    page = folder / "bar.html"
    run(program, "core", folder / "bar.nrrd", "-o", folder / "bar.vtp", "--html", page, "--force")
    check(model_of(page.read_text())["anatomical"] is False, "directions of a patient, though the file names no space")
    found = probed(page, folder, MEASURE)
    words = re.fullmatch(r"([0-9.]+) (nm|µm|mm)", found["words"])
    check(words is not None, "the scale bar says '%s'" % found["words"])
    said = float(words.group(1)) * {"nm": 1e-6, "µm": 1e-3, "mm": 1}[words.group(2)]
    bar, body = found["bar"], found["body"]
    check(bar > 100 and body > 500, "a bar of %d pixels, a body of %d" % (bar, body))
    true = 30 * float(spacing) * bar / body
    check(abs(said / true - 1) < 0.03, "the bar says %g mm and is %g mm long" % (said, true))
    return words.group(2)


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
        middle = [p for row in rows[100:600] for p in row[300:860]]
        colored = sum(max(p) - min(p) > 40 for p in middle)
        white = sum(min(p) > 250 for p in middle)
        check(colored > 3000, "only %d pixels are coloured: nothing is drawn" % colored)
        check(white > 30000, "only %d pixels are white" % white)
        last = bytes.fromhex(model_of(text)["map"][-1][1:])
        check(
            sum(max(abs(a - b) for a, b in zip(p, last)) < 40 for p in middle) > 10,
            "thick parts do not have the map's last colour")

        found = probed(page, folder, PROBE)
        check(found["folded"] is False and found["view"] < 0.8, "the panel is folded where there is room")
        check(found["foldedAfter"] is True and found["viewAfter"] > 0.99 and found["panelAfter"] == 0,
              "the panel does not fold")
        check(found["colorings"] == ["Radius", "Lambda", "ErosionThickness", "Label"],
              "colourings %s" % found["colorings"])
        check(found["labels"] == ["</script><b>left", "right & back"], "labels %s" % found["labels"])
        check(found["searched"] == ["right & back"] and found["count"] == "1 of 2 found",
              "the search finds %s" % found["searched"])
        check(found["boxes"] == [True, False] and found["countAfter"] == "1 of 2 shown", "hidden: %s" % found["boxes"])
        check(found["chosen"] == 1, "no label is chosen")
        check(found["saved"]["name"] == "blocks.png" and found["saved"]["type"] == "image/png",
              "saved %s" % found["saved"])
        check(
            found["saved"]["width"] >= 2 and found["saved"]["bytes"] > 20000 and found["saved"]["colored"] > 12000
            and found["saved"]["white"] > 100000, "the saved picture is empty: %s" % found["saved"])
        check(found["unnamed"] == [], "controls without a name: %s" % found["unnamed"])
        check(found["dark"] == "rgb(20, 23, 26)" and found["range"] is True, "ground %s" % found["dark"])
        seen = " | ".join(found["seen"])
        check(
            re.search(r"\(3\)Radius [0-9.]+ mm", seen) and re.search(r"\(8\)Radius [0-9.]+ mm", seen) and "LPS" in seen,
            "under the pointer: %s" % seen[:300])

        phone = probed(page, folder, PROBE, size=(390, 844))
        check(phone["folded"] is True and phone["view"] > 0.99, "the panel covers a phone: %s" % phone["view"])
        check(phone["expanded"] == "true" and phone["panelAfter"] > 200, "the panel does not open on a phone")

        check(check_scale_bar(program, folder, "2") == "mm", "2 mm voxels are not shown in mm")
        check(check_scale_bar(program, folder, "1e-5") == "nm", "10 nm voxels are not shown in nm")

        # A budget is kept, and said; the result itself is not touched.
        small = folder / "small.html"
        run(program, "phantom", "gyroid", "--size", "48", "-o", folder / "g.nrrd")
        run(program, "core", folder / "g.nrrd", "-o", folder / "g.vtp", "--lambda", "0", "--html", small,
            "--html-triangles", "20000")
        plain = folder / "plain.vtp"
        run(program, "core", folder / "g.nrrd", "-o", plain, "--lambda", "0")
        check(plain.read_bytes() == (folder / "g.vtp").read_bytes(), "decimation reached the result")
        shown, whole = (int(re.search(r'"%s":(\d+)' % key, small.read_text()).group(1))
                        for key in ("triangles", "allTriangles"))
        check(whole > 60000 and 5000 < shown <= 22000, "%d of %d triangles for a budget of 20000" % (shown, whole))
        dom = visit(small, folder, "--dump-dom")
        check('data-state="ready"' in dom and "of %s; the files hold all of them" % format(whole, ",") in dom,
              "the page does not say so")


main()
