"""What the tests of foreign formats share: volumes whose every label has one place, and what is asked of a reading."""
import itertools
import json
import os
import random
import subprocess
import sys

import numpy

failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("FAILED", what)


def finish(count):
    print(count, "files compared,", len(failures), "failures")
    sys.exit(1 if failures else 0)


def seed():
    number = int(os.environ.get("VOXELCORE_SEED", random.randrange(2**31)))
    print("seed", number)
    return numpy.random.default_rng(number)


def volume(shape, dtype, generator):
    """Zero but for a dozen labels of one voxel each: any slip of an axis, a byte or a chunk moves one."""
    values = numpy.zeros(shape, dtype)
    largest = 127 if numpy.dtype(dtype).itemsize == 1 else 30000
    places = generator.choice(values.size, 12, replace=False)
    labels = generator.choice(numpy.arange(1, largest), 12, replace=False)
    values.reshape(-1)[places] = labels.astype(dtype)
    return values


def read(dump, path, *options, environment=None):
    """What VoxelCore finds, or the line by which it refuses."""
    run = subprocess.run([dump, path, *options], capture_output=True, text=True, check=False,
                         env={**os.environ, **(environment or {})})
    if run.returncode not in (0, 3):
        raise RuntimeError(f"{path}: exit {run.returncode}: {run.stderr}")
    return json.loads(run.stdout) if run.returncode == 0 else run.stderr.strip()


def same(found, values, matrix, what):
    """`values[i, j, k]`; `matrix` 3 x 4, from index to LPS mm: each voxel within 1e-4 voxels of its place."""
    if isinstance(found, str):
        check(False, f"{what}: {found}")
        return
    check(found["size"] == list(values.shape), f"{what}: size {found['size']}")
    expected = {str(int(values[tuple(at)])): [[int(x) for x in at], [1, 1, 1]] for at in numpy.argwhere(values)}
    check(found["boxes"] == expected, f"{what}: labels lie elsewhere")
    if matrix is None:
        check(found["unit"] == "voxel", f"{what}: lengths are not in voxels")
        return
    check(found["unit"] == "mm", f"{what}: lengths are not in mm")
    ours = numpy.reshape(found["affine"], (3, 4))
    corners = numpy.array(list(itertools.product(*[(0, side - 1) for side in values.shape])))
    off = (corners @ (ours[:, :3] - matrix[:, :3]).T + ours[:, 3] - matrix[:, 3])
    finest = numpy.linalg.norm(matrix[:, :3], axis=0).min()
    check(numpy.abs(off).max() < 1e-4 * finest, f"{what}: places off by {numpy.abs(off).max() / finest:.3g} voxels")


def orientations():
    """All 48: where i, j and k run to."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            matrix = numpy.zeros((3, 3))
            for axis, (row, sign) in enumerate(zip(order, signs)):
                matrix[row, axis] = sign
            yield matrix
