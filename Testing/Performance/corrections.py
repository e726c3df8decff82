#!/usr/bin/env python3
"""Edits of a person replayed: on the same scan to the byte, and where the threshold has moved by 2 % those that fit.

usage: corrections.py PROGRAM [--count 40] [--seed 1] [--folder FOLDER] [--bodies airway,root]

An airway and a root of VOXELCORE_TEST_DATA are made grey by a Gaussian of 0.7 voxels, 0 to 250, and taken from 125 on.
Edits are drawn among what --annotations names: cuts, removals, paths, joins, names, a root, real loops and single
voxels; of more the first that fit are kept. They are replayed from both files of annotations, which must give the same
bytes, and at thresholds 2 % higher and lower. A row a body and threshold; exit 1 where bytes differ or fewer than 95 %
fit.
"""
import argparse
import csv
import gzip
import os
import random
import re
import subprocess
import sys
import tempfile

import nibabel
import numpy
from scipy import ndimage

from hollow_warning import write_nrrd

BODIES = {"airway": "real/airways/SanmedAI_305.nii.gz", "root": "real/roots/rootgui_353-10_rasterised.nrrd"}
BASE = 125
MOVED = (BASE * 1.02, BASE * 0.98)


def run(program, scan, threshold, output, *more):
    done = subprocess.run([program, "skeleton", scan, "--threshold", f"{threshold}:inf", "-o", output, "--force",
                           "--min-voxels", "100", "--fill-cavities", *more], text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"{scan} at {threshold}: exit {done.returncode}: {done.stderr}")
    return [line for line in done.stderr.splitlines() if "is left out: " in line]


def make(name, folder):
    """Grey values of a mask, cut to where it is."""
    mask, spacing = read(os.path.join(os.environ["VOXELCORE_TEST_DATA"], BODIES[name]))
    box = ndimage.find_objects(mask)[0]
    mask = numpy.pad(mask[box], 4).astype(numpy.float32)
    grey = numpy.rint(250 * ndimage.gaussian_filter(mask, 0.7)).astype(numpy.uint8)
    scan = os.path.join(folder, name + ".nrrd")
    write_nrrd(scan, grey, spacing)
    return scan


def read(path):
    """A mask in the order z, y, x and its spacing; NIfTI or NRRD, as the two bodies are."""
    if path.endswith(".nii.gz"):
        image = nibabel.load(path)
        spacing = [float(side) for side in image.header.get_zooms()[:3]]
        return (numpy.asarray(image.dataobj).T > 0).astype(numpy.uint8), spacing
    with open(path, "rb") as file:
        head, data = file.read().split(b"\n\n", 1)
    size = [int(word) for word in re.search(rb"sizes: (.*)", head).group(1).split()]
    return (numpy.frombuffer(gzip.decompress(data), "u1").reshape(size[::-1]) > 0).astype(numpy.uint8), [1.0, 1.0, 1.0]


