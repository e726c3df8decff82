"""What the tests of Slicer modules, scenes and pages share: scans written byte by byte, and VTK's view of a file."""
import json
import math
import subprocess
import sys


def fail(message):
    print("FAILED: " + message)
    sys.exit(1)


def check(condition, message):
    if not condition:
        fail(message)


# An oblique, left-handed grid: columns of the index-to-LPS matrix are the axes times their spacing (mm).
SIZE = (30, 26, 22)
AXES = ((0.48, 0.64, 0.0), (-0.72, 0.54, 0.0), (0.0, 0.0, -1.5))
ORIGIN = (12.0, -40.0, 7.5)


def two_blocks():
    """Labels 3 and 8, as bytes with i fastest."""
    voxels = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                at = (k * SIZE[1] + j) * SIZE[0] + i
                if 2 <= i < 20 and 3 <= j < 12 and 2 <= k < 9:
                    voxels[at] = 3
                if 5 <= i < 12 and 14 <= j < 24 and 4 <= k < 20:
                    voxels[at] = 8
    return voxels


def write_nrrd(path, voxels):
    vector = lambda v: "(%s)" % ",".join(repr(x) for x in v)
    header = ("NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
              "space directions: %s\nkinds: domain domain domain\nencoding: raw\nspace origin: %s\n\n"
              % (*SIZE, " ".join(vector(a) for a in AXES), vector(ORIGIN)))
    with open(path, "wb") as file:
        file.write(header.encode() + bytes(voxels))


def label_at(voxels, point):
    """The label of the voxel a point (LPS mm) lies in. The axes are orthogonal."""
    index = []
    for axis in range(3):
        along = AXES[axis]
        length2 = sum(a * a for a in along)
        index.append(math.floor(sum((p - o) * a for p, o, a in zip(point, ORIGIN, along)) / length2 + 0.5))
    for axis in range(3):
        if not 0 <= index[axis] < SIZE[axis]:
            return 0
    return voxels[(index[2] * SIZE[1] + index[1]) * SIZE[0] + index[0]]


def run(*command, code=0):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    check(result.returncode == code,
          "%s\nexit code %d\n%s%s" % (command, result.returncode, result.stdout, result.stderr))
    return result


def polydata(dump, path):
    """What VTK's own reader finds in a .vtp."""
    return json.loads(run(dump, path).stdout)
