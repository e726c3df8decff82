"""The slider over grey levels in the summary of `voxelcore roots`, in headless Chromium: at each level it shows the
cuts and fills that are still needed. What is needed is counted here from the voxels of changes.txt and the scan's own
values. usage: roots_slider_test.py VOXELCORE [FOLDER FOR SCREENSHOTS]    exit 77: no Chromium"""
import json
import re
import sys
import tempfile
from array import array
from pathlib import Path
from urllib.parse import unquote
import zlib

from module_test_tools import check, run
from page_tools import state_of, visit

PROBE = """<script>
(function () {
  const slider = document.getElementById('level'), found = { min: Number(slider.min), max: Number(slider.max), at: [] };
  const marks = kind => [...document.querySelectorAll('svg circle[data-kind=' + kind + ']')];
  const rows = kind => [...document.querySelectorAll('tr[data-kind=' + kind + ']')];
  const bright = all => all.filter(e => Number(e.style.opacity) === 1).length;
  found.start = Number(slider.value);
  found.marks = [marks('cut').length, marks('fill').length];
  found.colors = [marks('cut')[0], marks('fill')[0]].map(e => getComputedStyle(e).fill);
  for (const level of [found.start, ...LEVELS]) {
    slider.value = level;
    slider.dispatchEvent(new Event('input'));
    found.at.push({ level: Number(slider.value), words: document.getElementById('level-words').textContent,
      marks: [bright(marks('cut')), bright(marks('fill'))], rows: [bright(rows('cut')), bright(rows('fill'))] });
  }
  document.body.dataset.found = encodeURIComponent(JSON.stringify(found));
})();
</script>"""


def values_of(path):
    """The values of a .nrrd of VoxelCore's own, unsigned of 16 bits, and its sides."""
    header, data = path.read_bytes().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in header.decode().splitlines() if ": " in line)
    check(fields["type"] == "uint16" and fields["endian"] == "little", fields)
    values = array("H")
    values.frombytes(zlib.decompress(data, 31) if fields["encoding"] == "gzip" else data)
    return values, [int(n) for n in fields["sizes"].split()]


def changes_of(path, values, size):
    """Per cut and fill the value that decides it: the brightest of a cut, the darkest of a fill."""
    found, kind = {"cut": [], "fill": []}, None
    for line in path.read_text().splitlines():
        title = re.match(r"# (cut|fill) at", line)
        if title:
            kind = title.group(1)
            found[kind].append([])
        for sign, i, j, k, count in re.findall(r"([+-])(\d+),(\d+),(\d+)(?:x(\d+))?", line if line[:1] in "+-" else ""):
            check((sign == "-") == (kind == "cut"), line)
            first = (int(k) * size[1] + int(j)) * size[0] + int(i)
            found[kind][-1] += values[first:first + int(count or 1)]
    return [max(v) for v in found["cut"]], [min(v) for v in found["fill"]]


def main():
    program = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shots = Path(sys.argv[2]) if len(sys.argv) > 2 else folder
        shots.mkdir(parents=True, exist_ok=True)
        scan = folder / "scan.nrrd"
        run(program, "phantom", "root", "--size", "112", "--seed", "5", "--radius", "6", "--laterals", "8",
             "--sub-laterals", "1", "--contacts", "5", "--grey-values", "--hollow", "0.65", "--holes", "6",
             "--noise-level", "0.12", "--rings", "0.03", "-o", scan, "-q")
        run(program, "roots", scan, "--threshold", "23500:inf", "--fill-hollows", "2.5vox", "-o", folder / "out",
             "--no-pictures", "-q")
        cuts, fills = changes_of(folder / "out" / "changes.txt", *values_of(scan))
        check(cuts and fills, "%d cuts and %d fills" % (len(cuts), len(fills)))
        report = json.loads((folder / "out" / "report.json").read_text())["roots"]["topology"]
        tried = [(one["level"], one["betti"]) for one in report["levels"]["tried"]]
        levels = [level for level, _ in tried] + sorted(cuts + fills)[::2]
        page = (folder / "out" / "page.html").read_text()
        check(page.count("</body>") == 1, "one body")
        probed = folder / "probed.html"
        probed.write_text(page.replace("</body>", PROBE.replace("LEVELS", json.dumps(levels)) + "</body>"))
        found = json.loads(unquote(state_of(visit(probed, folder, "--dump-dom", webgl=False))["found"]))
        check(found["marks"] == [len(cuts), len(fills)], found["marks"])
        check(found["colors"] == ["rgb(204, 51, 51)", "rgb(31, 111, 178)"], found["colors"])
        check(abs(found["start"] - report["levels"]["shape"]) < 1, found["start"])
        check(len(found["at"]) == len(levels) + 1, found)
        seen = set()
        for one in found["at"]:
            level = one["level"]
            # Of values within the digits that the page shows either is right.
            def counts(shift):
                return [sum(v >= level + shift for v in cuts), sum(v < level - shift for v in fills)]
            few, many = counts(1), counts(-1)
            check(one["marks"] == one["rows"], one)
            check(all(a <= n <= b for a, n, b in zip(few, one["marks"], many)), (one, few, many))
            words = re.match(r"level [^:]+: (\d+) cuts and (\d+) fills needed; at [^:]+: (\d+) pieces, (\d+) loops, "
                             r"(\d+) cavities", one["words"])
            check(words, one["words"])
            check([int(n) for n in words.groups()[:2]] == one["rows"], one)
            nearest = min(tried, key=lambda t: abs(t[0] - level))[1]
            check([int(n) for n in words.groups()[2:]] == nearest, (one, nearest))
            seen.add(tuple(one["rows"]))
        check(len(seen) > 2, "the slider changes nothing: %s" % seen)
        visit(probed, folder, "--screenshot=%s" % (shots / "slider.png"), webgl=False, size=(1000, 3000))
        check((shots / "slider.png").stat().st_size > 10000, "no picture")
        print("%d levels, %s" % (len(found["at"]), sorted(seen)))


if __name__ == "__main__":
    main()
