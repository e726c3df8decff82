#!/usr/bin/python3
"""Whether rims of refined cores are curves, and whether they still end where the known axis does.

usage: rim_turns.py VOXELCORE            known bodies, askew in the grid, at the default tolerance, each 64 voxels wide
       rim_turns.py CORE.vtp...          the rims of files alone                  (python3-numpy, python3-vtk9)

A rim vertex is one at which two edges of one face each meet. Lines on no face that end freely and are shorter than two
voxel diagonals are hairs. Forward: from the core's vertices to the axis; backward: from places on the axis, whose balls
a tolerance needs, to the core. Voxels.
"""
import collections
import itertools
import pathlib
import subprocess
import sys
import tempfile

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIDE, MIDDLE = 64, 32.3
AXES = numpy.array([[0.8174, 0.4417, 0.3697], [-0.5683, 0.7221, 0.3938], [-0.0930, -0.5320, 0.8416]])
DIAGONAL = 3 ** 0.5
TOLERANCE = 1.2 * DIAGONAL  # the default
SHARP = 60  # degrees


def load(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def cells(array):
    if array.GetNumberOfCells() == 0:
        return []
    return numpy.split(vtk_to_numpy(array.GetConnectivityArray()), vtk_to_numpy(array.GetOffsetsArray())[1:-1])


def pairs(corners):
    return [tuple(sorted(pair)) for pair in zip(corners.tolist(), numpy.roll(corners, -1).tolist())]


def rim_angles(points, faces):
    """By how many degrees the rim turns at each of its vertices."""
    used = collections.Counter(pair for face in faces for pair in pairs(face))
    beside = collections.defaultdict(list)
    for (a, b), count in used.items():
        if count == 1:
            beside[a].append(b)
            beside[b].append(a)
    angles = []
    for vertex, ends in beside.items():
        if len(ends) == 2:
            to, on = points[vertex] - points[ends[0]], points[ends[1]] - points[vertex]
            cosine = to @ on / max(numpy.linalg.norm(to) * numpy.linalg.norm(on), 1e-300)
            angles.append(numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1))))
    return numpy.array(angles)


def hair_lengths(points, faces, lines):
    """Of all lines on no face from their free end to where they hang on more than a line."""
    beside = collections.defaultdict(list)
    for line in lines:
        for a, b in zip(line[:-1].tolist(), line[1:].tolist()):
            beside[a].append(b)
            beside[b].append(a)
    on_faces = {corner for face in faces for corner in face.tolist()}
    lengths = []
    for tip, ends in beside.items():
        if len(ends) != 1 or tip in on_faces:
            continue
        last, at = tip, ends[0]
        length = numpy.linalg.norm(points[at] - points[last])
        while len(beside[at]) == 2 and at not in on_faces:
            last, at = at, next(end for end in beside[at] if end != last)
            length += numpy.linalg.norm(points[at] - points[last])
        if len(beside[at]) > 1 or at in on_faces:
            lengths.append(length)
    return numpy.array(lengths)


def rims(core):
    points = vtk_to_numpy(core.GetPoints().GetData()).astype(float)
    faces, lines = cells(core.GetPolys()), cells(core.GetLines())
    angles, hairs = rim_angles(points, faces), hair_lengths(points, faces, lines)
    sharp = 100 * (angles > SHARP).mean() if len(angles) else 0.0
    return f"{len(faces)} | {len(angles)} | {sharp:.1f} | {int((hairs < 2 * DIAGONAL).sum())}"


def surface_of(faces):
    """Triangles of a known axis as a surface to measure to."""
    data, points, polygons = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(numpy.concatenate(faces), deep=True))
    for first in range(0, 3 * len(faces), 3):
        polygons.InsertNextCell(3)
        for corner in range(first, first + 3):
            polygons.InsertCellPoint(corner)
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def distances(places, surface):
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    closest, cell, part, squared = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    found = []
    for place in places:
        locator.FindClosestPoint(place, closest, cell, part, squared)
        found.append(float(squared) ** 0.5)
    return numpy.array(found)


def disc(a, b):
    """An elliptic disc across the last axis."""
    turns = numpy.linspace(0, 2 * numpy.pi, 721)
    rim = numpy.stack([a * numpy.cos(turns), b * numpy.sin(turns), 0 * turns], axis=1)
    return [numpy.array([[0, 0, 0], one, other]) for one, other in zip(rim[:-1], rim[1:])]


