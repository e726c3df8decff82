#!/usr/bin/env python3
"""Random volumes of every density, cubes to slices five times as thick, read by 26 and with pieces joined: pieces,
loops and cavities of their skeletons are held against counts of the closed cubes by SciPy and NumPy. Then bodies with
cavities in them: curves alone, with the pieces and loops of the body that is filled.

    PYTHONPATH=build/python /usr/bin/python3 Testing/Campaigns/connected_volumes.py VOLUMES [SEED]

Prints how many differ, and how many are refused, by density. Ends with 1 where any differs.
"""

import collections
import itertools
import secrets
import sys

import numpy as np
from scipy import ndimage

import voxelcore

FACES = ndimage.generate_binary_structure(3, 1)
ALL = np.ones((3, 3, 3))


def alternating(padded, of_neighbours):
    """Cells of the grid, each as its cubes say by `of_neighbours`: cubes less faces plus edges less vertices."""
    total = 0
    for flat in itertools.product((0, 1), repeat=3):  # 1: no extent along that axis
        cells = padded
        for axis in range(3):
            if flat[axis]:
                last = cells.shape[axis] - 1
                cells = of_neighbours(cells.take(range(1, last + 1), axis), cells.take(range(last), axis))
        total += (-1) ** sum(flat) * int(cells.sum())
    return total


def closed_betti(body):
    """Pieces by 26, loops by Euler's number of the closed cubes, cavities by 6."""
    padded = np.pad(body, 1)
    pieces = ndimage.label(padded, ALL)[1]
    cavities = ndimage.label(1 - padded, FACES)[1] - 1
    return [pieces, pieces + cavities + alternating(padded, np.maximum), cavities]


def loops_by_faces(body):
    """Loops and cavities of the 6-connected body, whose cells are those all of whose cubes are in it."""
    padded = np.pad(body, 1)
    pieces = ndimage.label(padded, FACES)[1]
    cavities = ndimage.label(1 - padded, ALL)[1] - 1
    return pieces + cavities - alternating(padded, np.minimum), cavities


def expected(body, way):
    if way == "26":
        return closed_betti(body)
    loops, cavities = loops_by_faces(body)
    return [ndimage.label(body, ALL)[1], loops, cavities]


def spheres(rng):
    """Balls that meet, with balls of background in them, and at times a body in these."""
    size = rng.integers(20, 36, 3)
    grid = np.indices(size).T.swapaxes(0, 2)
    body = np.zeros(size, np.uint8)
    for _ in range(rng.integers(1, 4)):
        radius = rng.uniform(5, 0.45 * size.min())
        middle = [rng.uniform(radius + 1, one - radius - 1) if one > 2 * radius + 2 else one / 2 for one in size]
        away = np.sqrt(((grid - middle) ** 2).sum(3))
        body |= (away <= radius).astype(np.uint8)
        for _ in range(rng.integers(1, 4)):
            inner = middle + rng.normal(0, 0.3 * radius, 3)
            hole = np.sqrt(((grid - inner) ** 2).sum(3))
            within = rng.uniform(1, 0.6 * radius)
            body[hole <= within] = 0
            body[hole <= rng.uniform(-1, 0.5) * within] = 1
    return body


def main():
    volumes = int(sys.argv[1])
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(2**32)
    print(f"seed {seed}", flush=True)
    rng = np.random.default_rng(seed)
    differ = 0
    told = collections.Counter()
    for number in range(volumes):
        size = rng.integers(3, 11, 3)
        density = rng.uniform(0, 1)
        body = (rng.random(size) < density).astype(np.uint8)
        if rng.random() < 0.5:  # lumps instead of dust
            smooth = ndimage.gaussian_filter(rng.random(size), 0.8)
            body = (smooth <= np.quantile(smooth, density)).astype(np.uint8)
        if not body.any():
            continue
        spacing = (1, 1, float(rng.choice([1, 1, 1.5, 2, 3, 5])))
        for way in ("26", "joined"):
            try:
                made = voxelcore.skeleton(body, spacing=spacing, connectivity=way, fill_cavities=False, border="closed")
            except (ValueError, RuntimeError, voxelcore.CertificateError) as error:
                told[way, "refused", "under .1" if density < 0.1 else f"{density:.1f}", str(error)[:60]] += 1
                continue
            label = made.report["labels"][0]
            found = label["skeleton"]["betti"]
            told[way, "made"] += 1
            # Joined: what would close a loop if it were joined stays apart, and is told of.
            apart = label.get("edits", {}).get("touching", {}).get("pieces_apart", 0) if way == "joined" else 0
            told[way, "with pieces left apart"] += apart > 0
            counted = expected(body, way)
            counted[0] += apart
            if found != counted:
                differ += 1
                print(f"volume {number}, {way}, {size}, {spacing}: {found} where {counted} are", flush=True)
    for number in range(volumes // 10):
        body = spheres(rng)
        made = voxelcore.skeleton(body, connectivity="6")
        numbers = made.numbers
        full = 1 - np.isin(ndimage.label(np.pad(1 - body, 1, constant_values=1), ALL)[0], 1)[1:-1, 1:-1, 1:-1]
        loops, _ = loops_by_faces(full.astype(np.uint8))
        pieces = ndimage.label(full, FACES)[1]
        told["cavities", "made"] += 1
        if len(made.face_vertices) > 0 or [numbers["components"], numbers["cycles"]] != [pieces, loops]:
            differ += 1
            print(f"cavities {number}: {numbers['components']} pieces, {numbers['cycles']} loops, "
                  f"{len(made.face_vertices)} on faces, where {pieces} and {loops} are", flush=True)
    for what, count in sorted(told.items()):
        print(*what, count)
    print(f"{differ} differ")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
