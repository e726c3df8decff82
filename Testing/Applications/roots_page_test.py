"""Opens the pages of `voxelcore roots` in headless Chromium, without a network, and compares what they show with the
tables. usage: roots_page_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import csv
import gzip
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from module_test_tools import check, run
from page_tools import model_of, pixels, probed, visit

PROBE = """<script>
(async function () {
  const $ = id => document.getElementById(id), wait = ms => new Promise(done => setTimeout(done, ms));
  await wait(200);
  const found = { title: document.title, coloring: $('coloring').value, seen: [] };
  found.colorings = [...$('coloring').options].map(o => o.text);
  found.levels = [...document.querySelectorAll('#labels .name')].map(e => e.textContent);
  found.numbers = [...document.querySelectorAll('#labels .number')].map(e => e.textContent).join('');
  found.views = ['front', 'left', 'top'].map(id => $(id).textContent);
  found.figures = document.querySelectorAll('#panel figure').length;
  found.bars = [...document.querySelectorAll('#panel figure')].map(f =>
    [...f.querySelectorAll('text:nth-of-type(2n)')].reduce((sum, e) => sum + Number(e.textContent), 0));
  const colors = () => Page.view.parts.filter(p => p.userData.kind === 'curves').map(p => {
    const c = p.geometry.attributes.color.array, all = new Set();
    for (let i = 0; i < c.length; i += 3) all.add(c.slice(i, i + 3).join());
    return all.size;
  });
  found.byLevel = colors();
  $('coloring').value = 'Branch';
  $('coloring').dispatchEvent(new Event('change'));
  found.byRoot = colors();
  found.range = $('range').hidden;
  const box = $('view').getBoundingClientRect();
  $('surface').click();
  for (let y = 0.2; y < 0.9; y += 0.1) {
    for (let x = 0.1; x < 0.9; x += 0.02) {
      $('view').dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + x * box.width,
        clientY: box.top + y * box.height, pointerType: 'mouse', pointerId: 1 }));
      await wait(40);
      if (!$('under').hidden) found.seen.push($('under').textContent);
    }
  }
  document.body.dataset.found = encodeURIComponent(JSON.stringify(found));
})().catch(error => {
  document.body.dataset.found = encodeURIComponent(JSON.stringify({ error: String(error.stack) }));
});
</script>"""


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def stem_is_upright(picture):
    """The stem, the thickest brown body of the picture, is wider at the top, and there is more of it there."""
    widths = [sum(120 > p[0] > p[2] + 12 and p[0] > p[1] > p[2] for p in row) for row in pixels(picture)]
    rows = [i for i, width in enumerate(widths) if width > 2]
    check(len(rows) > 100, "there is no stem in the picture")
    half = (rows[0] + rows[-1]) // 2
    return sum(widths[rows[0]:half]) > sum(widths[half:rows[-1] + 1])


def check_pages(program, scan, out, *words):
    run(program, "roots", scan, "-o", str(out) + "/", *words)
    roots, levels, profile = (table(out / name) for name in ("roots.csv", "levels.csv", "profile.csv"))
    counts = {int(row["level"]): int(row["count"]) for row in levels if row["level"].isdigit()}

    page = out / "roots.html"
    found = probed(page, out, PROBE)
    check(found["title"] == "Roots of " + scan.stem, "title %s" % found["title"])
    check(found["coloring"] == "Label" and found["range"] is True, "it opens by %s" % found["coloring"])
    check(found["colorings"] == ["Radius", "Level", "Branch"], "colourings %s" % found["colorings"])
    check(found["levels"] == ["stem"] + ["level %d" % i for i in range(1, len(counts))] + ["surface"],
          "levels %s" % found["levels"])
    check(found["numbers"] == "" and found["views"] == ["Front", "Side", "Top"], "%s" % found)
    check(found["byLevel"] == [1] * len(counts), "colours of levels: %s" % found["byLevel"])
    check(found["byRoot"] == [counts[i] for i in sorted(counts)],
          "colours of roots: %s of %s" % (found["byRoot"], counts))
    total = sum(float(row["length_at_depth"] or 0) for row in profile)
    check(found["figures"] == 2 and all(abs(bars / total - 1) < 0.01 for bars in found["bars"]),
          "the charts add up to %s, the table to %g" % (found["bars"], total))
    seen = [re.search(r"root (\d+)(?: of (\d+))?, ([0-9.]+) mm long", words) for words in found["seen"]]
    seen = [match for match in seen if match]
    check(len(seen) > 10, "under the pointer: %s" % found["seen"])
    for match in seen:
        row = roots[int(match.group(1))]
        check((match.group(2) or "") == row["parent"] and abs(float(match.group(3)) - float(row["length"])) < 0.06,
              "under the pointer: %s, in the table %s" % (match.group(0), row))
    names = [name for label in model_of(page.read_text())["labels"] if "curves" in label
             for name in label["curves"]["names"]]
    check(len(names) == len(roots), "%d roots in the page, %d in the table" % (len(names), len(roots)))

    # The summary: its table has the counts, its picture is there.
    dom = visit(out / "page.html", out, "--dump-dom")
    cells = re.findall(r"<tr><th>([^<]+)</th><td>(\d+)</td>", dom)
    shown = {int(name.split()[-1]) if name != "stem" else 0: int(count)
             for name, count in cells if name == "stem" or re.fullmatch(r"level \d+", name)}
    check(shown == counts, "the summary has %s, the table %s" % (shown, counts))
    check(stem_is_upright(out / "roots.png"), "the roots hang upside down")


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scan = folder / "plant.nrrd"
        run(program, "phantom", "root", "--size", "96", "--seed", "2", "--laterals", "8", "--contacts", "2",
            "--grey-values", "--noise-level", "0.05", "-o", scan)
        check_pages(program, scan, folder / "out")
        # The same data, the axes in another order: the stem lies along i.
        data = scan.read_bytes()
        at = data.index(b"\n\n") + 2
        side, width = 96, 2
        voxels = memoryview(gzip.decompress(data[at:]))
        check(len(voxels) == side ** 3 * width, "the scan has %d bytes" % len(voxels))
        turned = bytearray(len(voxels))
        for k in range(side):
            for j in range(side):
                row = voxels[(k * side + j) * side * width:(k * side + j + 1) * side * width]
                start = (j * side * side + k) * width  # (i, j, k) becomes (k, i, j)
                for byte in range(width):
                    turned[start + byte:start + byte + side * side * width:side * width] = row[byte::width]
        lying = folder / "lying.nrrd"
        lying.write_bytes(data[:at] + gzip.compress(turned, 1))
        check_pages(program, lying, folder / "lying")
        if len(sys.argv) > 2:
            os.makedirs(sys.argv[2], exist_ok=True)
            for page in ("page", "roots"):
                visit(folder / "lying" / (page + ".html"), folder, "--screenshot=%s" % (folder / (page + ".png")),
                      size=(1300, 1000))
                shutil.copy(folder / (page + ".png"), sys.argv[2])


main()
