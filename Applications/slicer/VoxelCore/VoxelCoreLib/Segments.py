"""Segments as volumes: voxels, and where they lie. In memory points are RAS mm, as in MRML; files are LPS mm."""

import dataclasses
import math

import numpy
import slicer
import vtk
from vtk.util import numpy_support

from . import VoxelCoreError

RAS_TO_LPS = numpy.diag([-1.0, -1.0, 1.0, 1.0])
# Balls that come within half a voxel of the scan's border are counted apart: where a segment ends inside the scan, as
# much background as this tells so.
MARGIN = 2


@dataclasses.dataclass
class SegmentVolume:
    segmentId: str
    name: str
    color: tuple
    voxels: numpy.ndarray  # [k, j, i], uint8, 1 inside; None when it has been written
    ijkToRas: numpy.ndarray  # 4 by 4, of the centre of voxel (0, 0, 0); in the coordinates of the segmentation node
    count: int = 0  # voxels inside

    def lpsGeometry(self):
        """Spacing, origin and direction (columns: i, j, k) as files have them."""
        matrix = RAS_TO_LPS @ self.ijkToRas
        spacing = numpy.linalg.norm(matrix[:3, :3], axis=0)
        return spacing, matrix[:3, 3], matrix[:3, :3] / spacing


def matrixOf(vtkMatrix):
    return numpy.array([[vtkMatrix.GetElement(row, column) for column in range(4)] for row in range(4)])


def _checkAxes(matrix, name):
    lengths = numpy.linalg.norm(matrix[:3, :3], axis=0)
    if not numpy.isfinite(matrix).all() or lengths.min() <= 0:
        raise VoxelCoreError(f"segment {name!r}: its voxel size is not valid")
    axes = matrix[:3, :3] / lengths
    off = numpy.abs(axes.T @ axes - numpy.eye(3)).max()
    if off > 1e-4:
        raise VoxelCoreError(
            f"segment {name!r}: its voxel axes are {math.degrees(math.asin(min(1.0, off))):.2g} degrees from right "
            "angles; resample the segmentation to a reference geometry without shear"
        )


def _scanExtent(segmentation, image):
    """The extent of the scan the segmentation was drawn on, in the voxels of `image`; None where it is not known."""
    name = slicer.vtkSegmentationConverter.GetReferenceImageGeometryParameterName()
    text = segmentation.GetConversionParameter(name)
    scan = slicer.vtkOrientedImageData()
    if not text or not slicer.vtkSegmentationConverter.DeserializeImageGeometry(text, scan, False):
        return None
    ours, theirs = vtk.vtkMatrix4x4(), vtk.vtkMatrix4x4()
    image.GetImageToWorldMatrix(ours)
    scan.GetImageToWorldMatrix(theirs)
    if not numpy.allclose(matrixOf(ours), matrixOf(theirs), rtol=0, atol=1e-5):
        return None
    return scan.GetExtent()


def readSegment(segmentationNode, segmentId):
    """The voxels of a segment within their box, with a margin of background, but for where the scan ends."""
    segmentation = segmentationNode.GetSegmentation()
    segment = segmentation.GetSegment(segmentId)
    if segment is None:
        raise VoxelCoreError(f"segmentation {segmentationNode.GetName()!r}: it has no segment {segmentId!r}")
    name = segment.GetName()
    if not segmentationNode.CreateBinaryLabelmapRepresentation():
        raise VoxelCoreError(f"segment {name!r}: it cannot be made a label map; look at the Segmentations module")
    image = slicer.vtkOrientedImageData()
    segmentationNode.GetBinaryLabelmapRepresentation(segmentId, image)
    scalars = image.GetPointData().GetScalars() if image.GetPointData() else None
    if scalars is None or scalars.GetNumberOfTuples() == 0:
        raise VoxelCoreError(f"segment {name!r}: it is empty")
    extent = image.GetExtent()
    inside = numpy_support.vtk_to_numpy(scalars).reshape(tuple(reversed(image.GetDimensions()))) != 0
    if not inside.any():
        raise VoxelCoreError(f"segment {name!r}: it is empty")
    matrix = vtk.vtkMatrix4x4()
    image.GetImageToWorldMatrix(matrix)
    matrix = matrixOf(matrix)
    _checkAxes(matrix, name)
    scan = _scanExtent(segmentation, image)
    box, pad = [], []
    for axis in range(3):  # of the array: k, j, i
        used = numpy.flatnonzero(inside.any(axis=tuple(other for other in range(3) if other != axis)))
        box.append(slice(int(used[0]), int(used[-1]) + 1))
        first = extent[2 * (2 - axis)]
        low, high = first + box[-1].start, first + box[-1].stop - 1
        room = (MARGIN, MARGIN)
        if scan is not None:
            room = low - scan[2 * (2 - axis)], scan[2 * (2 - axis) + 1] - high
        pad.append(tuple(max(0, min(MARGIN, side)) for side in room))
    voxels = numpy.pad(inside[tuple(box)].astype(numpy.uint8), pad)
    start = [extent[2 * i] + box[2 - i].start - pad[2 - i][0] for i in range(3)]
    placed = matrix.copy()
    placed[:3, 3] = (matrix @ numpy.array([*start, 1.0]))[:3]
    return SegmentVolume(segmentId, name, tuple(segment.GetColor()), voxels, placed, int(voxels.sum()))


def writeNrrd(volume, path):
    """A plain NRRD file, LPS mm. Returns where its voxels begin."""
    spacing, origin, direction = volume.lpsGeometry()

    def vector(values):
        return "(" + ",".join(repr(float(value)) for value in values) + ")"

    columns = " ".join(vector(direction[:, axis] * spacing[axis]) for axis in range(3))
    sizes = " ".join(str(length) for length in reversed(volume.voxels.shape))
    header = (
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
        f"sizes: {sizes}\nspace directions: {columns}\nkinds: domain domain domain\nencoding: raw\n"
        f"space origin: {vector(origin)}\n\n"
    ).encode()
    with open(path, "wb") as file:
        file.write(header)
        file.write(numpy.ascontiguousarray(volume.voxels).tobytes())
    return len(header)
