#!/usr/bin/env python3
"""Bias and spread of `voxelcore thickness` on plates, rods, spheres and shells at random turns.
usage: bias.py PROGRAM [TURNS [SEED [KIND ...]]]   (python3-numpy)
Prints, per kind, thickness and spacing: the mean over turns of (mean over the body - truth), the worst turn, and the
mean standard deviation within a body, in voxels of the first axis; refined, and of the voxels as they are."""
import subprocess
import sys
import tempfile

import numpy as np

from bodies import make, read_nrrd, write_nrrd

PROGRAM = sys.argv[1]
TURNS = int(sys.argv[2]) if len(sys.argv) > 2 else 24
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
KINDS = sys.argv[4:] or ["plate", "rod", "sphere", "shell"]
CASES = [("plate", t) for t in (2, 3, 4, 5, 6, 8, 12, 20)] + [("rod", t) for t in (3, 4, 6, 8, 12, 20)] + \
        [("sphere", t) for t in (4, 6, 8, 12, 20)] + [("shell", t) for t in (3, 4, 6, 8)]


def run(scan, folder, more):
    subprocess.run([PROGRAM, "thickness", scan, "-o", f"{folder}/map.nrrd", "--force", "-q", *more], check=True)
    return read_nrrd(f"{folder}/map.nrrd")


print(f"seed {SEED}, {TURNS} turns; voxels")
print("| body | spacing | refined: bias, worst, spread | voxels as they are: bias, worst, spread |")
print("| --- | --- | --- | --- |")
with tempfile.TemporaryDirectory() as folder:
    for kind, thickness in CASES:
        for spacing in ((1, 1, 1), (1, 1, 2.5)) if kind in KINDS else ():
            random = np.random.default_rng([SEED, thickness, len(kind), int(10 * spacing[2])])
            figures = {"labels": [], "off": []}
            for _ in range(TURNS):
                mask, known = make(kind, thickness, spacing, random)
                write_nrrd(f"{folder}/a.nrrd", mask, spacing)
                for refine, all_figures in figures.items():
                    values = run(f"{folder}/a.nrrd", folder, ["--refine", refine])[known].astype(float)
                    all_figures.append((values.mean() - thickness, values.std()))
            cells = []
            for all_figures in figures.values():
                f = np.array(all_figures)
                cells.append(f"{f[:, 0].mean():+.2f}, {f[np.abs(f[:, 0]).argmax(), 0]:+.2f}, {f[:, 1].mean():.2f}")
            print(f"| {kind} {thickness} | 1:1:{spacing[2]:g} | {cells[0]} | {cells[1]} |", flush=True)
