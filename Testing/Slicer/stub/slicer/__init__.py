"""A stand-in for Slicer's Python package, as far as the module VoxelCore uses it; for tests where Slicer is not. It has
a scene of its own and no windows: those are of stub/panel.py."""

import types

from . import mrml, segmentations, util  # noqa: F401
from .mrml import *  # noqa: F401,F403
from .mrml import vtkMRMLScene
from .segmentations import (  # noqa: F401
    vtkMRMLSegmentationNode,
    vtkOrientedImageData,
    vtkSegmentation,
    vtkSegmentationConverter,
)

mrmlScene = vtkMRMLScene()
mrmlScene.classes = {
    name: found
    for module in (mrml, segmentations)
    for name, found in vars(module).items()
    if isinstance(found, type) and issubclass(found, mrml.vtkMRMLNode)
}
mrmlScene.begin()


class _Settings:
    def __init__(self):
        self.values = {}

    def value(self, name, default=None):
        return self.values.get(name, default)

    def setValue(self, name, value):
        self.values[name] = value


class _App:
    temporaryPath = ""

    def __init__(self):
        self._settings = _Settings()

    def settings(self):
        return self._settings


class _SegmentationsLogic:
    def ImportLabelmapToSegmentationNode(self, labels, node):
        import vtk
        from vtk.util import numpy_support

        matrix = vtk.vtkMatrix4x4()
        labels.GetIJKToRASMatrix(matrix)
        image = labels.GetImageData()
        values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
        shape = image.GetDimensions()[::-1]
        rows = [[matrix.GetElement(row, column) for column in range(4)] for row in range(4)]
        shared = segmentations.orientedImage(values.reshape(shape).astype("uint8"), rows)
        segmentation = node.GetSegmentation()
        for value in sorted(set(values.tolist()) - {0}):
            segmentId = segmentation.AddEmptySegment(f"Segment_{value}")
            segment = segmentation.GetSegment(segmentId)
            segment.image, segment.value = shared, value
        name = vtkSegmentationConverter.GetReferenceImageGeometryParameterName()
        segmentation.SetConversionParameter(name, vtkSegmentationConverter.SerializeImageGeometry(shared))
        return True


class _PlotsLogic:
    shown = []

    def ShowChartInLayout(self, chart):
        self.shown.append(chart.GetID())


app = _App()
modules = types.SimpleNamespace(
    segmentations=types.SimpleNamespace(logic=lambda: _SegmentationsLogic()),
    plots=types.SimpleNamespace(logic=lambda: _PlotsLogic()),
)
