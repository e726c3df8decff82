"""Segmentations: segments whose binary label maps share an oriented image by value, or have one of their own."""

import numpy
import vtk
from vtk.util import numpy_support

from .mrml import vtkMRMLDisplayableNode


class vtkOrientedImageData(vtk.vtkImageData):
    """An image whose extent may begin anywhere, with a matrix from indices to world coordinates (RAS)."""

    def SetGeometryFromImageToWorldMatrix(self, matrix):
        self._matrix = vtk.vtkMatrix4x4()
        self._matrix.DeepCopy(matrix)

    def GetImageToWorldMatrix(self, matrix):
        matrix.DeepCopy(self.__dict__.get("_matrix") or vtk.vtkMatrix4x4())


class vtkSegmentationConverter:
    @staticmethod
    def GetReferenceImageGeometryParameterName():
        return "Reference image geometry"

    @staticmethod
    def SerializeImageGeometry(image):
        matrix = vtk.vtkMatrix4x4()
        image.GetImageToWorldMatrix(matrix)
        numbers = [matrix.GetElement(row, column) for row in range(4) for column in range(4)]
        return ";".join(repr(number) for number in [*numbers, *image.GetExtent()]) + ";"

    @staticmethod
    def DeserializeImageGeometry(text, image, allocate):
        words = [word for word in text.split(";") if word]
        if len(words) != 22:
            return False
        matrix = vtk.vtkMatrix4x4()
        for at, word in enumerate(words[:16]):
            matrix.SetElement(at // 4, at % 4, float(word))
        image.SetGeometryFromImageToWorldMatrix(matrix)
        image.SetExtent([int(word) for word in words[16:]])
        return True


class vtkSegment(vtk.vtkObject):
    def __init__(self):
        self.name, self.color, self.image, self.value = "", (0.5, 0.5, 0.5), None, 1

    def GetName(self):
        return self.name

    def GetColor(self):
        return self.color

    def GetLabelValue(self):
        return self.value


class vtkSegmentation(vtk.vtkObject):
    def __init__(self):
        self.segments = {}
        self.parameters = {}

    def AddEmptySegment(self, segmentId, name="", color=(0.5, 0.5, 0.5)):
        segment = vtkSegment()
        segment.name, segment.color = name or segmentId, tuple(color)
        self.segments[segmentId] = segment
        return segmentId

    def GetSegment(self, segmentId):
        return self.segments.get(segmentId)

    def GetSegmentIDs(self):
        return tuple(self.segments)

    def GetConversionParameter(self, name):
        return self.parameters.get(name, "")

    def SetConversionParameter(self, name, value):
        self.parameters[name] = value


class vtkMRMLSegmentationNode(vtkMRMLDisplayableNode):
    displayClass = "vtkMRMLDisplayNode"

    def __init__(self):
        vtkMRMLDisplayableNode.__init__(self)
        self._segmentation = vtkSegmentation()
        self.convertible = True

    def GetSegmentation(self):
        return self._segmentation

    def CreateBinaryLabelmapRepresentation(self):
        return self.convertible

    def GetBinaryLabelmapRepresentation(self, segmentId, image):
        segment = self._segmentation.GetSegment(segmentId)
        if segment is None or segment.image is None:
            return False
        image.DeepCopy(segment.image)
        matrix = vtk.vtkMatrix4x4()
        segment.image.GetImageToWorldMatrix(matrix)
        image.SetGeometryFromImageToWorldMatrix(matrix)
        values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
        values[:] = values == segment.value
        return True


def orientedImage(voxels, ijkToRas, start=(0, 0, 0)):
    """Of voxels [k, j, i]; `start` is the first index along i, j, k."""
    image = vtkOrientedImageData()
    size = voxels.shape[::-1]
    image.SetExtent(*[end for axis in range(3) for end in (start[axis], start[axis] + size[axis] - 1)])
    scalars = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(voxels).ravel(), deep=1)
    image.GetPointData().SetScalars(scalars)
    matrix = vtk.vtkMatrix4x4()
    for row in range(4):
        for column in range(4):
            matrix.SetElement(row, column, float(ijkToRas[row][column]))
    image.SetGeometryFromImageToWorldMatrix(matrix)
    return image
