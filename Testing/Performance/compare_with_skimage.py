#!/usr/bin/python3
"""Curve skeletons by scikit-image's skeletonize_3d and by voxelcore, on the same volumes.

usage: compare_with_skimage.py VOXELCORE [REPETITIONS]

Prints a table: seconds (the best of the repetitions, of the whole command for voxelcore, of the one call for
scikit-image), and pieces and Euler number before and after. Each is held to its own connectivity: scikit-image thins
26-connected objects, voxelcore 6-connected ones. Needs python3-skimage and python3-nibabel.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

import nibabel
import numpy
from scipy import ndimage
from skimage.measure import euler_number
from skimage.morphology import skeletonize_3d

PHANTOMS = [("ball", 64), ("torus", 64), ("tanglecube", 96), ("gyroid", 96), ("porous", 64), ("root", 128),
            ("root", 256)]


def solid(shape, first, last):
    volume = numpy.zeros(shape, numpy.uint8)
    volume[tuple(slice(a, b) for a, b in zip(first, last))] = 1
    return volume


def volumes(program, folder):
    """Yields a name and the path of a NIfTI file."""
    shell = solid((24, 24, 24), (2, 2, 2), (22, 22, 22))
    shell[5:19, 5:19, 5:19] = 0
    made = {
        "one voxel": solid((5, 5, 5), (2, 2, 2), (3, 3, 3)),
        "cube 20": solid((24, 24, 24), (2, 2, 2), (22, 22, 22)),
        "column 4x4x100": solid((8, 8, 104), (2, 2, 2), (6, 6, 102)),
        "plate 40x40x2": solid((44, 44, 6), (2, 2, 2), (42, 42, 4)),
        "closed shell": shell,
    }
    for name, volume in made.items():
        path = os.path.join(folder, "made.nii")
        nibabel.save(nibabel.Nifti1Image(volume, numpy.eye(4)), path)
        yield name, path
    for kind, size in PHANTOMS:
        path = os.path.join(folder, "phantom.nii")
        subprocess.run([program, "phantom", kind, "--size", str(size), "-o", path, "--force", "--quiet"], check=True)
        yield f"{kind} {size}", path


def by_skimage(path, repetitions):
    volume = numpy.asarray(nibabel.load(path).dataobj) > 0
    best = float("inf")
    for _ in range(repetitions):
        start = time.perf_counter()
        skeleton = skeletonize_3d(volume)
        best = min(best, time.perf_counter() - start)
    around = numpy.ones((3, 3, 3))
    numbers = [(ndimage.label(v, around)[1], int(euler_number(v, connectivity=3))) for v in (volume, skeleton > 0)]
    return best, *numbers


def by_voxelcore(program, path, folder, repetitions):
    report = os.path.join(folder, "report.json")
    best = float("inf")
    for _ in range(repetitions):
        start = time.perf_counter()
        subprocess.run([program, "skeleton", path, "-o", os.path.join(folder, "s.vtp"), "--report", report, "--force",
                        "--quiet"], check=True)
        best = min(best, time.perf_counter() - start)
    with open(report, encoding="utf-8") as file:
        label = json.load(file)["labels"][0]
    numbers = [(label[of]["betti"][0], label[of]["euler"]) for of in ("shape", "skeleton")]
    return best, *numbers


def main():
    program = sys.argv[1]
    repetitions = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    print(f"{'volume':<16}{'scikit-image s':>15}{'pieces':>14}{'Euler':>16}{'':>6}"
          f"{'voxelcore s':>13}{'pieces':>14}{'Euler':>16}")
    with tempfile.TemporaryDirectory() as folder:
        for name, path in volumes(program, folder):
            line = f"{name:<16}"
            for seconds, before, after in (by_skimage(path, repetitions),
                                           by_voxelcore(program, path, folder, repetitions)):
                pieces, euler = (f"{before[k]} -> {after[k]}" for k in (0, 1))
                line += f"{seconds:>13.2f}  {pieces:>14}{euler:>16}{'' if before == after else '  LOST':<6}"
            print(line.rstrip(), flush=True)


if __name__ == "__main__":
    main()
