#!/usr/bin/python3
"""How thick refined cores say that oblique flat walls are: twice the radius less the truth, in short voxels.

usage: oblique_walls.py VOXELCORE [SEED [WALLS]]      (python3-numpy, python3-vtk9)

Walls are discs in random directions; what is within six voxels and its thickness of a disc's rim is left out. Of each
thickness: the mean over all walls, and the wall that is farthest off.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

THICKNESSES = (3, 4, 5, 5.5, 6, 7, 8, 10)
RADIUS, SIDE, RIM = 30, 70, 6


def write(path, voxels, spacing):
    header = (f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {' '.join(map(str, voxels.shape))}\n"
              f"spacings: {' '.join(map(str, spacing))}\nencoding: raw\n\n")
    path.write_bytes(header.encode() + voxels.astype("uint8").tobytes(order="F"))


def points_and_radii(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    core = reader.GetOutput()
    return vtk_to_numpy(core.GetPoints().GetData()), vtk_to_numpy(core.GetPointData().GetArray("Radius"))


def error(program, folder, random, thickness, spacing):
    normal = random.normal(size=3)
    normal /= numpy.linalg.norm(normal)
    size = (SIDE / numpy.array(spacing)).astype(int)
    centre = size * spacing / 2 + random.uniform(-0.5, 0.5, 3)
    from_centre = [axis * step - at for axis, step, at in zip(numpy.indices(size), spacing, centre)]
    away = sum(part * along for part, along in zip(normal, from_centre))
    squared = sum(part**2 for part in from_centre)
    write(folder / "wall.nrrd", (abs(away) < thickness / 2) & (squared < RADIUS**2), spacing)
    subprocess.run([program, "core", folder / "wall.nrrd", "-o", folder / "wall.vtp", "--force", "--quiet"], check=True)
    points, radii = points_and_radii(folder / "wall.vtp")
    inner = ((abs(points) - centre) ** 2).sum(axis=1) < (RADIUS - RIM - thickness) ** 2  # points are in LPS or RAS
    return 2 * radii[inner].mean() - thickness


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    walls = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    random = numpy.random.default_rng(seed)
    print(f"seed {seed}, {walls} walls each\n\n| spacing | thickness | mean | worst |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for spacing in (1, 1, 1), (1, 1, 2.5):
            for thickness in THICKNESSES:
                errors = [error(program, pathlib.Path(folder), random, thickness, spacing) for _ in range(walls)]
                mean, worst = numpy.mean(errors), max(errors, key=abs)
                print(f"| {spacing} | {thickness} | {mean:+.3f} | {worst:+.3f} |", flush=True)


if __name__ == "__main__":
    main()
