#!/usr/bin/env python3
"""Figures 3 and 4: a voxel shape whose voxels are cut into k^3 each. Its core nears the true medial axis of the shape
(of the cubes, not of anything smooth): the paper proves a distance of at most sqrt(3)/(2k) voxel from core to axis."""

import os
import tempfile

import numpy as np
from scipy.spatial import cKDTree

from common import (VIEW, Core, Middles, arguments, core, distance_to_core,
                    hang, paint, plt, require, save, write_nrrd, write_table)


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


def nearest_on_boundary(points, faces):
    best, feet = np.full(len(points), np.inf), np.zeros_like(points)
    for axis, _, corner in faces:
        on = np.clip(points, corner, corner + 1 - np.eye(3)[axis])
        apart = np.linalg.norm(points - on, axis=1)
        feet[apart < best] = on[apart < best]
        best = np.minimum(best, apart)
    return feet


def greatest_ball(p, d, faces):
    """How far from boundary points `p` along `d` the centre of the greatest ball is that touches there, by
    bisection."""
    low, high = np.full(len(p), 1e-6), np.full(len(p), 4.0)
    for _ in range(30):
        middle = (low + high) / 2
        fits = to_boundary(p + middle[:, None] * d, faces) >= middle - 1e-9
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    return low


def to_axis(points, samples, faces):
    """Distances to the true axis, from above: to its nearest sample, or to the centre of the greatest ball that touches
    where a point's own does."""
    best = cKDTree(samples).query(points)[0]
    feet = nearest_on_boundary(points, faces)
    way = points - feet
    radius = np.linalg.norm(way, axis=1)
    direction = way / np.where(radius > 0, radius, 1)[:, None]
    return np.minimum(best, np.abs(greatest_ball(feet, direction, faces) - radius))


def true_axis(faces, per_side, wanted=lambda place: True):
    """Centres of the greatest balls inside that touch the boundary at samples: by bisection, with the distance to all
    squares. Every such ball touches the inside of a square, or an edge or corner that juts into the shape; of the
    latter the balls along a fan of directions are taken. `wanted` chooses squares by their corner: fewer samples."""
    starts, directions = [], []
    t = (np.arange(per_side) + 0.5) / per_side
    u, v = (g.ravel() for g in np.meshgrid(t, t))
    normals = {}
    for axis, sign, corner in filter(lambda face: wanted(face[2]), faces):
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
    low = greatest_ball(p, d, faces)
    # Samples whose direction leaves the shape, or runs along its surface, have no ball.
    return (p + low[:, None] * d)[low > 1e-3]


def draw_voxels(panel, voxels, k, box):
    """The shape, cut into k^3: its boundary squares from behind to the front."""
    from matplotlib.collections import PolyCollection

    found = []
    for axis, sign, corner in squares(voxels.repeat(k, 0).repeat(k, 1).repeat(k, 2)):
        u, v = np.eye(3)[[a for a in range(3) if a != axis]]
        around = (np.array([corner, corner + u, corner + u + v, corner + v]) / k) @ VIEW
        towards = -sign * VIEW[axis, 2]
        if towards > 0:
            found.append((around[:, 2].mean(), around[:, :2], 0.55 + 0.4 * towards))
    found.sort(key=lambda one: one[0])
    panel.add_collection(
        PolyCollection([f[1] for f in found],
                       facecolors=[(f[2], ) * 3 for f in found],
                       edgecolors="0.3",
                       linewidths=0.4))
    panel.set_xlim(box[:2])
    panel.set_ylim(box[2:])
    panel.set_aspect("equal")
    panel.set_axis_off()


def figure_4(options, voxels, cores, axis):
    """The shape cut once and twice, its cores, and its true axis."""
    figure, panels = plt.subplots(2, len(cores), figsize=(2.6 * len(cores), 4.6), squeeze=False)
    for column, (k, one) in enumerate(cores.items()):
        painted = paint(one, pixels=420, box=(-4.3, 6.6, -4.5, 4.5))
        hang(panels[1][column], painted)
        box = painted[1]
        panels[1][column].set_title(f"core, k = {k}", fontsize=9)
        if column + 1 < len(cores) and k < 4:
            draw_voxels(panels[0][column], voxels, k, box)
            panels[0][column].set_title(f"shape, k = {k}", fontsize=9)
        else:
            panels[0][column].set_axis_off()
    last = panels[0][-1]
    there = axis @ VIEW
    order = np.argsort(there[:, 2])
    last.scatter(there[order, 0], there[order, 1], s=0.4, c=there[order, 2], cmap="Greens_r", vmin=there[:, 2].min(),
                 vmax=2 * there[:, 2].max(), linewidths=0)
    last.set_xlim(box[:2])
    last.set_ylim(box[2:])
    last.set_aspect("equal")
    last.set_title("true axis", fontsize=9)
    save(figure, options.output, "figure-4")


def flat():
    """A pattern of pixels as in figure 3, as a prism so long that ends do not matter in its middle."""
    rows = ["..####....", ".######...", ".######.##", "##########", "##########", ".#####..##", "..####...."]
    pattern = np.array([[c == "#" for c in row] for row in rows[::-1]]).T
    return pattern, np.repeat(pattern[:, :, None], 8, axis=2)


