"""Bodies as segmentations of the stub, and the same as files for the program, which knows nothing of Slicer."""

import gzip
import os
import subprocess
import sys
import traceback

import numpy
import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MODULE = os.path.join(ROOT, "Applications", "slicer", "VoxelCore")
sys.path[:0] = [os.path.join(HERE, "stub"), MODULE]
PROGRAM = os.environ["VOXELCORE_PROGRAM"]
LPS = numpy.diag([-1.0, -1.0, 1.0, 1.0])

import slicer  # noqa: E402
import vtk  # noqa: E402
from slicer.segmentations import orientedImage, vtkSegmentationConverter  # noqa: E402
from VoxelCoreLib import Surfaces  # noqa: E402
from VoxelCoreLib.Computation import Computation  # noqa: E402
from VoxelCoreLib.Settings import Settings  # noqa: E402

EVERYTHING = Settings(thickness=True)
EXACT = Settings(thickness=True, refine=False)

# Oblique, left-handed, of unequal voxels, with the origin elsewhere: RAS.
TURN = numpy.array([[0.6, -0.64, 0.48], [0.8, 0.48, -0.36], [0.0, 0.6, 0.8]])
OBLIQUE = numpy.eye(4)
OBLIQUE[:3, :3] = TURN @ numpy.diag([0.5, 0.6, -0.8])
OBLIQUE[:3, 3] = 31.0, -47.5, 12.25


@pytest.fixture(autouse=True)
def scene(tmp_path, monkeypatch):
    """Empty before each test; files of computations lie in a folder that must be empty afterwards."""
    slicer.mrmlScene.Clear()
    slicer.mrmlScene.undoStack.clear()
    slicer.util.errors.clear()
    slicer.app.temporaryPath = str(tmp_path / "temporary")
    slicer.app.settings().values.clear()
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    # What fails in a slot or an observer is told to nobody else.
    unseen = []
    monkeypatch.setattr(sys, "excepthook", lambda *error: unseen.append("".join(traceback.format_exception(*error))))
    yield slicer.mrmlScene
    assert unseen == [], unseen[0]
    left = os.listdir(slicer.app.temporaryPath) if os.path.isdir(slicer.app.temporaryPath) else []
    assert left == [], f"files are left: {left}"


def segmentationOf(voxels, ijkToRas=OBLIQUE, scanSize=None, start=(0, 0, 0), names=None, name="scan"):
    """A segmentation of a label map [k, j, i] whose first voxel has the index `start`. `scanSize` along i, j, k: how
    large the scan is that it was drawn on, from index 0; None: as the label map. All labels share one image."""
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLSegmentationNode", name)
    segmentation = node.GetSegmentation()
    image = orientedImage(voxels.astype(numpy.uint8), ijkToRas, start)
    for value in numpy.unique(voxels[voxels > 0]):
        segmentId = f"Segment_{value}"
        name = (names or {}).get(value, f"part {value}")
        segmentation.AddEmptySegment(segmentId, name, (0.9, 0.2 * (value % 5), 0.1))
        segment = segmentation.GetSegment(segmentId)
        segment.image, segment.value = image, int(value)
    size = scanSize or tuple(first + length for first, length in zip(start, voxels.shape[::-1]))
    scan = orientedImage(numpy.zeros((1, 1, 1), numpy.uint8), ijkToRas)
    scan.SetExtent(0, size[0] - 1, 0, size[1] - 1, 0, size[2] - 1)
    segmentation.SetConversionParameter(
        vtkSegmentationConverter.GetReferenceImageGeometryParameterName(),
        vtkSegmentationConverter.SerializeImageGeometry(scan),
    )
    return node


def writeLabels(path, voxels, ijkToRas=OBLIQUE):
    """The same labels as a file, written without the module's code."""
    matrix = LPS @ ijkToRas
    vectors = " ".join("(%r,%r,%r)" % tuple(float(x) for x in matrix[:3, axis]) for axis in range(3))
    sizes = " ".join(str(n) for n in voxels.shape[::-1])
    with open(path, "wb") as file:
        file.write(
            (
                "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
                f"sizes: {sizes}\nspace directions: {vectors}\nkinds: domain domain domain\n"
                "encoding: raw\nspace origin: (%r,%r,%r)\n\n" % tuple(float(x) for x in matrix[:3, 3])
            ).encode()
        )
        file.write(voxels.astype(numpy.uint8).tobytes())


