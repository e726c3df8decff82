#!/usr/bin/env python3
"""Vessel trees with the errors of a segmenting network, mended by the line that the program prints.

    /usr/bin/python3 Testing/Performance/vessel_errors.py build [NUMBER]

Makes NUMBER trees (20) of nine tips, spacing 0.6 mm: the boundary displaced by half a voxel (a smooth field), four
slices shifted by a voxel, 12 islands of up to 27 voxels and 25 pinholes. Each is made into a skeleton by default; then
with the options that the program prints. Prints a row for each: tips of the tree that no tip of the skeleton is near
(two radii and two voxels), tips near none, and the length against that of the same tree without errors; then the
sums. Ends with 1 where a tip is missed or one is too many, or a length is more than 2 % off. `build` has
bin/voxelcore.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
from scipy import ndimage

SPACING = 0.6
SIZE = np.array([150, 120, 160])  # voxels along x, y, z
ISLANDS, PINHOLES, SHIFTED_SLICES = 12, 25, 4


def grow(random, where, way, radius, length, left, segments, tips):
    """A segment and what branches off it: (from, to, radius from, radius to), in voxels."""
    end = where + length * way
    thinner = radius * 0.94
    segments.append((where, end, radius, thinner))
    if left == 1:
        tips.append((end + thinner * way, thinner))
        return
    across = np.cross(way, random.normal(size=3))
    across /= np.linalg.norm(across)
    first = left // 2 if random.random() < 0.5 else left - left // 2
    for share, side in ((first, 1), (left - first, -1)):
        child = radius * (share / left) ** (1 / 3)  # Murray's law
        turned = way * np.cos(0.65) + side * across * np.sin(0.65)
        grow(random, end, turned / np.linalg.norm(turned), max(child, 1.8), length * 0.85, share, segments, tips)


def tree(random):
    """Segments and tips of one that lies within the grid."""
    while True:
        segments, tips = [], []
        grow(random, np.array([SIZE[0] / 2, SIZE[1] / 2, 12.0]), np.array([0.0, 0.0, 1.0]), 5.5, 34, 9, segments, tips)
        ends = np.array([end for _, end, _, _ in segments])
        if not (np.all(ends > 14) and np.all(ends < SIZE - 14)):
            continue
        apart = [
            np.linalg.norm(a[1] - b[1])
            for i, a in enumerate(segments)
            for b in segments[:i]
            if not np.allclose(a[0], b[0])
        ]
        if min(apart) > 14:
            return segments, tips + [(np.array([SIZE[0] / 2, SIZE[1] / 2, 12.0 - 5.5]), 5.5)]


def distances(segments):
    """From each voxel to the surface of the tree, in voxels; negative inside."""
    grid = np.stack(np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij"), -1).astype(np.float32)
    least = np.full(tuple(SIZE), np.inf, np.float32)
    for begin, end, thick, thin in segments:
        low = np.maximum(np.minimum(begin, end) - 16, 0).astype(int)
        high = np.minimum(np.maximum(begin, end) + 17, SIZE).astype(int)
        box = tuple(slice(a, b) for a, b in zip(low, high))
        way = end - begin
        along = np.clip((grid[box] - begin) @ way / (way @ way), 0, 1)
        off = np.linalg.norm(grid[box] - begin - along[..., None] * way, axis=-1) - (thick + along * (thin - thick))
        least[box] = np.minimum(least[box], off)
    return least


def with_errors(random, off):
    """A mask as a network might make it."""
    field = ndimage.gaussian_filter(random.normal(size=off.shape), 3)
    mask = off < 0.5 * np.clip(field / field.std(), -2, 2) * 0.7
    for z in random.choice(np.flatnonzero(mask.any(axis=(0, 1)))[8:-8], SHIFTED_SLICES, replace=False):
        mask[:, :, z] = np.roll(mask[:, :, z], random.choice([-1, 1]), axis=random.integers(2))
    outside = np.argwhere((off > 8) & (off < 20))
    outside = outside[np.all((outside > 4) & (outside < SIZE - 5), axis=1)]
    for at in outside[random.choice(len(outside), ISLANDS, replace=False)]:
        side = random.integers(1, 4, size=3)
        mask[tuple(slice(a, a + n) for a, n in zip(at, side))] = True
    inside = np.argwhere(off < -1)
    for at in inside[random.choice(len(inside), PINHOLES, replace=False)]:
        mask[tuple(at)] = False
    return mask


def write(path, mask):
    head = (
        f"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, SIZE))}\n"
        f"space directions: ({SPACING},0,0) (0,{SPACING},0) (0,0,{SPACING})\nkinds: domain domain domain\n"
        "encoding: raw\nspace origin: (0,0,0)\n\n"
    )
    path.write_bytes(head.encode() + mask.astype(np.uint8).tobytes(order="F"))


def skeleton(program, folder, scan, options):
    """Its tips in voxels, its length in mm, and what was said."""
    run = subprocess.run(
        [program, "skeleton", scan, "--force", "-o", folder / "s.vtp", "--also", "csv", "--report", folder / "r.json",
         *options],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    lines = (folder / "s_branches.csv").read_text().splitlines()
    names = lines[0].split(",")
    rows = [dict(zip(names, line.split(","))) for line in lines[1:]]
    count, place = {}, {}
    for row in rows:
        for end in ("src", "dst"):
            node = row[f"node_id_{end}"]
            count[node] = count.get(node, 0) + 1
            place[node] = np.array([float(row[f"coord_{end}_{axis}"]) for axis in "xyz"]) / SPACING
    length = json.loads((folder / "r.json").read_text())["labels"][0]["skeleton"]["total_length_mm"]
    return [place[node] for node, number in count.items() if number == 1], length, run.stdout + run.stderr


def compared(found, tips):
    """How many tips are missed, and how many are near none."""
    near = np.array([[np.linalg.norm(a - b) <= 2 * radius + 2 for b, radius in tips] for a in found])
    near = near.reshape(len(found), len(tips))
    return int((~near.any(axis=0)).sum()), int((~near.any(axis=1)).sum())


def advice(said):
    """The options of the line that mends noise."""
    line = re.search(r"unless they are real, mend them with ([^;,\n]*)", said)
    return line.group(1).split() if line else []


def main():
    program = pathlib.Path(sys.argv[1]).resolve() / "bin/voxelcore"
    number = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    wrong = 0
    print("| tree | tips | by default missed, too many, length | options printed | missed, too many, length |")
    print("|---|---|---|---|---|")
    for seed in range(1, number + 1):
        random = np.random.default_rng(seed)
        segments, tips = tree(random)
        off = distances(segments)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write(folder / "clean.nrrd", off < 0)
            write(folder / "errors.nrrd", with_errors(random, off))
            _, true_length, _ = skeleton(program, folder, folder / "clean.nrrd", [])
            found, length, said = skeleton(program, folder, folder / "errors.nrrd", [])
            options = advice(said)
            mended, mended_length, _ = skeleton(program, folder, folder / "errors.nrrd", options)
        before, after = compared(found, tips), compared(mended, tips)
        share = [100 * (one / true_length - 1) for one in (length, mended_length)]
        print(
            f"| {seed} | {len(tips)} | {before[0]}, {before[1]}, {share[0]:+.1f} % | {' '.join(options)} | "
            f"{after[0]}, {after[1]}, {share[1]:+.1f} % |",
            flush=True,
        )
        wrong += after != (0, 0) or abs(share[1]) > 2
    print(f"{number - wrong} of {number} as they should be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
