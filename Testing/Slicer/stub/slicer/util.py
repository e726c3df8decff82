"""slicer.util, as far as the module VoxelCore uses it. Errors are written down for the tests."""

errors = []


class VTKObservationMixin:
    def __init__(self):
        self._observations = []

    def addObserver(self, object, event, method):
        self._observations.append((object, object.AddObserver(event, lambda caller, event: method(caller, event))))

    def removeObservers(self):
        for object, tag in self._observations:
            object.RemoveObserver(tag)
        self._observations = []


def errorDisplay(text, windowTitle=None):
    errors.append(text)


def pip_install(requirements):
    raise AssertionError(f"the module installs {requirements}")


def setSliceViewerLayers(background=None, foreground=None, foregroundOpacity=None):
    assert foreground is None or foreground.IsA("vtkMRMLScalarVolumeNode")


def addVolumeFromArray(array, ijkToRAS=None, name=None, nodeClassName="vtkMRMLScalarVolumeNode"):
    import slicer
    import vtk
    from vtk.util import numpy_support

    node = slicer.mrmlScene.AddNewNodeByClass(nodeClassName, name)
    image = vtk.vtkImageData()
    image.SetDimensions(*array.shape[::-1])
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(array.ravel(), deep=1))
    node.SetAndObserveImageData(image)
    node.SetIJKToRASMatrix(ijkToRAS or vtk.vtkMatrix4x4())
    return node


def arrayFromVolume(node):
    from vtk.util import numpy_support

    image = node.GetImageData()
    return numpy_support.vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])


def arrayFromModelPoints(node):
    from vtk.util import numpy_support

    return numpy_support.vtk_to_numpy(node.GetPolyData().GetPoints().GetData())


def getNode(name):
    import slicer

    found = [node for node in slicer.mrmlScene.nodes.values() if node.GetName() == name]
    assert len(found) == 1, name
    return found[0]
