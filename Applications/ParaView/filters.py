# What each filter of the plugin runs. ParaView's programmable filters make a function's body of it, where `self` is the
# filter and its properties are names; CMake puts it into VoxelCore.xml, after a line that sets COMMAND and OPTIONS.
# The program voxelcore computes; where there is none, the Python package, if ParaView's Python has it.
import json
import os
import shutil
import subprocess
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

TYPES = {"u1": "uint8", "i1": "int8", "u2": "uint16", "i2": "int16", "u4": "uint32", "i4": "int32", "u8": "uint64",
         "i8": "int64", "f4": "float", "f8": "double"}


class Scan:
    """Voxels [k, j, i] of an image, and where they lie; ParaView's coordinates are taken as LPS mm."""

    def __init__(self, image, name):
        array = image.GetPointData().GetArray(name) if name else image.GetPointData().GetScalars()
        if array is None or array.GetNumberOfComponents() != 1:
            raise ValueError("choose an array of the image's points that has one number a voxel")
        self.voxels = vtk_to_numpy(array).reshape(image.GetDimensions()[::-1])
        self.spacing = numpy.array(image.GetSpacing())
        matrix = image.GetDirectionMatrix()
        self.direction = numpy.array([[matrix.GetElement(row, column) for column in range(3)] for row in range(3)])
        first = numpy.array(image.GetExtent()[::2])  # of what is cut out of an image, voxels begin elsewhere
        self.origin = numpy.array(image.GetOrigin()) + self.direction @ (first * self.spacing)

    def write(self, path):
        def vector(values):
            return "(" + ",".join(repr(float(value)) for value in values) + ")"

        voxels = self.voxels.astype(self.voxels.dtype.newbyteorder("<"))
        columns = " ".join(vector(self.direction[:, axis] * self.spacing[axis]) for axis in range(3))
        with open(path, "wb") as file:
            file.write(
                (
                    f"NRRD0004\ntype: {TYPES[voxels.dtype.str[1:]]}\ndimension: 3\nspace: left-posterior-superior\n"
                    f"sizes: {' '.join(map(str, reversed(voxels.shape)))}\nspace directions: {columns}\n"
                    f'space units: "mm" "mm" "mm"\nkinds: domain domain domain\nendian: little\nencoding: raw\n'
                    f"space origin: {vector(self.origin)}\n\n"
                ).encode()
            )
            file.write(voxels.tobytes())


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def by_package(package, command, scan, options):
    """vtkPolyData, or of thickness the values [k, j, i]."""
    place = {"axes": "kji", "spacing": scan.spacing, "progress": lambda stage, part: self.UpdateProgress(part)}
    if command == "thickness":
        return package.thickness(scan.voxels, **place, **options).map
    place.update(origin=scan.origin, direction=scan.direction)
    if command == "core":
        found = package.core(scan.voxels, **place, **options)
        results = list(found.values()) if isinstance(found, dict) else [found]
    else:
        # A skeleton is of one label.
        labels = [options.pop("label", None)]
        if labels == ["all"]:
            labels = [int(value) for value in numpy.unique(scan.voxels) if value]
        results = [package.skeleton(scan.voxels, label=label, **place, **options) for label in labels]
    together = vtkAppendPolyData()
    with tempfile.TemporaryDirectory(prefix="VoxelCore-") as folder:
        for number, one in enumerate(results):
            path = os.path.join(folder, f"{number}.vtp")
            one.save(path)  # whose arrays are those of the program
            together.AddInputData(read(path))
    together.Update()
    return together.GetOutput()


def by_program(program, command, scan, options):
    """As by_package, from the files of a process."""
    with tempfile.TemporaryDirectory(prefix="VoxelCore-") as folder:
        volume = os.path.join(folder, "image.nrrd")
        output = os.path.join(folder, "out.nii" if command == "thickness" else "out.vtp")
        scan.write(volume)
        words = [program, command, volume, "-o", output, "--progress", "json"]
        for name, value in options.items():
            name = {"label": "labels"}.get(name, name).replace("_", "-")
            value = f"{value[0]!r}:{value[1]!r}" if isinstance(value, tuple) else str(value)
            words += ["--" + name] + ([] if value == "True" else [value])
        said = []
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace")  # fmt: skip
        for line in process.stderr:
            if line.startswith("{"):
                self.UpdateProgress(float(json.loads(line)["fraction"]))
            elif line.strip():
                said.append(line.strip())
        if process.wait() != 0:
            raise ValueError((said or ["the program ended without a word"])[-1].replace(volume, "the image"))
        if command == "thickness":
            values = numpy.fromfile(output, "<f4", offset=352)  # NIfTI's header, and floats to the file's end
            return values.reshape(scan.voxels.shape)
        return read(output)


def result(command, scan, options):
    options["label"] = "all" if Label == 0 else int(Label)
    if UseThreshold:
        options["threshold"] = (float(Threshold[0]), float(Threshold[1]))
        del options["label"]
    program = shutil.which(Program or "voxelcore")
    if program:
        return by_program(program, command, scan, options)
    if Program:
        raise ValueError(f"{Program}: it is no program; choose voxelcore, or leave Program empty")
    try:
        import voxelcore
    except ImportError:
        raise ValueError("neither the program voxelcore nor its Python package is here; install VoxelCore, then "
                         "choose the program under Program") from None  # fmt: skip
    return by_package(voxelcore, command, scan, options)


image, output = self.GetInputDataObject(0, 0), self.GetOutputDataObject(0)
try:
    found = result(COMMAND, Scan(image, Scalars), OPTIONS)
except (ValueError, OSError, RuntimeError, MemoryError) as error:
    output.Initialize()
    vtkOutputWindow.GetInstance().DisplayErrorText(f"voxelcore: {error}\n")
    return
if COMMAND != "thickness":
    output.ShallowCopy(found)
    return
output.CopyStructure(image)
array = numpy_to_vtk(numpy.ascontiguousarray(found, numpy.float32).ravel(), deep=1)
array.SetName("Thickness")
output.GetPointData().SetScalars(array)
