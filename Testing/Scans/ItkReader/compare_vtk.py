"""Legacy VTK images, as VTK writes them."""
import sys

import oracle_files as make
from comparison import IDENTITY, ORIGIN, SCRATCH, refused, same
from oracle_files import SPACING, VOLUME


def compare():
    try:
        import vtk as library
        from vtk.util import numpy_support
    except ImportError as missing:
        print(missing)
        sys.exit(77)

    def image(data, cells=False):
        one = library.vtkImageData()
        one.SetDimensions(*(n + int(cells) for n in data.shape[::-1]))
        one.SetSpacing(*SPACING)
        one.SetOrigin(*ORIGIN)
        array = numpy_support.numpy_to_vtk(data.ravel(), deep=1)
        array.SetName("labels")
        (one.GetCellData() if cells else one.GetPointData()).SetScalars(array)
        return one

    def made(name, one, binary=True, old=False):
        path = SCRATCH / (name + ".vtk")
        writer = library.vtkStructuredPointsWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(one)
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
        if old:
            writer.SetFileVersion(42)
        writer.Write()
        return path

    plain = make.affine(IDENTITY, SPACING, ORIGIN)
    for dtype in ("u1", "i1", "i2", "u2", "i4", "u4", "i8", "f4", "f8"):
        for binary in (True, False):
            if dtype == "u1" and not binary:
                continue
            same(f"{dtype} {binary}", made(dtype, image(VOLUME.astype(dtype)), binary), VOLUME, plain)
        same(f"{dtype} version 4.2", made(dtype, image(VOLUME.astype(dtype)), True, True), VOLUME, plain)
    refused("bytes as text", made("text", image(VOLUME), False), "COLOR_SCALARS as text")
    refused("cells", made("cells", image(VOLUME, True)), "values of cells")
    refused("cells as text", made("cellstext", image(VOLUME.astype("i2"), True), False), "values of cells")
    for binary in (True, False):
        path = made("cut", image(VOLUME.astype("i2")), binary)
        data = path.read_bytes()
        path.write_bytes(data[: data.index(b"LOOKUP_TABLE") + 300])
        refused(f"cut off {binary}", path, "truncated")
    mesh = SCRATCH / "mesh.vtk"
    mesh.write_text(
        "# vtk DataFile Version 3.0\nm\nASCII\nDATASET POLYDATA\n"
        "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n")
    refused("a mesh", mesh, "does not know it")
