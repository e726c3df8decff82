"""Edits made on the page of `voxelcore skeleton --html` in headless Chromium: branches are clicked, or chosen by keys;
the table that is downloaded is given to --edits, and the tree is what was asked for.
usage: page_edits_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import csv
import json
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from module_test_tools import check, run
from page_tools import probed, visit

# Helpers of all probes; what a probe does comes at @DO@.
PROBE = """<script>
(async function () {
  const $ = id => document.getElementById(id), wait = ms => new Promise(done => setTimeout(done, ms));
  const view = $('view'), label = number => Page.model.labels[number];
  const nearest = (number, place) => { // the branch, and the point on it
    const { near, lines, offsets } = label(number).tree, middle = Page.meshes.middle;
    let found = null, least = Infinity;
    for (let branch = 0; branch + 1 < offsets.length; ++branch) {
      for (let i = offsets[branch]; i < offsets[branch + 1]; ++i) {
        const away = Math.hypot(...place.map((v, k) => near[3 * lines[i] + k] + middle[k] - v));
        if (away < least) { least = away; found = { branch, at: i - offsets[branch], point: lines[i] }; }
      }
    }
    return found;
  };
  const click = async (place, number = 0, pointerType = 'mouse') => {
    const { point } = nearest(number, place), box = view.getBoundingClientRect();
    const [right, down] = Page.view.pixelsOf(label(number).tree.near, 3 * point);
    const at = { clientX: box.left + box.width / 2 + right, clientY: box.top + box.height / 2 + down, pointerType,
                 pointerId: 1, button: 0, bubbles: true };
    view.dispatchEvent(new PointerEvent('pointerdown', at));
    view.dispatchEvent(new PointerEvent('pointerup', at));
    await wait(50);
  };
  const press = value => document.querySelector('#edit-choices [value=' + value + ']').click();
  const offered = () => [...$('edit-choices').children].filter(b => !b.hidden).map(b => b.value).join(' ');
  const set = (id, value) => { $(id).value = value; $(id).dispatchEvent(new Event('input', { bubbles: true })); };
  // The file's text by its size: reading it again takes time that a headless browser does not give.
  const saved = () => {
    let blob = null, name = '';
    const make = URL.createObjectURL;
    URL.createObjectURL = one => { blob = one; return make(one); };
    HTMLAnchorElement.prototype.click = function () { name = this.download; };
    $('edit-save').click();
    const table = Page.edits.table();
    if (blob.size !== new TextEncoder().encode(table).length) throw new Error('the file is not the table');
    return [name, table];
  };
  const list = () => [...document.querySelectorAll('#edit-list li')].map(row => row.firstChild.textContent);
  const found = {};
  await wait(300);
  @DO@
  document.body.dataset.found = encodeURIComponent(JSON.stringify(found));
})().catch(error => {
  document.body.dataset.found = encodeURIComponent(JSON.stringify({ error: String(error.stack) }));
});
</script>"""


def write_scan(path, inside, size=(90, 60, 24)):
    """Voxels of 0.5 mm; inside(x, y, z) is a label."""
    voxels = bytes(inside(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0]))
    head = "NRRD0004\ntype: uint8\ndimension: 3\nspacings: 0.5 0.5 0.5\nsizes: %d %d %d\nencoding: raw\n\n" % size
    path.write_bytes(head.encode() + voxels)


def tube(a, b, radius):
    return (a * a + b * b) ** 0.5 < radius


def tree(x, y, z):
    """A trunk along x; a branch along y; another, of which the end is torn off."""
    return (tube(y - 12, z - 12, 4.5) and 4 <= x < 86 or tube(x - 30, z - 12, 3.5) and 12 <= y < 44 or
            tube(x - 60, z - 12, 3.5) and (12 <= y < 30 or 36 <= y < 52))


def rings(x, y, z):
    """A ring of label 1, and a bar of label 2 with a bump one voxel thick."""
    ring = tube(tube_distance(x, y), z - 12, 3.5)
    return 1 if ring else 2 if 70 <= x < 80 and 8 <= y < 50 and 9 <= z < 15 else 0


def tube_distance(x, y):
    return ((x - 30) ** 2 + (y - 30) ** 2) ** 0.5 - 18


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


DO_TREE = """
  found.closed = $('edits').hidden && !$('correct').hidden;
  await click([15, 16, 6]);
  found.opened = !$('edits').hidden;
  found.row = $('edit-row').textContent;
  found.offered = offered();
  press('remove');
  await click([30, 13, 6]);
  found.inner = offered();
  press('join');
  found.asks = [$('edit-asks').textContent, offered()];
  await click([30, 20, 6]);
  set('edit-branch', nearest(0, [40, 6, 6]).branch); // by keys
  set('edit-place', nearest(0, [37.5, 6, 6]).at);
  press('cut');
  set('edit-name', '=1, "A"');
  $('edit-naming').requestSubmit();
  await click([4, 6, 6]);
  press('root');
  press('path'); // and back
  set('edit-branch', nearest(0, [15, 16, 6]).branch);
  $('edit-step').click();
  $('edit-finish').click();
  found.before = list();
  [...document.querySelectorAll('#edit-list button')].pop().click();
  press('path');
  document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape' }));
  found.canceled = $('edit-asks').hidden && !$('edits').hidden;
  found.list = list();
  found.unnamed = [...document.querySelectorAll('button, input, select')].filter(element =>
    !element.textContent.trim() && !element.getAttribute('aria-label') && !(element.labels && element.labels.length))
    .map(element => element.id);
  const card = $('edits').getBoundingClientRect();
  found.card = [card.left, card.right - innerWidth, card.bottom - innerHeight];
  found.wide = document.documentElement.scrollWidth - innerWidth;
  [found.name, found.table] = saved();
