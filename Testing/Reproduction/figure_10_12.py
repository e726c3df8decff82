#!/usr/bin/env python3
"""Figures 10 and 12: topology of the core against that of the mesh, and of a tanglecube with thin connections."""

import os
import tempfile

import numpy as np
from scipy.spatial import cKDTree

from common import (Core, Kept, Meshes, arguments, core, hang, paint,
                    plt, standing_view, require, run, save, write_nrrd, write_table)

NAMES = ["elephant", "elk", "femur", "hand", "cheese", "armadillo", "dragknob", "rotor"]
THIN = 1.16  # voxels: thinner places may be lost or joined
MOST = 400  # of them are looked at, the thinnest first


def read_off(path):
    with open(path, encoding="utf8") as file:
        words = " ".join(line.split("#")[0] for line in file).split()
    count, faces = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    at, corners = 4 + 3 * count, []
    for _ in range(faces):
        sides = int(words[at])
        ids = [int(w) for w in words[at + 1:at + 1 + sides]]
        corners += [(ids[0], ids[i - 1], ids[i]) for i in range(2, sides)]
        at += 1 + sides
    return points, np.array(corners)


def topology_of_mesh(points, triangles):
    """Components and genus, from the mesh alone; points at one place count once."""
    _, same = np.unique(points, axis=0, return_inverse=True)
    triangles = np.asarray(same).reshape(-1)[triangles]
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, uses = np.unique(edges, axis=0, return_counts=True)
    parent = np.arange(same.max() + 1)

    def find(v):
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for a, b in unique:
        parent[find(a)] = find(b)
    used = np.unique(triangles)
    pieces = len({find(v) for v in used})
    euler = len(used) - len(unique) + len(triangles)
    return pieces, pieces - euler // 2, bool((uses == 2).all())


def thinnest_by_block(places, lower, block):
    """Of rows (x, y, z, width) the thinnest in each cube of side `block`, thinnest first."""
    places = places[np.argsort(places[:, 3], kind="stable")]
    _, first = np.unique(np.floor((places[:, :3] - lower) / block).astype(int), axis=0, return_index=True)
    return places[np.sort(first)]


def thin_places(points, triangles, thinner, lower, block):
    """Middles of ways through the solid, or through the outside, that are shorter than `thinner`, between faces that
    look away from or at each other; and their lengths. Looked for along the normals of points all over the faces, half
    that apart. The thinnest in each cube of side `block`, thinnest first."""
    corners = points[triangles]
    along = corners[:, 1:] - corners[:, :1]
    normals = np.cross(along[:, 0], along[:, 1])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals / np.where(lengths > 0, lengths, 1)[:, None]
    least = 1e-7 * np.ptp(points, axis=0).max()
    middles = corners.mean(axis=1)
    radii = np.linalg.norm(corners - middles[:, None], axis=2).max(axis=1)
    tree = cKDTree(middles)
    found, rows = [np.zeros((0, 4))], 0
    for t in range(len(triangles)):
        near = np.array(tree.query_ball_point(middles[t], radii[t] + radii.max() + thinner))
        near = near[(normals[near] @ normals[t] < -0.5)
                    & (np.linalg.norm(middles[near] - middles[t], axis=1) <= radii[near] + radii[t] + thinner)]
        if len(near) == 0:  # most have none near that looks the other way
            continue
        longest = np.linalg.norm(corners[t] - np.roll(corners[t], 1, 0), axis=1).max()
        parts = min(40, int(np.ceil(longest / (thinner / 2))))
        u, v = (g.ravel() for g in np.meshgrid(np.arange(parts), np.arange(parts)))
        at = corners[t, 0] + (np.stack([u, v], 1)[u + v < parts] + 1 / 3) / parts @ along[t]
        # Where lines along the normal meet the others (Moeller and Trumbore 1997).
        first, second = along[near, 0], along[near, 1]
        across = np.cross(normals[t], second)
        inverse = 1 / (first * across).sum(axis=1)
        to = at[:, None] - corners[near, 0]
        turned = np.cross(to, first)
        a, b = (to * across).sum(axis=2) * inverse, turned @ normals[t] * inverse
        width = (turned * second).sum(axis=2) * inverse
        point, _ = hit = np.nonzero((a >= 0) & (b >= 0) & (a + b <= 1) & (np.abs(width) > least)
                                    & (np.abs(width) <= thinner))
        found.append(np.column_stack([at[point] + width[hit][:, None] / 2 * normals[t], np.abs(width[hit])]))
        rows += len(point)
        if rows > 500000:
            found = [thinnest_by_block(np.concatenate(found), lower, block)]
            rows = len(found[0])
    return thinnest_by_block(np.concatenate(found), lower, block)


