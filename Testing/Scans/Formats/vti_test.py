"""Image data that VTK writes: types, byte orders, text, base64 and raw, packed or not, values of points and of cells,
several arrays, and places; and what is refused.

usage: vti_test.py DUMP_PROGRAM      exit 77: VTK or NumPy is not there
"""
import itertools
import pathlib
import sys
import tempfile

try:
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
except ImportError as missing:
    print(missing)
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume

TYPES = ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8")


def image_of(values, spacing=(1, 1, 1), origin=(0, 0, 0), of_cells=False, name="labels", first=(0, 0, 0)):
    """`values[i, j, k]`."""
    image = vtkImageData()
    more = 1 if of_cells else 0
    image.SetExtent(*[int(x) for a in range(3) for x in (first[a], first[a] + values.shape[a] - 1 + more)])
    image.SetSpacing(*[float(x) for x in spacing])
    image.SetOrigin(*[float(x) for x in origin])
    add(image, values, of_cells, name)
    return image


def add(image, values, of_cells, name):
    array = numpy_to_vtk(numpy.ascontiguousarray(values.reshape(-1, order="F")), deep=True)
    array.SetName(name)
    data = image.GetCellData() if of_cells else image.GetPointData()
    data.AddArray(array)
    return data


def write(path, image, mode="appended", packed=True, big=False, wide=False, base64=True):
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary,
     "appended": writer.SetDataModeToAppended}[mode]()
    (writer.SetCompressorTypeToZLib if packed else writer.SetCompressorTypeToNone)()
    (writer.SetByteOrderToBigEndian if big else writer.SetByteOrderToLittleEndian)()
    (writer.SetHeaderTypeToUInt64 if wide else writer.SetHeaderTypeToUInt32)()
    writer.SetEncodeAppendedData(base64)
    writer.SetBlockSize(1024)
    writer.Write()
    return path


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def path():
            nonlocal count
            count += 1
            return folder / f"{count}.vti"

        plain = numpy.eye(3, 4)
        for kind in TYPES:
            values = volume((9, 11, 13), kind, generator)
            for mode, packed, big, wide, base64 in (
                    ("ascii", False, False, False, True), ("binary", False, False, False, True),
                    ("binary", True, False, False, True), ("binary", True, True, True, True),
                    ("appended", False, False, False, False), ("appended", False, True, True, False),
                    ("appended", False, False, True, True), ("appended", True, False, False, False),
                    ("appended", True, True, False, True), ("appended", True, False, True, True)):
                same(read(dump, write(path(), image_of(values), mode, packed, big, wide, base64)), values, plain,
                     f"{kind} {mode} packed {packed} big {big} wide {wide} base64 {base64}")
        values = volume((9, 11, 13), "u2", generator)
        for of_cells, first in itertools.product((False, True), ((0, 0, 0), (3, -2, 7))):
            spacing, origin = generator.uniform(.2, 3, 3).round(3), generator.uniform(-50, 50, 3).round(2)
            image = image_of(values, spacing, origin, of_cells, first=first)
            matrix = numpy.column_stack([numpy.diag(spacing),
                                         origin + (numpy.array(first) + (.5 if of_cells else 0)) * spacing])
            same(read(dump, write(path(), image)), values, matrix, f"cells {of_cells} from {first}")
        turned = image_of(values, (1, 2, 3), (5, 6, 7))
        turned.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
        same(read(dump, write(path(), turned)), values,
             numpy.array([[0, -2, 0, 5], [1, 0, 0, 6], [0, 0, 3, 7]]), "turned axes")
        other = volume((9, 11, 13), "u2", generator)
        both = image_of(values, name="a")
        add(both, other, False, "b")
        refusal = str(read(dump, write(path(), both)))
        check("several arrays (a, b)" in refusal and "--dataset" in refusal, refusal)
        same(read(dump, folder / f"{count}.vti", "dataset=b"), other, plain, "one of two by name")
        both.GetPointData().SetActiveScalars("b")
        same(read(dump, write(path(), both)), other, plain, "the active of two")
        vectors = image_of(values)
        vectors.GetPointData().RemoveArray("labels")
        pairs = numpy.column_stack([values.reshape(-1, order="F"), other.reshape(-1, order="F")])
        array = numpy_to_vtk(pairs, deep=True)
        array.SetName("both")
        vectors.GetPointData().AddArray(array)
        refusal = str(read(dump, write(path(), vectors)))
        check("--component 0 to --component 1" in refusal, refusal)
        same(read(dump, folder / f"{count}.vti", "component=1"), other, plain, "one of two components")
        empty = image_of(values)
        empty.GetPointData().RemoveArray("labels")
        check("without an array" in str(read(dump, write(path(), empty))), "no array")
        (folder / "no.vti").write_text("<VTKFile type='PolyData'><PolyData/></VTKFile>")
        check("no image data" in str(read(dump, folder / "no.vti")), "polydata")
        for mode, packed, base64 in (("ascii", False, True), ("binary", True, True), ("appended", False, False),
                                     ("appended", True, True)):
            data = write(path(), image_of(values), mode, packed, base64=base64).read_bytes()
            for part in (0, 30, 300, len(data) // 2, int(len(data) * .8)):
                (folder / "cut.vti").write_bytes(data[:part])
                refusal = read(dump, folder / "cut.vti")
                check(isinstance(refusal, str) and ";" in refusal, f"{part} of {len(data)} bytes of {mode} are read")
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