"""


def check_tree(program, folder, shots):
    write_scan(folder / "tree.nrrd", lambda x, y, z: int(tree(x, y, z)))
    page = folder / "page.html"
    run(program, "skeleton", folder / "tree.nrrd", "-o", folder / "t.vtp", "--html", page, "--also", "csv")
    for size, pointer in (((1280, 800), "mouse"), ((390, 844), "touch")):
        do = DO_TREE.replace("6]);\n", "6], 0, '%s');\n" % pointer)
        found = probed(page, folder, PROBE.replace("@DO@", do), size=size)
        check(found["closed"] and found["opened"], "corrections are not closed at first, or do not open: %s" % found)
        number, length = re.match(r"Branch (\d+): length ([0-9.]+) mm, radius here [0-9.]+ mm", found["row"]).groups()
        lengths = {row["branch_id"]: float(row["branch_distance"]) for row in rows(folder / "t_branches.csv")}
        check(abs(float(length) / lengths[number] - 1) < 0.01, "%s, in the table %s" % (found["row"], lengths[number]))
        check(found["offered"] == "cut remove root join path", "offered %s" % found["offered"])
        check("tip" in found["asks"][0] and found["asks"][1] == "", "asked %s" % found["asks"])
        check(len(found["before"]) == 6 and found["list"] == found["before"][:5] and found["canceled"],
              "edits %s, then %s" % (found["before"], found["list"]))
        check(found["unnamed"] == [], "controls without a name: %s" % found["unnamed"])
        check(found["card"][0] >= 0 and max(found["card"][1:]) <= 0 and found["wide"] <= 0,
              "the card leaves the window: %s" % found)
        check(found["name"] == "tree_edits.csv", found["name"])
        (folder / found["name"]).write_text(found["table"], encoding="utf-8", newline="")
        done = run(program, "skeleton", folder / "tree.nrrd", "-o", folder / "e.vtp", "--force", "--also", "csv",
                   "--edits", folder / found["name"], "--report", folder / "e.json")
        check("is left out" not in done.stderr and "5 of 5 edits done" in done.stderr + done.stdout, done.stderr)
        label = json.loads((folder / "e.json").read_text())["labels"][0]
        # The end joined, the trunk cut.
        check(label["certificate"]["passed"] and label["shape"]["betti"] == [2, 0, 0], label["shape"])
        edited = rows(folder / "e_branches.csv")
        check(not any(abs(float(row["coord_dst_x"]) - 15) < 2 and float(row["coord_dst_y"]) > 10 for row in edited),
              "the branch is still there")
        names = [row["branch_name"] for row in edited]
        check("'=1, \"A\"" in names, "no branch has the name: %s" % names)
        if shots:
            visit(folder / "probe.html", folder, "--screenshot=%s" % (shots / ("edits-%d.png" % size[0])), size=size)


DO_RINGS = """
  await click([15, 24, 6]);
  found.ring = offered();
  press('loop');
  set('edit-name', 'ring');
  $('edit-naming').requestSubmit();
  $('edit-label').value = 1;
  $('edit-label').dispatchEvent(new Event('change'));
  found.bar = [offered(), $('edit-row').textContent];
  press('cut');
  [found.name, found.table] = saved();
"""


def check_labels(program, folder):
    """Of several labels a row has its label."""
    write_scan(folder / "rings.nrrd", rings)
    page = folder / "rings.html"
    run(program, "skeleton", folder / "rings.nrrd", "-o", folder / "r.vtp", "--html", page)
    found = probed(page, folder, PROBE.replace("@DO@", DO_RINGS))
    check("loop" in found["ring"].split() and "root" not in found["ring"].split(), "offered %s" % found["ring"])
    check("loop" not in found["bar"][0].split() and "label-2" in found["bar"][1], "offered %s" % found["bar"])
    lines = found["table"].splitlines()
    check(lines[0] == "label,branch,junction,x,y,z,edit,name" and [line[0] for line in lines[1:]] == ["1", "1", "2"],
          found["table"])


def main():
    program = sys.argv[1]
    shots = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if shots:
        os.makedirs(shots, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        check_tree(program, Path(name), shots)
        check_labels(program, Path(name))


main()
