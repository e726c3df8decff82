#!/usr/bin/env python3
"""Balls at the side of tubes: has each a branch, has nothing else one, and is its radius in the table right?
usage: PYTHONPATH=BUILD/python domes.py PROGRAM [BODIES [SEED]]   (python3-numpy)
Tubes of radius 2 to 4 mm with a ball of 5 to 12.5 mm, whose lowest point is .3 to .7 tube radii off the tube's axis, in
random turns; voxels of 1, of .5 and of 1 x 1 x 2 mm. Where ball and tube part, voxels may leave a slit: masks with a
loop are counted by themselves, of 6-connected voxels and of 26-connected ones. Prints the seed, and each body that has
not three branches, or whose greatest max_radius is off by more than .3 of the shortest side."""
import csv
import pathlib
import re
import secrets
import subprocess
import sys
import tempfile

import numpy as np

from lesions import write

VOXELS = [(1, 1, 1), (0.5, 0.5, 0.5), (1, 1, 2)]


def body(random, spacing):
    """Mask and the ball's radius."""
    tube, ball = random.uniform(2, 4), random.uniform(5, 12.5)
    away = ball + tube * random.uniform(0.3, 0.7)
    axis, side = np.linalg.qr(random.normal(size=(3, 2)))[0].T
    half = ball + 12
    size = np.ceil((2 * half + 2 * ball + 10) / np.array(spacing)).astype(int)
    middle = size * spacing / 2 + random.uniform(-0.5, 0.5, 3) * spacing
    places = np.stack(np.indices(size), -1) * spacing - middle
    along = places @ axis
    across = (places * places).sum(-1) - along * along
    return ((across <= tube**2) & (np.abs(along) <= half)) | (((places - away * side)**2).sum(-1) <= ball**2), ball


def main():
    program = sys.argv[1]
    bodies = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else secrets.randbelow(10**6)
    random = np.random.default_rng(seed)
    print(f"seed {seed}, {bodies} bodies")
    count = {kind: [0, 0] for kind in ("without a slit", "with loops by 26 alone", "with loops")}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number in range(bodies):
            spacing = VOXELS[number % 3]
            mask, ball = body(random, spacing)
            write(folder / "scan.nrrd", mask, spacing)
            subprocess.run([program, "skeleton", folder / "scan.nrrd", "--also", "csv", "--quiet", "--force", "-o",
                            folder / "s.vtp"], check=True, capture_output=True)
            said = subprocess.run([program, "info", folder / "scan.nrrd"], check=True, capture_output=True, text=True)
            loops = [int(found) for found in re.findall(r"\d+/(\d+)/\d+", said.stdout)[:2]]
            with open(folder / "s_branches.csv", newline="") as table:
                rows = list(csv.DictReader(table))
            off = (max(float(row["max_radius"]) for row in rows) - ball) / min(spacing)
            kind = "with loops" if loops[0] else "with loops by 26 alone" if loops[1] else "without a slit"
            isRight = len(rows) == 3 and abs(off) <= 0.3
            count[kind][0] += 1
            count[kind][1] += not isRight
            if not isRight:
                print(f"body {number}, {spacing}, {kind}: {len(rows)} branches, radius off by {off:.2f}", flush=True)
    for kind, (all_of, wrong) in count.items():
        print(f"{kind}: {wrong} of {all_of} wrong")


if __name__ == "__main__":
    main()
