"""Small whole files of formats that VoxelCore reads and does not write, laid out byte by byte: FreeSurfer's, LSM,
OME-TIFF, Zarr of both versions with and without shards; headers of NRRD and MetaImage that number their data files, and
a segmentation of 3D Slicer."""

import gzip
import json
import os
import struct
import zlib

SIDE = 6
# A cube of 4 voxels a side in the middle.
VALUES = bytes(all(1 <= c < 5 for c in (x, y, z)) for z in range(SIDE) for y in range(SIDE) for x in range(SIDE))
OME = ('<?xml version="1.0" encoding="UTF-8"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06">'
       '<Image ID="Image:0"><Pixels ID="Pixels:0" DimensionOrder="XYZCT" Type="uint8" SizeX="6" SizeY="6" SizeZ="6" '
       'SizeC="1" SizeT="1" PhysicalSizeX="0.5" PhysicalSizeXUnit="mm" PhysicalSizeY="0.5" PhysicalSizeYUnit="mm" '
       'PhysicalSizeZ="2"><Channel ID="Channel:0:0" SamplesPerPixel="1"/><TiffData FirstZ="0" PlaneCount="6"/>'
       '</Pixels></Image></OME>')


def mgh():
    head = struct.pack(">7ih", 1, SIDE, SIDE, SIDE, 1, 0, 0, 1)
    head += struct.pack(">15f", 1, 1, 2, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0)
    return head.ljust(284, b"\0") + VALUES


def tiff(first):
    """A page for each slice; `first`: tag -> type and bytes, of the first page alone."""
    data = bytearray(b"II*\0" + struct.pack("<I", 8))
    plane = SIDE * SIDE
    for k in range(SIDE):
        start = len(data)
        more = sorted((first if k == 0 else {}).items())
        numbers = {256: SIDE, 257: SIDE, 258: 8, 259: 1, 262: 1, 273: 0, 277: 1, 278: SIDE, 279: plane}
        pixels = start + 2 + 12 * (len(numbers) + len(more)) + 4
        numbers[273] = pixels
        entries = {tag: struct.pack("<HHII", tag, 4, 1, value) for tag, value in numbers.items()}
        behind = pixels + plane
        for tag, (kind, value) in more:
            entries[tag] = struct.pack("<HHII", tag, kind, len(value), behind)
            behind += len(value) + len(value) % 2
        data += struct.pack("<H", len(entries)) + b"".join(entries[tag] for tag in sorted(entries))
        data += struct.pack("<I", 0 if k == SIDE - 1 else behind) + VALUES[k * plane:(k + 1) * plane]
        for _, (_, value) in more:
            data += value + b"\0" * (len(value) % 2)
    return bytes(data)


def lsm():
    block = struct.pack("<IiIIIIIi", 0x0400494C, 512, SIDE, SIDE, SIDE, 1, 1, 1)
    block += struct.pack("<ii3d3dH", 16, 16, 1e-6, 1e-6, 2e-6, 0, 0, 0, 0)
    return tiff({34412: (1, block.ljust(512, b"\0"))})


def nrrd(more):
    lines = ["NRRD0004", "type: uint8", "dimension: 3", f"sizes: {SIDE} {SIDE} {SIDE}", "encoding: raw",
             "space: left-posterior-superior", "space directions: (1,0,0) (0,1,0) (0,0,2)",
             "space origin: (1,2,3)", *more]
    return "\n".join(lines).encode() + b"\n"


def array2(zlib_packed):
    return {"zarr_format": 2, "shape": [SIDE] * 3, "chunks": [3, 6, 6], "dtype": "|u1", "order": "C", "filters": None,
            "compressor": {"id": "zlib", "level": 1} if zlib_packed else None, "fill_value": 0,
            "dimension_separator": "/"}


def write(folder, name, content):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else json.dumps(content).encode())


def make(folder):
    """Writes them all."""
    write(folder, "a.mgh", mgh())
    write(folder, "a.mgz", gzip.compress(mgh()))
    write(folder, "a.lsm", lsm())
    write(folder, "a.ome.tif", tiff({270: (2, OME.encode() + b"\0")}))
    write(folder, "a.seg.nrrd", nrrd([
        "Segment0_ID:=Segment_1", "Segment0_Name:=cube", "Segment0_LabelValue:=1", "Segment0_Layer:=0",
        "Segment0_Color:=0.5 0.25 1", "Segment0_Extent:=1 4 1 4 1 4", "Segment1_ID:=Segment_2", "Segment1_Name:=none",
        "Segment1_LabelValue:=2", "Segment1_Layer:=0", "Segmentation_MasterRepresentation:=Binary labelmap"])
          + b"\n" + VALUES)
    write(folder, "numbered/a.nhdr", nrrd(["data file: s%02d.raw 1 6 1"]))
    write(folder, "numbered/a.mhd", "\n".join([
        "ObjectType = Image", "NDims = 3", "BinaryData = True", "TransformMatrix = 1 0 0 0 1 0 0 0 1",
        "Offset = 0 0 0", "ElementSpacing = 1 1 2", f"DimSize = {SIDE} {SIDE} {SIDE}", "ElementType = MET_UCHAR",
        "ElementDataFile = s%02d.raw 1 6 1"]).encode() + b"\n")
    for k in range(SIDE):
        write(folder, f"numbered/s{k + 1:02}.raw", VALUES[36 * k:36 * k + 36])
    axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
    image = {"version": "0.4", "axes": axes, "datasets": [
        {"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [3, 2, 1]},
                                                    {"type": "translation", "translation": [1, 2, 3]}]}]}
    labels = {"colors": [{"label-value": 1, "rgba": [255, 0, 0, 255]}],
              "properties": [{"label-value": 1, "name": "cube"}]}
    write(folder, "a.zarr/.zgroup", {"zarr_format": 2})
    write(folder, "a.zarr/.zattrs", {"multiscales": [image], "image-label": labels})
    write(folder, "a.zarr/0/.zarray", array2(True))
    half = len(VALUES) // 2
    for k, part in enumerate((VALUES[:half], VALUES[half:])):
        write(folder, f"a.zarr/0/{k}/0/0", zlib.compress(part))
    # Two shards of two chunks each; the second chunk of the second is not there.
    codecs = [{"name": "bytes", "configuration": {"endian": "little"}}]
    sharding = {"name": "sharding_indexed", "configuration": {
        "chunk_shape": [3, 3, 6], "codecs": codecs, "index_codecs": codecs, "index_location": "end"}}
    write(folder, "b.zarr/zarr.json", {
        "zarr_format": 3, "node_type": "array", "shape": [SIDE] * 3, "data_type": "uint8",
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [3, 6, 6]}},
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}}, "fill_value": 0,
        "codecs": [sharding], "attributes": {}})
    for k in range(2):
        chunks = [b"".join(VALUES[36 * z + 18 * j:36 * z + 18 * j + 18] for z in range(3 * k, 3 * k + 3))
                  for j in range(2)]
        places = [(0, 54), (54, 54) if k == 0 else (2**64 - 1, 2**64 - 1)]
        write(folder, f"b.zarr/c/{k}/0/0", b"".join(chunks) + b"".join(struct.pack("<QQ", *place) for place in places))
