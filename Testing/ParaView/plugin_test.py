"""The plugin's three filters on a real scan, in ParaView: the arrays of the program's files, bit for bit, by the
program and by the Python package.
usage: plugin_test.py PLUGIN.xml PROGRAM SCAN.nii.gz LABEL FOLDER WAY    SCAN: uint8; WAY: program or package"""

import gzip
import shutil
import struct
import subprocess
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataReader

plugin, program, scan, label, folder, way = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False)
chosen = program if way == "program" else ""
assert way == "program" or not shutil.which("voxelcore")

# Debian's ParaView reads no NIfTI. The place is none of the scan's: a shifted one finds more faults.
with gzip.open(scan) as file:
    data = file.read()
sizes = struct.unpack_from("<3h", data, 42)
assert struct.unpack_from("<h", data, 70)[0] == 2
image = vtkImageData()
image.SetDimensions(sizes)
image.SetSpacing(struct.unpack_from("<3f", data, 80))
image.SetOrigin(-90.5, 12, 7)
values = numpy_to_vtk(numpy.frombuffer(data, numpy.uint8, offset=int(struct.unpack_from("<f", data, 108)[0])), deep=1)
values.SetName("labels")
image.GetPointData().SetScalars(values)
writer = vtkXMLImageDataWriter()
writer.SetInputData(image)
writer.SetFileName(f"{folder}/image.vti")
writer.Write()
opened = simple.OpenDataFile(f"{folder}/image.vti")
opened.UpdatePipeline()


def program_makes(command, name, *options, labels=label):
    path = f"{folder}/{name}"
    subprocess.run([program, command, f"{folder}/image.vti", "--labels", labels, *options, "-o", path, "--force", "-q"],
                   check=True)  # fmt: skip
    return path


def arrays(data, of_points=True):
    attributes = data.GetPointData() if of_points else data.GetCellData()
    each = [attributes.GetArray(number) for number in range(attributes.GetNumberOfArrays())]
    return {array.GetName(): vtk_to_numpy(array) for array in each}


def same_surface(made, path, wanted, but=()):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    theirs = reader.GetOutput()
    assert made.GetNumberOfPoints() == theirs.GetNumberOfPoints() > 10
    assert numpy.array_equal(vtk_to_numpy(made.GetPoints().GetData()), vtk_to_numpy(theirs.GetPoints().GetData()))
    for kind in ("Verts", "Lines", "Polys"):
        ours, others = (getattr(data, f"Get{kind}")() for data in (made, theirs))
        assert numpy.array_equal(vtk_to_numpy(ours.GetConnectivityArray()), vtk_to_numpy(others.GetConnectivityArray()))
    for of_points in (True, False):
        ours, others = arrays(made, of_points), arrays(theirs, of_points)
        assert set(ours) == set(others) and (not of_points or wanted <= set(ours)), set(ours) ^ set(others)
        for name in set(ours) - set(but):
            assert ours[name].dtype == others[name].dtype and numpy.array_equal(ours[name], others[name]), name
    print(f"{way}: {made.GetNumberOfPoints()} points, {made.GetNumberOfCells()} cells, arrays {sorted(arrays(made))}")


def run(make, of=opened, **values):
    made = make(Input=of)
    made.Label, made.Program = int(label), chosen
    for name, value in values.items():
        setattr(made, name, value)
    made.UpdatePipeline()
    return servermanager.Fetch(made)


for height in (1.2, 3.0):
    path = program_makes("core", "core.vtp", "--tolerance", f"{height}diag")
    same_surface(run(simple.VoxelCore, Tolerance=height), path, {"Radius"})
same_surface(run(simple.CurveSkeleton), program_makes("skeleton", "skeleton.vtp"), {"Radius"})
thickness = run(simple.LocalThickness)
read = simple.OpenDataFile(program_makes("thickness", "thickness.nrrd"))
read.UpdatePipeline()
theirs = vtk_to_numpy(servermanager.Fetch(read).GetPointData().GetScalars())
ours = vtk_to_numpy(thickness.GetPointData().GetArray("Thickness"))
assert numpy.array_equal(ours, theirs) and ours.max() > 1
assert thickness.GetDimensions() == servermanager.Fetch(opened).GetDimensions()
print(f"{way}: thickness up to {ours.max():.2f} in {(ours > 0).sum()} voxels")

# A part of it, whose voxels begin elsewhere, as grey values, and every label by itself.
part = simple.ExtractSubset(Input=opened, VOI=[45, 80, 60, 150, 30, 80])
crop = ("--crop", "45:81,60:151,30:81")
grey = program_makes("core", "grey.vtp", *crop, "--threshold", f"{label}:{label}", labels="all")
same_surface(run(simple.VoxelCore, of=part, UseThreshold=1, Threshold=[int(label)] * 2), grey, {"Radius"})
every = program_makes("core", "every.vtp", *crop, labels="all")
# What never goes has a Tolerance above all others of its file: in one of several labels above those of all of them.
same_surface(run(simple.VoxelCore, of=part, Label=0), every, {"Radius"}, ["Tolerance"] if way == "package" else [])

# What cannot be is said in a line, and the output is empty.
wrong = simple.VoxelCore(Input=opened)
wrong.Label, wrong.Program = int(label), "/nowhere/voxelcore"
wrong.UpdatePipeline()
assert servermanager.Fetch(wrong).GetNumberOfPoints() == 0
print("done")