def draw(folder, name, count, random):
    """Rows of edits, each with a place: kinds take turns."""
    with open(os.path.join(folder, name + "_annotations.csv")) as file:
        rows = list(csv.DictReader(file))
    with open(os.path.join(folder, name + "_branches.csv")) as file:
        branches = list(csv.DictReader(file))
    place = lambda row: [float(row[axis]) for axis in row if axis.split(" ")[0] in ("x", "y", "z")]
    end = lambda branch, which: [float(branch[axis]) for axis in branch if axis.startswith(f"coord_{which}_")]
    rows = [row for row in rows if row["branch"]]
    size = lambda row: float(branches[int(row["branch"])]["mean_radius"])
    away = lambda a, b: sum((p - q) ** 2 for p, q in zip(a, b)) ** 0.5
    nodes = {}
    for branch in branches:
        for which in ("src", "dst"):
            nodes.setdefault(branch["node_id_" + which], []).append(end(branch, which))
    tips = [ends[0] for ends in nodes.values() if len(ends) == 1]
    loops = [row for row in rows if branches[int(row["branch"])]["closes_loop"] == "1"]
    edits = []
    kinds = ["cut", "remove", "path", "name", "background", "join", "loop"]
    for number in range(count):
        kind, row = kinds[number % len(kinds)], random.choice(rows)
        here = place(row)
        if kind == "path":
            way = [random.gauss(0, 1) for _ in range(3)]
            long = random.uniform(3, 5) * size(row) / away(way, (0, 0, 0))
            text, at = "path " + " ".join(f"{p + long * w:.4f}" for p, w in zip(here, way)), here
        elif kind == "name":
            text, at = "", here
        elif kind == "background":
            text, at = kind, here  # in the middle it would be a cavity: moved to the surface by half of them
            at = [p + size(row) * w for p, w in zip(here, random.choice([(1, 0, 0), (0, 1, 0), (0, 0, 1)]))]
        elif kind == "join":
            at = random.choice(tips)
            other = sorted(tips, key=lambda tip: away(tip, at))[1]
            text = "join " + " ".join(f"{p:.4f}" for p in other)
        elif kind == "loop" and loops:
            text, at = kind, place(random.choice(loops))
        elif kind == "loop":
            text, at = "root" if number < len(kinds) else "cut", random.choice(tips) if number < len(kinds) else here
        else:
            text, at = kind, here
        edits.append((at, text, f"name {number}" if kind == "name" else ""))
    seen = set()  # who says a thing twice says it once
    return [one for one in edits if not ((key := (*one[0], one[1])) in seen or seen.add(key))]


def write(path, edits):
    with open(path, "w") as file:
        file.write("branch,x,y,z,edit,name\n")
        for at, text, name in edits:
            file.write(f",{at[0]:.7g},{at[1]:.7g},{at[2]:.7g},{text},{name}\n")


def tell(name, threshold, edits, told):
    share = 100 - 100 * len(told) / len(edits)
    print(f"{name:8}{threshold:9}{len(edits):7}{len(edits) - len(told):5}{share:6.1f} %")
    for line in told:
        print("#   " + line.split(": ", 1)[1], flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder")
    parser.add_argument("--bodies", default="airway,root")
    options = parser.parse_args()
    folder = options.folder or tempfile.mkdtemp()
    at = lambda name: os.path.join(folder, name)
    failed = False
    print("body    threshold  edits  fit  share")
    for name in options.bodies.split(","):
        scan = make(name, folder)
        run(options.program, scan, BASE, at(name + ".vtp"), "--annotations", "--also", "csv")
        drawn = draw(folder, name, 4 * options.count, random.Random(options.seed))
        write(at("edits.csv"), drawn)
        told = run(options.program, scan, BASE, at("all.vtp"), "--edits", at("edits.csv"))
        out = {int(re.search(r": line (\d+):", line).group(1)) - 2 for line in told}
        for why in sorted({line.split("is left out: ")[1] for line in told}):
            print(f"#   {sum(line.endswith(why) for line in told):4} of {len(drawn)} drawn: {why}")
        pool = [edit for number, edit in enumerate(drawn) if number not in out]
        fit, told = [], []
        for _ in range(5):  # without the others some no longer fit
            more = options.count - len(fit)
            fit, pool = fit + pool[:more], pool[more:]
            write(at("edits.csv"), fit)
            told = run(options.program, scan, BASE, at("edited.vtp"), "--edits", at("edits.csv"))
            if not told:
                break
            out = {int(re.search(r": line (\d+):", line).group(1)) - 2 for line in told}
            fit = [edit for number, edit in enumerate(fit) if number not in out]
        tell(name, BASE, fit, told)
        failed |= len(told) > 0 or len(fit) < options.count
        for file in ("edited_annotations.csv", "edited_annotations.mrk.json"):
            run(options.program, scan, BASE, at("again.vtp"), "--edits", at(file))
            for ending in (".vtp", "_annotations.csv", "_annotations.mrk.json"):
                with open(at("edited" + ending), "rb") as one, open(at("again" + ending), "rb") as other:
                    if one.read() != other.read():
                        failed = True
                        print(f"{name}: {ending} differs where edits are those of {file}")
        for threshold in MOVED:
            told = run(options.program, scan, threshold, at("moved.vtp"), "--edits", at("edits.csv"))
            tell(name, threshold, fit, told)
            failed |= len(told) > 0.05 * len(fit)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