def readLabels(path):
    """Voxels [k, j, i] and the matrix to RAS of a plain .nrrd of labels in one layer, LPS or RAS."""
    with open(path, "rb") as file:
        content = file.read()
    head, _, data = content.partition(b"\r\n\r\n" if b"\r\n\r\n" in content[:2000] else b"\n\n")
    fields = dict(line.split(":", 1) for line in head.decode("latin-1").splitlines() if ":" in line and line[0] != "#")
    fields = {name.strip(): value.strip().lstrip("=") for name, value in fields.items()}
    if fields["encoding"] in ("gzip", "gz"):
        data = gzip.decompress(data)
    types = {"unsigned char": "u1", "uint8": "u1", "uchar": "u1", "short": "i2", "int16": "i2", "signed short": "i2",
             "unsigned short": "u2", "uint16": "u2", "int": "i4"}
    order = ">" if fields.get("endian") == "big" else "<"
    sizes = [int(word) for word in fields["sizes"].split()]
    voxels = numpy.frombuffer(data, order + types[fields["type"]])[: numpy.prod(sizes)].reshape(sizes[::-1])
    matrix = numpy.eye(4)
    vectors = fields["space directions"].replace(") (", ")|(").split("|")
    for axis, vector in enumerate(vectors):
        matrix[:3, axis] = [float(word) for word in vector.strip("()").split(",")]
    matrix[:3, 3] = [float(word) for word in fields["space origin"].strip("()").split(",")]
    return voxels, (LPS @ matrix if fields["space"].startswith("left-post") else matrix)


def run(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done


def phantom(tmp_path, kind, size, *words):
    path = tmp_path / f"{kind}.nrrd"
    run("phantom", kind, "--size", size, "-o", path, "--quiet", *words)
    return readLabels(path)


def data(*names):
    folder = os.environ.get("VOXELCORE_TEST_DATA", "")
    path = os.path.join(folder, *names)
    if not folder or not os.path.exists(path):
        pytest.skip(f"no foreign scan {'/'.join(names)}")
    return path


def body(labels=1):
    """Thin and thick parts that meet nothing of each other, within a frame of background."""
    voxels = numpy.zeros((26, 30, 34), numpy.uint8)
    voxels[8:18, 4:14, 4:30] = 1
    voxels[11:14, 14:24, 8:24] = 1
    if labels > 1:
        voxels[20:24, 4:26, 4:30] = 2
    return voxels


def thePackage():
    from VoxelCoreLib import Backend

    return Backend.Backend("package", [sys.executable, Backend.WORKER])


@pytest.fixture(params=["package", "program"])
def backend(request):
    from VoxelCoreLib import Backend

    return Backend.find(PROGRAM) if request.param == "program" else thePackage()


@pytest.fixture
def package():
    """For what does not depend on who computes."""
    return thePackage()


def rasIndex(points, ijkToRas):
    """The voxels that points lie in: index i, j, k."""
    turned = numpy.linalg.inv(ijkToRas) @ numpy.vstack([points.T, numpy.ones(len(points))])
    return numpy.floor(turned[:3] + 0.5).astype(int)


def roles(nodes):
    from VoxelCoreLib import Scene

    found = {}
    for node in nodes:
        found.setdefault(node.GetAttribute(Scene.ROLE), []).append(node)
    return found


def compute(node, settings, backend, ids=None, onProgress=None):
    ids = ids or list(node.GetSegmentation().GetSegmentIDs())
    return Computation(node, ids, settings, backend, slicer.app.temporaryPath).wait(slicer.mrmlScene, onProgress)


def pointsOf(node):
    return slicer.util.arrayFromModelPoints(node)


def lpsPoints(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return numpy.array(Surfaces.numpyPoints(reader.GetOutput())), reader.GetOutput()