def inside_mesh(points, triangles, centres_x, centres_y, centres_z):
    """Whether the centres of a small grid lie in a closed mesh: parity of crossings along x."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    near = ((high[:, 1] >= centres_y[0]) & (low[:, 1] <= centres_y[-1]) & (high[:, 2] >= centres_z[0]) &
            (low[:, 2] <= centres_z[-1])
            & (low[:, 0] <= centres_x[-1]))
    inside = np.zeros((len(centres_x), len(centres_y), len(centres_z)), bool)
    for a, b, c in corners[near]:
        area = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
        if area == 0:
            continue
        ys = slice(np.searchsorted(centres_y, min(a[1], b[1], c[1])),
                   np.searchsorted(centres_y, max(a[1], b[1], c[1]), "right"))
        zs = slice(np.searchsorted(centres_z, min(a[2], b[2], c[2])),
                   np.searchsorted(centres_z, max(a[2], b[2], c[2]), "right"))
        y, z = centres_y[ys][:, None], centres_z[zs][None, :]
        u = ((y - a[1]) * (c[2] - a[2]) - (z - a[2]) * (c[1] - a[1])) / area
        v = ((b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1])) / area
        crossed = (u >= 0) & (v >= 0) & (u + v < 1)
        x = a[0] + u * (b[0] - a[0]) + v * (c[0] - a[0])
        inside[:, ys, zs] ^= crossed[None] & (centres_x[:, None, None] > x[None])
    return inside


def hangs_together(block):
    """Pieces of the solid over faces, of the outside over corners, and the Euler number of the open shape in a
    block."""
    from scipy.ndimage import label

    b = block.astype(np.int64)
    chi = b.sum()
    pair = lambda x, axis: x.take(range(x.shape[axis] - 1), axis) * x.take(range(1, x.shape[axis]), axis)  # noqa: E731
    for axis in range(3):
        chi -= pair(b, axis).sum()
        chi += pair(pair(b, axis), (axis + 1) % 3).sum()
    chi -= pair(pair(pair(b, 0), 1), 2).sum()
    return label(block)[1], label(~block, np.ones((3, 3, 3)))[1], int(chi)


def difference(voxels, step, points, triangles, middle, reach):
    """In how much the voxels within `reach` of a voxel hang together otherwise than the mesh does, which is looked at
    with four times as many."""
    low, size, fine = middle - reach, 2 * reach + 1, 4
    grid = np.pad(voxels[tuple(slice(max(0, l), max(0, l + size)) for l in low)],
                  [(max(0, -l), max(0, l + size - n)) for l, n in zip(low, voxels.shape)])
    lower = points.min(axis=0)
    centres = [lower[a] + (low[a] + (np.arange(size * fine) + 0.5) / fine) * step for a in range(3)]
    mesh = inside_mesh(points, triangles, *centres)
    return [ours - theirs for ours, theirs in zip(hangs_together(grid), hangs_together(mesh))]


def wrong_place(voxels, step, points, triangles):
    """The thinnest place around which voxels and mesh hang together otherwise, by as much within 9 x 9 x 9 voxels as
    within 13 x 13 x 13, so that it does not lie at the rim of these: which of the thin places that is, one in each
    block of 4^3 voxels and the thinnest first, how many there are, and how thin it is, in voxels. None if it is none of
    MOST."""
    lower = points.min(axis=0)
    thin = thin_places(points, triangles, THIN * step, lower, 4 * step)
    for i, middle in enumerate(np.floor((thin[:MOST, :3] - lower) / step).astype(int)):
        near = difference(voxels, step, points, triangles, middle, 4)
        if any(near) and near == difference(voxels, step, points, triangles, middle, 6):
            return i + 1, len(thin), thin[i, 3] / step
    return None


def read_nrrd(path):
    """Booleans [i, j, k] of a volume that voxelcore wrote."""
    import gzip

    with open(path, "rb") as file:
        data = file.read()
    head, body = data.split(b"\n\n", 1)
    size = [int(n) for n in head.split(b"sizes: ")[1].split(b"\n")[0].split()]
    return np.frombuffer(gzip.decompress(body), np.uint8).reshape(size, order="F") > 0


def tanglecube(path, resolution):
    """x^4 - 5x^2 + y^4 - 5y^2 + z^4 - 5z^2 < level, turned."""
    a, b, c = 0.5, 0.35, 0.2
    turn = (np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
            @ np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
            @ np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]]))
    reach = 4.2
    step = 2 * reach / resolution
    axis = -reach + (np.arange(resolution) + 0.5) * step
    voxels = np.zeros((resolution,) * 3, bool)
    level = -12.4  # twelve necks of radius 0.1 between eight bulbs; they part at -12.5
    for k, height in enumerate(axis):
        local = axis[:, None, None] * turn[0] + axis[None, :, None] * turn[1] + height * turn[2]
        voxels[:, :, k] = (local ** 4 - 5 * local ** 2).sum(axis=2) < level
    write_nrrd(path, voxels, step)


def numbers(topology):
    return f"{topology['euler']}: {'/'.join(map(str, topology['betti']))}"


def caption(panel, name, n, euler, pieces, right):
    """As in the paper: resolution, Euler number and pieces, red where they are not the mesh's."""
    panel.set_title(f"{name} {n}: Euler {euler}, CC {pieces}", fontsize=7, pad=2, color="black" if right else "red")


