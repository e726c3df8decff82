"""Shapes, and the command line's answer for them."""

import os
import subprocess

import numpy
import pytest

PROGRAM = os.environ["VOXELCORE_PROGRAM"]


def write_nrrd(path, array, spacing=(1, 1, 1), origin=(0, 0, 0), direction=numpy.eye(3)):
    """array[i, j, k] as a plain NRRD file."""
    array = numpy.asarray(array)
    types = {"u1": "uint8", "i1": "int8", "u2": "uint16", "i2": "int16", "u4": "uint32", "i4": "int32", "i8": "int64",
             "u8": "uint64", "f4": "float", "f8": "double"}
    columns = numpy.asarray(direction) * numpy.asarray(spacing)
    vectors = " ".join("(" + ",".join(repr(float(x)) for x in columns[:, axis]) + ")" for axis in range(3))
    header = (
        f"NRRD0004\ntype: {types[array.dtype.str[1:]]}\ndimension: 3\nspace: left-posterior-superior\n"
        f"sizes: {' '.join(map(str, array.shape))}\nspace directions: {vectors}\nkinds: domain domain domain\n"
        f"endian: little\nencoding: raw\nspace origin: ({','.join(repr(float(x)) for x in origin)})\n\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(array.astype(array.dtype.newbyteorder("<")).tobytes(order="F"))


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def blobs(seed, shape=(28, 24, 20), labels=1):
    """Overlapping balls, one label after the other."""
    random = numpy.random.default_rng(seed)
    volume = numpy.zeros(shape, numpy.uint8)
    places = numpy.stack(numpy.indices(shape), -1)
    for label in range(1, labels + 1):
        for _ in range(5):
            centre = random.uniform(4, numpy.array(shape) - 4)
            volume[((places - centre) ** 2).sum(-1) < random.uniform(2, 6) ** 2] = label
    return volume


@pytest.fixture
def volume():
    return blobs(5)
