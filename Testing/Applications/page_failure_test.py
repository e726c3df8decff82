"""Pages whose labels have no faces, and pages that cannot be shown, in headless Chromium.
usage: page_failure_test.py VOXELCORE    exit 77: no Chromium"""
import re
import sys
import tempfile
from pathlib import Path

from module_test_tools import SIZE, check, run, write_nrrd
from page_tools import model_of, pixels, state_of, visit


def said(page, folder, *words, **how):
    """Fails unless the page says a sentence with these words."""
    dom = visit(page, folder, "--dump-dom", quiet=False, **how)
    check(state_of(dom).get("state") == "failed", "%s: the page does not say that it failed" % page.name)
    sentence = re.search(r'<div id="failure" role="alert">(.*?)</div>', dom, re.S)
    check(sentence is not None, "%s: no sentence is to be seen" % page.name)
    for word in ("This page cannot be shown", *words):
        check(word in sentence.group(1), "%s: '%s' is not in '%s'" % (page.name, word, sentence.group(1)))


def colored(picture):
    return sum(max(p) - min(p) > 40 for row in pixels(picture)[150:550] for p in row[350:650])


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        # One voxel, whose core is a point, and five in a row, whose core is a line.
        voxels = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
        voxels[(10 * SIZE[1] + 12) * SIZE[0] + 14] = 1
        write_nrrd(folder / "voxel.nrrd", voxels)
        for i in range(5):
            voxels[(10 * SIZE[1] + 16) * SIZE[0] + 12 + i] = 2
        write_nrrd(folder / "two.nrrd", voxels)
        for scan, dots in (("voxel", [1]), ("two", [1, 0])):
            page = folder / (scan + ".html")
            run(program, "core", folder / (scan + ".nrrd"), "--lambda", "0", "-o", folder / (scan + ".vtp"), "--html",
                page)
            model = model_of(page.read_text())
            check([label["medial"]["dots"][1] for label in model["labels"]] == dots,
                  "points by themselves are not there")
            picture = folder / (scan + ".png")
            visit(page, folder, "--screenshot=%s" % picture)
            check(colored(picture) > 20, "nothing of %s is to be seen" % scan)
        run(program, "batch", folder / "two.nrrd", "-o", folder / "out", "--html")
        page = next((folder / "out").glob("*/*_view.html"))
        model_of(page.read_text())
        check(state_of(visit(page, folder, "--dump-dom")).get("state") == "ready", "batch's page does not come up")

        text = page.read_text()
        for name, bad, words in (
                ("numbers",
                 re.sub(r'(id="data">.{8})(.)', lambda m: m.group(1) + ("B" if m.group(2) == "A" else "A"), text),
                 "damaged"),
                ("letters", text.replace('id="data">', 'id="data">%%%'), "damaged"),
                ("json", text.replace('{"title"', '{"title":inf,"old"'), "damaged"),
                ("short", text[:text.index('id="data">') + 40], "incomplete"),
                ("script", text.replace("new THREE.Scene()", "new THREE.Nothing()"), "not a constructor")):
            check(bad != text, "%s: nothing was damaged" % name)
            (folder / (name + ".html")).write_text(bad)
            said(folder / (name + ".html"), folder, words)
        said(page, folder, "WebGL", webgl=False)


main()
