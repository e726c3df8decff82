"""Results as vtkPolyData. Cells stand in VTK's order: vertices, lines, polygons."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def _cells(offsets, points):
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(offsets, numpy.int64), deep=1),
        numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(points, numpy.int64), deep=1),
    )
    return cells


def _even(rows, width):
    return _cells(numpy.arange(0, (len(rows) + 1) * width, width), numpy.ravel(rows))


def _add(attributes, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=1)
    array.SetName(name)
    attributes.AddArray(array)


def _polydata(points, unit):
    """With the field strings that the files have."""
    data = vtkPolyData()
    for name, text in (("SPACE", "LPS"), ("Units", unit)):
        strings = vtkStringArray()
        strings.SetName(name)
        strings.InsertNextValue(text)
        data.GetFieldData().AddArray(strings)
    places = vtkPoints()
    places.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=1))
    data.SetPoints(places)
    return data


def of_core(core):
    data = _polydata(core.vertices, core.unit)
    alone, free = core.isolated_vertices(), core.free_edges()
    data.SetVerts(_even(alone, 1))
    data.SetLines(_even(core.edges[free], 2))
    data.SetPolys(_cells(core.face_offsets, core.face_vertices))
    _add(data.GetPointData(), "Radius", core.radius)
    for name, vertices, edges, faces in (
        ("Lambda", core.lambda_vertices, core.lambda_edges, core.lambda_faces),
        ("Tolerance", core.tolerance_vertices, core.tolerance_edges, core.tolerance_faces),
    ):
        if len(vertices) == len(core.vertices):
            _add(data.GetPointData(), name, vertices)
            _add(data.GetCellData(), name, numpy.concatenate([vertices[alone], edges[free], faces]))
    _add(data.GetCellData(), "Label", numpy.full(data.GetNumberOfCells(), core.label, numpy.int64))
    return data


def of_skeleton(skeleton):
    data = _polydata(skeleton.points, skeleton.unit)
    used = numpy.zeros(len(skeleton.points), bool)
    used[skeleton.branch_points] = True
    used[skeleton.face_vertices] = True
    alone = numpy.flatnonzero(~used)
    branches, faces = len(skeleton.branch_nodes), len(skeleton.face_offsets) - 1
    data.SetVerts(_even(alone, 1))
    data.SetLines(_cells(skeleton.branch_offsets, skeleton.branch_points))
    data.SetPolys(_cells(skeleton.face_offsets, skeleton.face_vertices))
    _add(data.GetPointData(), "Radius", skeleton.radius)
    _add(data.GetPointData(), "BallRadius", skeleton.ball_radius)
    _add(data.GetPointData(), "ErosionThickness", skeleton.erosion_thickness)
    numbers = numpy.full(len(alone) + branches + faces, -1, numpy.int64)
    numbers[len(alone) : len(alone) + branches] = numpy.arange(branches)
    _add(data.GetCellData(), "BranchId", numbers)
    labels = numpy.full(len(numbers), skeleton.label, numpy.int64)
    if len(skeleton.point_labels):  # of a network
        _add(data.GetPointData(), "Label", skeleton.point_labels)
        labels[: len(alone)] = skeleton.point_labels[alone]
        labels[len(alone) : len(alone) + branches] = skeleton.branch_labels
        labels[len(alone) + branches :] = skeleton.point_labels[skeleton.face_vertices[skeleton.face_offsets[:-1]]]
    _add(data.GetCellData(), "Label", labels)
    return data