def box_sheets(half):
    """The medial sheets of a box with these half sides, the last of which is the least, out to its edges."""
    inner = numpy.array(half) - half[2]
    polygons = [[(x * inner[0], y * inner[1], 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]]
    for axis, other in ((0, 1), (1, 0)):
        for side, up in itertools.product((-1, 1), (-1, 1)):
            sheet = []
            for along, out in ((-1, False), (1, False), (1, True), (-1, True)):
                place = [0.0, 0.0, up * half[2] * out]
                place[axis] = side * (half[axis] if out else inner[axis])
                place[other] = along * (half[other] if out else inner[other])
                sheet.append(tuple(place))
            polygons.append(sheet)
    for x, y in itertools.product((-1, 1), (-1, 1)):
        corner = [(x * half[0], y * half[1], up * half[2]) for up in (-1, 1)]
        polygons.append([(x * inner[0], y * inner[1], 0), *corner])
    return [numpy.array([p[0], p[i], p[i + 1]], float) for p in polygons for i in range(1, len(p) - 1)]


def bodies():
    """Of each its name, whether it holds places, its known axis, and places on it that a tolerance needs."""
    turns = numpy.linspace(0, 2 * numpy.pi, 721)[:-1]
    a, b, c = 29, 19, 12
    # Toward each place of the equator the last ball that leaves it no farther off than the tolerance.
    equator = numpy.stack([a * numpy.cos(turns), b * numpy.sin(turns)])
    rim = equator * (1 - c * c / numpy.array([[a * a], [b * b]]))
    scales = numpy.linspace(0, 1, 1001)[:, None]
    radii = numpy.sqrt(scales**2 * ((equator - rim)**2).sum(axis=0) + c * c * (1 - scales**2))
    gaps = numpy.sqrt(((equator - scales[:, None] * rim)**2).sum(axis=1)) - radii
    needed = numpy.stack([*(scales[(gaps <= TOLERANCE).argmax(axis=0), 0] * rim), 0 * turns], axis=1)
    axis = disc((a * a - c * c) / a, (b * b - c * c) / b)
    yield "ellipsoid", lambda x, y, z: (x / a)**2 + (y / b)**2 + (z / c)**2 <= 1, axis, needed
    # What two balls share.
    radius, off = 38, 26
    edge = (radius**2 - off**2) ** 0.5
    reach = next((r for r in numpy.linspace(0, edge, 10001)
                  if edge - r - (radius - numpy.hypot(r, off)) <= TOLERANCE), edge)
    needed = reach * numpy.stack([numpy.cos(turns), numpy.sin(turns), 0 * turns], axis=1)
    yield ("lens", lambda x, y, z: x * x + y * y + (abs(z) + off)**2 <= radius * radius, disc(edge, edge), needed)
    half = (25, 17, 7)
    corner = TOLERANCE / (3**0.5 - 1)  # the radius of the last ball on the way to a corner
    needed = numpy.array([numpy.array(signs) * (numpy.array(half) - r)
                          for signs in itertools.product((-1, 1), repeat=3) for r in (half[2], corner)])
    yield ("box", lambda x, y, z: (abs(x) <= half[0]) & (abs(y) <= half[1]) & (abs(z) <= half[2]), box_sheets(half),
           needed)


def known_bodies(program):
    print("| body | faces | rim vertices | turn > 60 degrees, % | hairs | forward, mean | forward, largest | "
          "backward, mean | backward, largest |\n|---|---|---|---|---|---|---|---|---|")
    from_middle = numpy.stack(numpy.indices((SIDE, SIDE, SIDE)), axis=-1) + 0.5 - MIDDLE
    along = numpy.moveaxis(from_middle @ AXES.T, -1, 0)
    with tempfile.TemporaryDirectory() as folder:
        scan, file = pathlib.Path(folder) / "body.nrrd", pathlib.Path(folder) / "body.vtp"
        for name, holds, axis, needed in bodies():
            header = f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {SIDE} {SIDE} {SIDE}\nspacings: 1 1 1\n" \
                     "encoding: raw\n\n"
            scan.write_bytes(header.encode() + holds(*along).astype("uint8").tobytes(order="F"))
            subprocess.run([program, "core", scan, "-o", file, "--force", "--quiet"], check=True)
            core = load(file)
            points = vtk_to_numpy(core.GetPoints().GetData()).astype(float)
            # A file without orientation has its voxels' centres at their indices.
            local = (points + 0.5 - MIDDLE) @ AXES.T
            core.GetPoints().SetData(numpy_to_vtk(local, deep=True))
            forward, backward = distances(local, surface_of(axis)), distances(needed, core)
            print(f"| {name} | {rims(core)} | {forward.mean():.3f} | {forward.max():.2f} | {backward.mean():.3f} | "
                  f"{backward.max():.2f} |", flush=True)


def main():
    if len(sys.argv) == 2 and not sys.argv[1].endswith(".vtp"):
        known_bodies(str(pathlib.Path(sys.argv[1]).resolve()))
        return
    print("| file | faces | rim vertices | turn > 60 degrees, % | hairs |\n|---|---|---|---|---|")
    for path in sys.argv[1:]:
        print(f"| {pathlib.Path(path).name} | {rims(load(path))} |")


if __name__ == "__main__":
    main()
