#!/usr/bin/env python3
"""Figures 3 and 4: a voxel shape whose voxels are cut into k^3 each. Its core nears the true medial axis of the shape (of the
cubes, not of anything smooth): the paper proves a distance of at most sqrt(3)/(2k) voxel from core to axis."""

import os
import tempfile

import numpy as np
from scipy.spatial import cKDTree

from common import Core, arguments, core, distance_to_core, plt, require, save, write_nrrd, write_table


def shape():
    """An L with a step and a bar: 34 voxels of 1 mm, thick and thin parts, inner edges and corners."""
    voxels = np.zeros((7, 5, 4), bool)
    voxels[:4, :2, :2] = True
    voxels[:2, 2:5, :2] = True
    voxels[:2, :2, 2:4] = True
    voxels[4:7, 1, 0] = True
    voxels[6, 1:4, 0] = True
    return voxels


def squares(voxels):
    """Boundary squares: axis, inward direction and lower corner of each, in voxels."""
    padded = np.pad(voxels, 1)
    found = []
    for axis in range(3):
        change = np.diff(padded.astype(int), axis=axis)
        for place in np.argwhere(change != 0):
            sign = change[tuple(place)]  # 1: the shape lies above
            corner = place - 1
            corner[axis] += 1
            found.append((axis, sign, corner))
    return found


def to_boundary(points, faces):
    """Distances of points to the union of squares."""
    best = np.full(len(points), np.inf)
    for axis, _, corner in faces:
        apart = np.zeros(len(points))
        for a in range(3):
            low, high = corner[a], corner[a] + (a != axis)
            apart += np.maximum(np.maximum(low - points[:, a], points[:, a] - high), 0) ** 2
        best = np.minimum(best, apart)
    return np.sqrt(best)


def true_axis(faces, per_side):
    """Centres of the greatest balls inside that touch the boundary at samples: by bisection, with the distance to all squares.
    Every such ball touches the inside of a square, or an edge or corner that juts into the shape; of the latter the balls
    along a fan of directions are taken."""
    starts, directions = [], []
    t = (np.arange(per_side) + 0.5) / per_side
    u, v = (g.ravel() for g in np.meshgrid(t, t))
    normals = {}
    for axis, sign, corner in faces:
        place = np.zeros((len(u), 3))
        others = [a for a in range(3) if a != axis]
        place[:, others[0]], place[:, others[1]] = u, v
        starts.append(place + corner)
        direction = np.zeros(3)
        direction[axis] = sign
        directions.append(np.tile(direction, (len(u), 1)))
        for a in range(2):  # the square's four edges and corners, in halves of a voxel
            for end in (0, 2):
                key = [2 * c for c in corner]
                key[others[a]] += end
                key[others[1 - a]] += 1
                normals.setdefault(tuple(key), set()).add((axis, sign))
        for ends in np.ndindex(2, 2):
            key = [2 * c for c in corner]
            key[others[0]] += 2 * ends[0]
            key[others[1]] += 2 * ends[1]
            normals.setdefault(tuple(key), set()).add((axis, sign))
    for key, around in normals.items():
        place = np.array(key) / 2
        along = [a for a in range(3) if key[a] % 2]
        signs = dict(around)
        if len(signs) < 2:
            continue
        fan = t if along else np.array([0.1, 0.3, 0.5, 0.7, 0.9])
        spots = [place] if not along else [place + (s - 0.5) * np.eye(3)[along[0]] for s in t]
        axes = sorted(signs)
        if len(axes) == 2:
            fans = [np.cos(a * np.pi / 2) * signs[axes[0]] * np.eye(3)[axes[0]] +
                    np.sin(a * np.pi / 2) * signs[axes[1]] * np.eye(3)[axes[1]] for a in fan]
        else:
            fans = [np.array([np.sin(p) * np.cos(q), np.sin(p) * np.sin(q), np.cos(p)]) * [signs[a] for a in range(3)]
                    for p in fan * np.pi / 2 for q in fan * np.pi / 2]
        for spot in spots:
            for direction in fans:
                starts.append(spot[None])
                directions.append(direction[None])
    p, d = np.concatenate(starts), np.concatenate(directions)
    low, high = np.full(len(p), 1e-6), np.full(len(p), 4.0)
    for _ in range(40):
        middle = (low + high) / 2
        fits = to_boundary(p + middle[:, None] * d, faces) >= middle - 1e-9
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    # Samples whose direction leaves the shape, or runs along its surface, have no ball.
    return (p + low[:, None] * d)[low > 1e-3]


def main():
    options = arguments(__doc__, "1,2,4,8", "1,2,4")
    voxels = shape()
    faces = squares(voxels)
    axis = true_axis(faces, 12 if options.small else 40)
    tree = cKDTree(axis)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for k in options.resolutions:
            scan, out = os.path.join(folder, "shape.nrrd"), os.path.join(folder, "core.vtp")
            fine = voxels.repeat(k, 0).repeat(k, 1).repeat(k, 2)
            write_nrrd(scan, fine, 1 / k, (0.5 / k,) * 3)
            report = core(options.program, scan, folder, "--lambda", "0", "-o", out)
            require(report["labels"][0]["certificate"]["passed"], "certificate")
            found = Core(out)
            # Points all over the core, too: elements are as large as a voxel.
            corners = found.points[found.triangles]
            weights = np.random.default_rng(1).dirichlet((1, 1, 1), 8)
            there = np.concatenate([found.points, np.concatenate([np.einsum("c,ncd->nd", w, corners) for w in weights])])
            forward = tree.query(there)[0].max()
            back = distance_to_core(axis, found, 32).max()
            bound = np.sqrt(3) / (2 * k)
            rows.append([k, len(found.points), float(forward), bound, float(forward / bound), float(1 / (4 * k)),
                         float(forward * 4 * k), float(back)])
            require(forward <= bound + 2 / (12 if options.small else 40) ** 2 + 1e-9, f"core to axis within sqrt(3)/(2k) at k = {k}")
    write_table(options.output, "figure-3",
                ["k", "core vertices", "core to axis", "sqrt(3)/(2k)", "of that bound", "h/4", "in h/4", "axis to core"], rows,
                f"Distances in voxels of the given shape; the axis as {len(axis)} centres of greatest balls.")
    figure, panel = plt.subplots(figsize=(5.5, 4))
    ks = [row[0] for row in rows]
    panel.loglog(ks, [row[2] for row in rows], "o-", label="core to axis")
    panel.loglog(ks, [row[7] for row in rows], "s-", label="axis to core")
    panel.loglog(ks, [row[3] for row in rows], "k--", label="sqrt(3)/(2k)")
    panel.loglog(ks, [row[5] for row in rows], "k:", label="h/4")
    panel.set_xticks(ks, [str(k) for k in ks])
    panel.minorticks_off()
    panel.set_xlabel("voxels cut into k x k x k")
    panel.set_ylabel("distance in voxels of the shape")
    panel.legend()
    save(figure, options.output, "figure-3")


if __name__ == "__main__":
    main()
