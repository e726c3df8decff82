#!/usr/bin/env python3
"""Local thickness beside other ways to find it, on the same volume: time and bias in one run.
usage: peers.py PROGRAM [SIDE [SLICES]]   (python3-numpy, python3-scipy); SLICES: their distance, 1 or 2.5
 - dilation: as the Python package localthickness (Dahl, Dahl 2023) describes its method, after scipy's distance map:
   the map is dilated by one voxel as often as the greatest radius says; a radius counts where it is large enough.
 - painting: distance map, ridge (balls that lie in a neighbour's left out), balls painted over each other (Hildebrand,
   Rueegsegger 1997; Dougherty, Kunzelmann 2007), the diameter being twice the distance. With the voxel size heeded.
The volume: walls of known thickness between two concentric spheres, and rods and plates, at both spacings."""
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy import ndimage

from bodies import places, random_turn, read_nrrd, write_nrrd

PROGRAM = sys.argv[1]
SIDE = int(sys.argv[2]) if len(sys.argv) > 2 else 256
SLICES = [float(sys.argv[3])] if len(sys.argv) > 3 else [1, 2.5]


def dilation(mask):
    """Isotropic: knows no spacing. Voxels."""
    distance = ndimage.distance_transform_edt(mask).astype(np.float32)
    out = distance.copy()
    weights = np.array([1, 1 / np.sqrt(2), 1 / np.sqrt(3)])
    weights = weights / weights.sum()
    footprints = [ndimage.generate_binary_structure(3, k) for k in (1, 2, 3)]
    for radius in range(int(distance.max())):
        wider = sum(w * ndimage.maximum_filter(out, footprint=f) for w, f in zip(weights, footprints))
        changes = mask & (out > radius)
        out[changes] = wider[changes]
        out[~mask] = 0
    return 2 * out


def painting(mask, spacing):
    """mm."""
    sampling = spacing[::-1]
    distance = ndimage.distance_transform_edt(mask, sampling=sampling)
    ridge = mask.copy()
    for dz in (-1, 0, 1):
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                if (dz, dy, dx) == (0, 0, 0):
                    continue
                step = np.sqrt((dz * sampling[0]) ** 2 + (dy * sampling[1]) ** 2 + (dx * sampling[2]) ** 2)
                ridge &= ~(np.roll(distance, (dz, dy, dx), (0, 1, 2)) >= distance + step - 1e-6)
    out = np.zeros(mask.shape, np.float32)
    at = np.argwhere(ridge)
    radius = distance[ridge]
    flat = out.reshape(-1)
    size = mask.shape
    for r in np.unique(np.round(radius, 6)):
        chosen = at[np.abs(radius - r) < 1e-6]
        reach = [int(r / s) for s in sampling]
        z, y, x = np.mgrid[-reach[0]:reach[0] + 1, -reach[1]:reach[1] + 1, -reach[2]:reach[2] + 1]
        inside = (z * sampling[0]) ** 2 + (y * sampling[1]) ** 2 + (x * sampling[2]) ** 2 < r * r + 1e-9
        offsets = np.stack([z[inside], y[inside], x[inside]], 1)
        for begin in range(0, len(chosen), max(1, 2000000 // len(offsets))):
            part = chosen[begin:begin + max(1, 2000000 // len(offsets))]
            voxels = (part[:, None, :] + offsets[None, :, :]).reshape(-1, 3)
            good = np.all((voxels >= 0) & (voxels < size), axis=1)
            flat[np.ravel_multi_index(voxels[good].T, size)] = 2 * r  # ascending: later ones are greater
    out[~mask] = 0
    return out


def volume(spacing, random):
    """Concentric shells and plates through them: (mask, [(name, known, thickness)])."""
    size = [int(SIDE / s) for s in spacing]
    p = places(size, spacing, (0.2, 0.3, 0.1), random_turn(random))
    distance = np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)
    mask = np.zeros(distance.shape, bool)
    parts = []
    radius = 0.05 * SIDE
    for k, thickness in enumerate((5, 8, 12, 6, 9)):
        shell = (distance > radius) & (distance < radius + thickness)
        mask |= shell
        parts.append((f"shell {thickness}", shell, thickness))
        radius += thickness + 9
    return mask, parts


for slices in SLICES:
    spacing = (1, 1, slices)
    mask, parts = volume(spacing, np.random.default_rng(7))
    print(f"\n{SIDE}^3 mm at 1:1:{spacing[2]:g}: {mask.size} voxels, {mask.mean():.0%} solid")
    print("| | seconds | " + " | ".join(name for name, _, _ in parts) + " |")
    print("| --- " * (2 + len(parts)) + "|")

    def report(name, seconds, values):
        cells = [f"{values[known].mean() - thickness:+.2f} +- {values[known].std():.2f}"
                 for _, known, thickness in parts]
        print(f"| {name} | {seconds:.1f} | " + " | ".join(cells) + " |", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        write_nrrd(f"{folder}/a.nrrd", mask, spacing)
        for name, more in (("voxelcore", []), ("voxelcore --refine off", ["--refine", "off"])):
            begin = time.time()
            command = [PROGRAM, "thickness", f"{folder}/a.nrrd", "-o", f"{folder}/map.nrrd", "--force", "-q"]
            subprocess.run(command + more, check=True)
            report(name, time.time() - begin, read_nrrd(f"{folder}/map.nrrd"))
    begin = time.time()
    values = dilation(mask)
    report("dilation (isotropic)", time.time() - begin, values)
    begin = time.time()
    values = painting(mask, spacing)
    report("painting", time.time() - begin, values)