class Result:
    """A shape at a resolution: the table's row, a picture, and what must hold."""

    def __init__(self, name, n, expected, closed, report, painted):
        label = report["labels"][0]
        shape, found = label["shape"], label["core"]
        self.painted = painted
        self.equal = shape == {k: found[k] for k in ("euler", "betti")}
        self.certified = label["certificate"]["passed"]
        self.right = shape["betti"] == [*expected, 0]
        self.euler, self.pieces = found["euler"], found["betti"][0]
        self.traced = True
        self.row = [
            name, "/".join(map(str, expected)) + ("" if closed else " (not a manifold)"), n,
            numbers(shape),
            numbers(found), "equal" if self.equal else "DIFFERENT", "right" if self.right else "wrong", ""
        ]

    def __getitem__(self, _):  # what Kept prints
        return self.row


def of_mesh(options, meshes, name, n):
    points, triangles = read_off(meshes.path(name))
    pieces, genus, closed = topology_of_mesh(points, triangles)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "core.vtp")
        report = core(options.program, meshes.path(name), folder, "--resolution", n, "--lambda", "2.5%", "-o", out)
        result = Result(name, n, (pieces, genus), closed, report, paint(Core(out), standing_view(points), pixels=210))
        if not result.right and closed:
            scan = os.path.join(folder, "voxels.nrrd")
            run(options.program, "voxelize", meshes.path(name), "--resolution", n, "-o", scan, "--force", "-q")
            step = report["input"]["spacing_mm"][0]
            place = wrong_place(read_nrrd(scan), step, points, triangles)
            result.traced = place is not None
            if result.traced:
                result.row[-1] = f"place {place[0]} of {place[1]} thinner than {THIN} voxels, {place[2]:.2f} thin"
        return result


def of_tanglecube(options, n):
    with tempfile.TemporaryDirectory() as folder:
        scan, out = os.path.join(folder, "tanglecube.nrrd"), os.path.join(folder, "core.vtp")
        tanglecube(scan, n)
        report = core(options.program, scan, folder, "--lambda", "3%", "-o", out)
        return Result("tanglecube, turned", n, (1, 5), True, report, paint(Core(out), pixels=330))


def main():
    options = arguments(__doc__, "256,512,768", "48")
    kept = Kept(options, "figure-10")
    meshes = Meshes(options.meshes)
    names = NAMES[:2] if options.small else NAMES
    results = []

    def add(result, panel, name, n):
        results.append(result)
        hang(panel, result.painted)
        caption(panel, name, n, result.euler, result.pieces, result.right)

    figure, sides = plt.subplots(1, 2, figsize=(6.4, 3.3))
    for panel, n in zip(sides, (48, 64) if options.small else (256, 512)):
        add(kept.get(f"tanglecube {n}", lambda: of_tanglecube(options, n)), panel, "tanglecube", n)
        require(results[-1].right or n < 256, "the tanglecube keeps its twelve connections at 256")
    save(figure, options.output, "figure-12")
    pictures, panels = plt.subplots(len(names), len(options.resolutions), squeeze=False,
                                    figsize=(2.3 * len(options.resolutions), 1.7 * len(names)))
    for name, line in zip(names, panels):
        for n, panel in zip(options.resolutions, line):
            add(kept.get(f"{name} {n}", lambda: of_mesh(options, meshes, name, n)), panel, name, n)
    save(pictures, options.output, "figure-10")
    write_table(options.output, "figure-10",
                ["shape", "mesh: pieces/genus", "resolution", "voxels chi: b0/b1/b2", "core chi: b0/b1/b2",
                 "core and voxels", "against the mesh", "traced to"], [one.row for one in results])
    for one in results:
        what = f"{one.row[0]} at {one.row[2]}: "
        require(one.equal, what + "the core has the voxels' topology")
        require(one.certified, what + "certificate")
        require(one.traced, what + f"its topology is wrong, and a place thinner than {THIN} voxels is to blame")


if __name__ == "__main__":
    main()
