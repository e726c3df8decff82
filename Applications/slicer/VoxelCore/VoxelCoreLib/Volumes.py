"""Thickness maps as files of NRRD hold them."""

import zlib

import numpy

from . import VoxelCoreError


def readMap(path):
    """float32 [k, j, i] of a map that 'voxelcore thickness' or Worker.py wrote: little endian, plain or gzip."""
    with open(path, "rb") as file:
        content = file.read()
    head, _, data = content.partition(b"\n\n")
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line and line[0] != "#")
    if fields.get("type") not in ("float", "float32") or fields.get("dimension") != "3":
        raise VoxelCoreError(f"{path}: it is no map of float32")
    if fields["encoding"] in ("gzip", "gz"):
        data = zlib.decompress(data, zlib.MAX_WBITS | 16)
    elif fields["encoding"] != "raw":
        raise VoxelCoreError(f"{path}: its encoding {fields['encoding']!r} is not read here")
    sizes = [int(word) for word in fields["sizes"].split()]
    if len(data) != 4 * sizes[0] * sizes[1] * sizes[2]:
        raise VoxelCoreError(f"{path}: it is cut off")
    return numpy.frombuffer(data, "<f4").reshape(tuple(reversed(sizes)))
