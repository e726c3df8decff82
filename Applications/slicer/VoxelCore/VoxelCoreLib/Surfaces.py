"""Medial surfaces and skeletons as VTK has them: read, turned to RAS, cut by tolerance, coloured by thickness."""

import numpy
import vtk
from vtk.util import numpy_support

from . import VoxelCoreError


def readModel(path):
    """A .vtp file in LPS mm, as RAS mm. x and y change sign: a half turn, so polygons keep their side."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    read = reader.GetOutput()
    if read is None or read.GetPoints() is None:
        raise VoxelCoreError(f"{path}: it cannot be read as a model")
    space = read.GetFieldData().GetAbstractArray("SPACE")
    if space is None or space.GetValue(0) != "LPS":
        raise VoxelCoreError(f"{path}: it does not say that its points are LPS")
    model = vtk.vtkPolyData()
    model.ShallowCopy(read)
    places = numpy_support.vtk_to_numpy(read.GetPoints().GetData()) * (-1.0, -1.0, 1.0)
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_support.numpy_to_vtk(places, deep=1))
    model.SetPoints(points)
    model.GetFieldData().RemoveArray("SPACE")  # in memory MRML is RAS
    return model


def numpyPoints(model):
    return numpy_support.vtk_to_numpy(model.GetPoints().GetData())


def array(attributes, name):
    found = attributes.GetArray(name)
    return None if found is None else numpy_support.vtk_to_numpy(found)


def addPointArray(model, name, values):
    made = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(values), deep=1)
    made.SetName(name)
    model.GetPointData().AddArray(made)


def toleranceRange(model):
    """What a slider can run over, mm: from the tolerance the model was made with to the last that takes anything away.
    None without the array `Tolerance`. What never goes has the greatest value."""
    values = array(model.GetCellData(), "Tolerance")
    if values is None or len(values) == 0:
        return None
    passing = values[values < values.max()]
    low = float(values.min())
    return low, float(passing.max()) if len(passing) else low


def _kept(cells, keep):
    """The cells of a vtkCellArray where keep is true."""
    made = vtk.vtkCellArray()
    count = cells.GetNumberOfCells()
    if count == 0 or not keep.any():
        return made
    offsets = numpy_support.vtk_to_numpy(cells.GetOffsetsArray())
    points = numpy_support.vtk_to_numpy(cells.GetConnectivityArray())
    lengths = numpy.diff(offsets)
    kept = numpy.concatenate([[0], numpy.cumsum(lengths[keep])]).astype(numpy.int64)
    made.SetData(
        numpy_support.numpy_to_vtkIdTypeArray(kept, deep=1),
        numpy_support.numpy_to_vtkIdTypeArray(points[numpy.repeat(keep, lengths)].astype(numpy.int64), deep=1),
    )
    return made


def atTolerance(whole, tolerance):
    """What is left of a model at a greater tolerance, mm: the cells that disappear later. Points are shared with
    `whole`, which is not changed."""
    values = array(whole.GetCellData(), "Tolerance")
    if values is None:
        raise VoxelCoreError("this model has no array Tolerance; compute it with a tolerance")
    keep = values >= tolerance
    made = vtk.vtkPolyData()
    made.SetPoints(whole.GetPoints())
    made.GetPointData().ShallowCopy(whole.GetPointData())
    made.GetFieldData().ShallowCopy(whole.GetFieldData())
    begin = 0
    for get, put in (
        (whole.GetVerts, made.SetVerts),
        (whole.GetLines, made.SetLines),
        (whole.GetPolys, made.SetPolys),
    ):
        cells = get()
        end = begin + cells.GetNumberOfCells()
        put(_kept(cells, keep[begin:end]))
        begin = end
    for index in range(whole.GetCellData().GetNumberOfArrays()):
        source = whole.GetCellData().GetArray(index)
        if source is not None:
            part = numpy_support.numpy_to_vtk(numpy_support.vtk_to_numpy(source)[keep], deep=1)
            part.SetName(source.GetName())
            made.GetCellData().AddArray(part)
    return made


def sample(map, ijkToRas, points):
    """The values [k, j, i] of the voxels that points (RAS) lie in or next to."""
    index = numpy.linalg.inv(ijkToRas) @ numpy.vstack([points.T, numpy.ones(len(points))])
    places = numpy.rint(index[:3]).astype(int)
    for axis in range(3):
        numpy.clip(places[axis], 0, map.shape[2 - axis] - 1, out=places[axis])
    return map[places[2], places[1], places[0]]
