#!/usr/bin/env python3
"""Stenoses and bulges told by radius, on straight tubes drawn afresh in random directions.
usage: PYTHONPATH=BUILD/python stenoses.py [BODIES [SEED]]   (python3-numpy)
Radii of 1.5 to 4 mm become 30 to 90 % less, or 30 to 150 % more, in the shape of a Gaussian of standard deviation 1 to
5 mm. Prints the seed and, per size of voxels, how far the degree of a stenosis by the table's least radius is off, in
points of a hundred; how far the greatest radius of a bulge is off, in voxels (the shortest side); and the least radius
of tubes that are even. Masks that fall into pieces or have more than one branch are counted, not measured."""
import secrets
import sys

import numpy as np
import voxelcore

VOXELS = [(0.4, 0.4, 0.4), (0.5, 0.5, 1.0), (0.5, 0.5, 3.0)]


def tube(random, spacing, radius_at, length, widest):
    """Voxels whose middle lies in a tube with flat ends, as (x, y, z)."""
    spacing = np.array(spacing)
    axis = random.normal(size=3)
    axis /= np.linalg.norm(axis)
    count = np.ceil((np.abs(axis) * length + 2 * widest) / spacing).astype(int) + 6
    middle = count * spacing / 2 + random.uniform(-0.5, 0.5, 3) * spacing
    places = np.stack(np.meshgrid(*[(np.arange(n) + 0.5) * s for n, s in zip(count, spacing)], indexing="ij"), -1)
    away = places - middle
    along = away @ axis
    across = (away * away).sum(-1) - along * along
    return (across < radius_at(along)**2) & (np.abs(along) < length / 2)


def main():
    bodies = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(10**6)
    random = np.random.default_rng(seed)
    print(f"seed {seed}, {bodies} bodies of each kind; mean absolute error, greatest, bias")
    for spacing in VOXELS:
        for kind in ("stenosis", "bulge", "even"):
            errors = []
            for _ in range(bodies):
                radius = random.uniform(1.5, 4)
                depth = {"stenosis": random.uniform(0.3, 0.9), "bulge": -random.uniform(0.3, 1.5), "even": 0}[kind]
                width = random.uniform(1, 5)
                length = max(12 * width, 30)
                mask = tube(random, spacing, lambda s: radius * (1 - depth * np.exp(-s * s / (2 * width * width))),
                            length, radius * (1 - min(depth, 0)))
                skeleton = voxelcore.skeleton(mask.astype(np.uint8), spacing=spacing)
                if skeleton.numbers["branches"] != 1:
                    continue
                least, most = skeleton.radius.min(), skeleton.radius.max()
                if kind == "stenosis":
                    errors.append(100 * ((1 - least / radius) - depth))
                elif kind == "bulge":
                    errors.append((most - radius * (1 - depth)) / min(spacing))
                else:
                    errors.append((least - radius) / min(spacing))
            errors = np.array(errors)
            print(f"{spacing} {kind:8} {np.abs(errors).mean():6.2f} {np.abs(errors).max():6.2f} {errors.mean():6.2f}"
                  f"   ({len(errors)} of one branch)", flush=True)


if __name__ == "__main__":
    main()