def figure_3(options, folder):
    """In the plane: a section through the middle of a prism's core is the two-dimensional core of its base."""
    pattern, prism = flat()
    faces = squares(prism)
    axis = true_axis(faces, 10 if options.small else 30, lambda place: abs(place[2] + 0.5 - 4) < 1)
    axis = axis[np.abs(axis[:, 2] - 4) < 0.5]
    ks = [k for k in options.resolutions if k <= 4]
    figure, panels = plt.subplots(1, len(ks), figsize=(3.2 * len(ks), 2.6), squeeze=False)
    for panel, k in zip(panels[0], ks):
        scan, out = os.path.join(folder, "prism.nrrd"), os.path.join(folder, "prism.vtp")
        write_nrrd(scan, prism.repeat(k, 0).repeat(k, 1).repeat(k, 2), 1 / k, (0.5 / k,) * 3)
        core(options.program, scan, folder, "--lambda", "0", "-o", out)
        found = Core(out)
        corners = found.points[found.triangles]
        height = 4 + 0.25 / k  # between two layers of lattice points
        lines = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            p, q = corners[:, a], corners[:, b]
            crosses = (p[:, 2] < height) != (q[:, 2] < height)
            t = (height - p[:, 2]) / np.where(crosses, q[:, 2] - p[:, 2], 1)
            lines.append(np.where(crosses[:, None], p + t[:, None] * (q - p), np.nan)[:, :2])
        ends = np.sort(np.stack(lines, 1).view([("x", float), ("y", float)])[..., 0],
                       axis=1)  # of three the nan is last
        panel.pcolormesh(np.arange(len(pattern) * k + 1) / k,
                         np.arange(len(pattern[0]) * k + 1) / k,
                         np.where(pattern, 0.0, 1.0).repeat(k, 0).repeat(k, 1).T,
                         cmap="gray",
                         vmin=-8,
                         vmax=1,
                         edgecolors="0.75",
                         linewidth=0.2)
        panel.plot(axis[:, 0], axis[:, 1], ".", color="limegreen", markersize=1.5)
        panel.plot(ends["x"][:, :2].T, ends["y"][:, :2].T, "b-", linewidth=0.8)
        panel.set_aspect("equal")
        panel.set_axis_off()
        panel.set_title(f"k = {k}", fontsize=9)
    save(figure, options.output, "figure-3")


def main():
    options = arguments(__doc__, "1,2,4,8", "1,2,4")
    voxels = shape()
    faces = squares(voxels)
    axis = true_axis(faces, 12 if options.small else 24)
    rows, cores = [], {}
    with tempfile.TemporaryDirectory() as folder:
        for k in options.resolutions:
            scan, out = os.path.join(folder, "shape.nrrd"), os.path.join(folder, "core.vtp")
            fine = voxels.repeat(k, 0).repeat(k, 1).repeat(k, 2)
            write_nrrd(scan, fine, 1 / k, (0.5 / k,) * 3)
            report = core(options.program, scan, folder, "--lambda", "0", "-o", out)
            require(report["labels"][0]["certificate"]["passed"], "certificate")
            found = cores[k] = Core(out)
            # Points all over the core, too: elements are as large as a voxel.
            corners = found.points[found.triangles]
            weights = np.random.default_rng(1).dirichlet((1, 1, 1), 8)
            there = np.concatenate(
                [found.points, np.concatenate([np.einsum("c,ncd->nd", w, corners) for w in weights])])
            forward = to_axis(there, axis, faces).max()
            back = distance_to_core(axis, Middles(found), 32).max()
            bound = np.sqrt(3) / (2 * k)
            rows.append([k, len(found.points), float(forward), bound, float(forward / bound), float(1 / (4 * k)),
                         float(forward * 4 * k), float(back)])
            require(forward <= bound, f"core to axis within sqrt(3)/(2k) at k = {k}")
        figure_3(options, folder)
    figure_4(options, voxels, cores, axis)
    write_table(
        options.output, "figure-4",
        ["k", "core vertices", "core to axis", "sqrt(3)/(2k)", "of that bound", "h/4", "in h/4", "axis to core"], rows,
        f"Distances in voxels of the given shape; the axis as {len(axis)} centres of greatest balls.")
    figure, panel = plt.subplots(figsize=(5.5, 4))
    ks = [row[0] for row in rows]
    panel.loglog(ks, [row[2] for row in rows], "o-", label="core to axis")
    panel.loglog(ks, [row[7] for row in rows], "s-", label="axis to core")
    panel.loglog(ks, [row[3] for row in rows], "k--", label="sqrt(3)/(2k)")
    panel.loglog(ks, [row[5] for row in rows], "k:", label="h/4")
    panel.set_xticks(ks, [str(k) for k in ks])
    heights = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1]
    panel.set_yticks(heights, [str(h) for h in heights])
    panel.minorticks_off()
    panel.set_xlabel("voxels cut into k x k x k")
    panel.set_ylabel("distance in voxels of the shape")
    panel.legend()
    save(figure, options.output, "figure-4-distances")


if __name__ == "__main__":
    main()
