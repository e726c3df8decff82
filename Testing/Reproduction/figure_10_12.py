#!/usr/bin/env python3
"""Figures 10 and 12: topology of the core against that of the mesh, and of a tanglecube with thin connections."""

import os
import tempfile

import numpy as np

from common import Meshes, arguments, core, plt, require, run, save, write_nrrd, write_table

NAMES = ["elephant", "elk", "femur", "hand", "cheese", "armadillo", "dragknob", "rotor"]
THIN = 1.16  # voxels: thinner places may be lost or joined


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


def thinnest(points, triangles):
    """Shortest way through the solid, and through the outside, between faces that look away from or at each other."""
    import vtk

    data = vtk.vtkPolyData()
    places, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    places.SetDataTypeToDouble()
    for p in points:
        places.InsertNextPoint(p)
    for t in triangles:
        cells.InsertNextCell(3, [int(v) for v in t])
    data.SetPoints(places)
    data.SetPolys(cells)
    tree = vtk.vtkOBBTree()
    tree.SetDataSet(data)
    tree.BuildLocator()
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    size = np.ptp(points, axis=0).max()
    normals = normals / np.where(lengths > 0, lengths, 1)[:, None]
    middles = corners.mean(axis=1)
    shortest = [np.inf, np.inf]
    hits, ids = vtk.vtkPoints(), vtk.vtkIdList()
    for t in range(len(triangles)):
        for side, sign in ((0, -1), (1, 1)):
            start = middles[t] + sign * 1e-7 * size * normals[t]
            reach = min(shortest[side], size)
            tree.IntersectWithLine(start, start + sign * reach * normals[t], hits, ids)
            for h in range(hits.GetNumberOfPoints()):
                other = ids.GetId(h)
                if other != t and normals[t] @ normals[other] < -0.5:
                    shortest[side] = min(shortest[side], np.linalg.norm(np.array(hits.GetPoint(h)) - middles[t]))
    return shortest


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


def main():
    options = arguments(__doc__, "256,512,768", "48")
    meshes = Meshes(options.meshes)
    names = NAMES[:2] if options.small else NAMES
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "core.vtp")
        for name in names:
            points, triangles = read_off(meshes.path(name))
            pieces, genus, closed = topology_of_mesh(points, triangles)
            thin = None
            for n in options.resolutions:
                report = core(options.program, meshes.path(name), folder, "--resolution", n, "--lambda", "2.5%", "-o", out)
                label = report["labels"][0]
                step = report["input"]["spacing_mm"][0]
                shape = label["shape"]
                require(shape == {k: label["core"][k] for k in ("euler", "betti")}, f"{name}: the core has the voxels' topology")
                require(label["certificate"]["passed"], f"{name}: certificate")
                right = shape["betti"] == [pieces, genus, 0]
                why = ""
                if not right:
                    thin = thin or thinnest(points, triangles)
                    why = f"walls {thin[0] / step:.2f}, gaps {thin[1] / step:.2f} voxels at the thinnest"
                rows.append([name, f"{pieces}/{genus}" + ("" if closed else " (not a manifold)"), n, numbers(shape),
                             numbers(label["core"]), "equal", "right" if right else "wrong", why])
                require(right or min(thin) / step < THIN or not closed, f"{name} at {n}: {why}")
        scan = os.path.join(folder, "tanglecube.nrrd")
        n = 64 if options.small else 256
        tanglecube(scan, n)
        report = core(options.program, scan, folder, "--lambda", "2.5%", "-o", out)
        label = report["labels"][0]
        shape = label["shape"]
        require(shape == {k: label["core"][k] for k in ("euler", "betti")}, "tanglecube: the core has the voxels' topology")
        rows.append(["tanglecube, turned", "1/5", n, numbers(shape), numbers(label["core"]), "equal",
                     "right" if shape["betti"] == [1, 5, 0] else "wrong", ""])
        run(options.program, "render", out, "--scan", scan, "-o", os.path.join(options.output, "figure-12-tanglecube.png"),
            "--size", "900x700", "--force")
    write_table(options.output, "figure-10",
                ["shape", "mesh: pieces/genus", "resolution", "voxels chi: b0/b1/b2", "core chi: b0/b1/b2",
                 "core and voxels", "against the mesh", "traced to"], rows)


if __name__ == "__main__":
    main()
