"""OME-Zarr stores that zarr writes (version 2), and such as the specification of version 3 has them, written here byte
by
byte: values, places, units, chunks of any order and packing, levels, labels, parts.

usage: zarr_test.py DUMP_PROGRAM      exit 77: zarr is not there
"""
import gzip
import itertools
import json
import pathlib
import struct
import sys
import tempfile

try:
    import numcodecs
    import numpy
    import zarr
except ImportError:
    print("python3-zarr is not installed")
    sys.exit(77)

from oracles import check, finish, orientations, read, same, seed, volume

AXES = [{"name": name, "type": "space", "unit": "micrometer"} for name in "zyx"]
WORDS = {(0, 1): "right-to-left", (0, -1): "left-to-right", (1, 1): "anterior-to-posterior",
         (1, -1): "posterior-to-anterior", (2, 1): "inferior-to-superior", (2, -1): "superior-to-inferior"}


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0x82F63B78 if crc & 1 else 0)
    return struct.pack("<I", crc ^ 0xFFFFFFFF)


PACKERS = {
    "gzip": lambda data: gzip.compress(data),
    "zstd": lambda data: numcodecs.Zstd().encode(data),
    "blosc": lambda data: numcodecs.Blosc("zstd").encode(data),
    "crc32c": lambda data: data + crc32c(data),
}


def packed(data, codecs):
    for codec in codecs:
        data = PACKERS[codec](data)
    return bytes(data)


def blocks(values, chunk):
    """Index and values of each chunk, filled up to its whole size."""
    counts = [-(-side // part) for side, part in zip(values.shape, chunk)]
    for index in itertools.product(*map(range, counts)):
        part = values[tuple(slice(i * c, (i + 1) * c) for i, c in zip(index, chunk))]
        whole = numpy.zeros(chunk, values.dtype)
        whole[tuple(slice(side) for side in part.shape)] = part
        yield index, whole


def write_v3(folder, values, chunk, codecs=(), endian="little", order=None, separator="/", encoding="default",
             inner=None):
    """A version 3 array; `inner`: chunks in shards of `chunk`."""
    folder.mkdir(parents=True)
    order = order or list(range(values.ndim))
    chain = [{"name": "transpose", "configuration": {"order": order}}] if order != sorted(order) else []
    chain.append({"name": "bytes", "configuration": {"endian": endian}})
    chain += [{"name": name, "configuration": {}} for name in codecs]
    if inner:
        chain = [{"name": "sharding_indexed", "configuration": {
            "chunk_shape": list(inner), "codecs": chain, "index_location": "end",
            "index_codecs": [{"name": "bytes", "configuration": {"endian": "little"}}, {"name": "crc32c"}]}}]
    keys = {"name": encoding, "configuration": {"separator": separator}}
    (folder / "zarr.json").write_text(json.dumps({
        "zarr_format": 3, "node_type": "array", "shape": list(values.shape), "data_type": str(values.dtype),
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": list(chunk)}}, "chunk_key_encoding": keys,
        "fill_value": 0, "codecs": chain, "attributes": {}}))

    def encoded(part):
        stored = numpy.ascontiguousarray(part.transpose(order)).astype(part.dtype.newbyteorder("<>"[endian == "big"]))
        return packed(stored.tobytes(), codecs)

    for index, part in blocks(values, chunk):
        if not part.any():
            continue
        name = separator.join(map(str, index))
        path = folder / (f"c{separator}{name}" if encoding == "default" else name)
        path.parent.mkdir(parents=True, exist_ok=True)
        if not inner:
            path.write_bytes(encoded(part))
            continue
        data, table = b"", b""
        for _, small in blocks(part, inner):
            piece = encoded(small) if small.any() else b""
            table += struct.pack("<QQ", len(data), len(piece)) if piece else b"\xff" * 16
            data += piece
        path.write_bytes(data + table + crc32c(table))


def write_ome(folder, values, scale, translation=None, axes=None, version=2, **how):
    """An image of one resolution; `values` in the order of the axes."""
    transforms = [{"type": "scale", "scale": list(scale)}]
    if translation:
        transforms.append({"type": "translation", "translation": list(translation)})
    scales = [{"version": "0.4" if version == 2 else "0.5", "axes": axes or AXES,
               "datasets": [{"path": "0", "coordinateTransformations": transforms}]}]
    if version == 2:
        group = zarr.open_group(str(folder), mode="w")
        group.attrs["multiscales"] = scales
        group.create_dataset("0", data=values, **how)
    else:
        folder.mkdir(parents=True)
        (folder / "zarr.json").write_text(json.dumps(
            {"zarr_format": 3, "node_type": "group", "attributes": {"ome": {"version": "0.5", "multiscales": scales}}}))
        write_v3(folder / "0", values, **how)


def matrix(scale, translation=(0, 0, 0), unit=1e-3):
    """Of axes z, y, x: from i, j, k to LPS mm."""
    made = numpy.zeros((3, 4))
    for axis in range(3):
        made[axis, axis] = scale[2 - axis] * unit
        made[axis, 3] = translation[2 - axis] * unit
    return made


def test_packings(dump, folder, generator):
    count = 0
    compressors = [None, numcodecs.Zlib(), numcodecs.GZip(), numcodecs.Zstd(), numcodecs.BZ2()]
    for name, mode in itertools.product(numcodecs.blosc.list_compressors(), (0, 1, 2)):
        compressors.append(numcodecs.Blosc(name, shuffle=mode))
    types = ["u1", "i2", ">u2", "<u4", ">i4", "u8", "f4", ">f8", "i1"]
    for number, compressor in enumerate(compressors):
        for order, separator in (("C", "."), ("F", "/")):
            values = volume((9, 14, 11), types[count % len(types)], generator)
            path = folder / f"packing-{count}.zarr"
            write_ome(path, values, (3, 2, 1), version=2, chunks=(4, 5, 6), compressor=compressor, order=order,
                      dimension_separator=separator, write_empty_chunks=bool(count % 2))
            same(read(dump, path), values.T.astype(float), matrix((3, 2, 1)), f"{compressor} {order} {values.dtype}")
            count += 1
    for codecs in ((), ("gzip",), ("zstd",), ("blosc",), ("crc32c",), ("zstd", "crc32c")):
        for endian, order, encoding, separator, inner in (
                ("little", None, "default", "/", None), ("big", [2, 1, 0], "v2", ".", None),
                ("little", [1, 2, 0], "default", ".", None), ("big", None, "default", "/", (2, 5, 3))):
            values = volume((9, 14, 11), ("uint8", "uint16", "int32", "float64")[count % 4], generator)
            path = folder / f"packing-{count}.zarr"
            write_ome(path, values, (3, 2, 1), version=3, chunk=(4, 5, 6), codecs=codecs, endian=endian, order=order,
                      encoding=encoding, separator=separator, inner=inner)
            same(read(dump, path), values.T.astype(float), matrix((3, 2, 1)), f"{codecs} {endian} {order} {inner}")
            count += 1
    return count


def test_units_and_places(dump, folder, generator):
    count = 0
    for unit, size in {"micrometer": 1e-3, "nanometer": 1e-6, "millimeter": 1, "centimeter": 10, "meter": 1000}.items():
        axes = [{**axis, "unit": unit} for axis in AXES]
        values = volume((6, 5, 4), "u2", generator)
        scale, translation = generator.uniform(0.1, 4, 3), generator.uniform(-50, 50, 3)
        write_ome(folder / f"{unit}.zarr", values, scale, list(translation), axes)
        same(read(dump, folder / f"{unit}.zarr"), values.T, matrix(scale, translation, size), unit)
        count += 1
    values = volume((6, 5, 4), "u2", generator)
    write_ome(folder / "none.zarr", values, (2, 1, 1), axes=[{"name": n, "type": "space"} for n in "zyx"])
    same(read(dump, folder / "none.zarr"), values.T, None, "no unit")
    write_ome(folder / "ell.zarr", values, (2, 1, 1), axes=[{"name": n, "type": "space", "unit": "ell"} for n in "zyx"])
    check("'ell'" in str(read(dump, folder / "ell.zarr")), "a unit that is none is taken")
    zarr.save_array(str(folder / "bare.zarr"), values)
    same(read(dump, folder / "bare.zarr"), values.T, None, "an array alone")
    # All 48 orientations: array axes in any order, each running either way.
    for number, direction in enumerate(orientations()):
        axes, scale, translation = [], generator.uniform(0.1, 4, 3), generator.uniform(-50, 50, 3)
        placed = numpy.zeros((3, 4))
        for axis in range(3):  # k, j, i
            row = int(numpy.abs(direction[:, 2 - axis]).argmax())
            sign = int(direction[row, 2 - axis])
            axes.append({"name": "xyz"[row], "type": "space", "unit": "millimeter",
                         "orientation": {"type": "anatomical", "value": WORDS[row, sign]}})
            placed[row, 2 - axis] = sign * scale[axis]
            placed[row, 3] = sign * translation[axis]
        values = volume((4, 6, 5), "u1", generator)
        write_ome(folder / f"o{number}.zarr", values, scale, list(translation), axes, **(
            {"version": 2, "chunks": (3, 3, 3)} if number % 2 else {"version": 3, "chunk": (3, 3, 3)}))
        same(read(dump, folder / f"o{number}.zarr"), values.T, placed, f"orientation {number}")
        count += 1
    return count + 3


def test_levels_labels_and_channels(dump, folder, generator):
    fine, coarse = volume((8, 6, 10), "u2", generator), volume((4, 3, 5), "u2", generator)
    root = zarr.open_group(str(folder / "image.zarr"), mode="w")
    grey = numpy.array([[volume((8, 6, 10), "u2", generator) for _ in range(3)] for _ in range(2)])
    root.create_dataset("0", data=grey, chunks=(1, 2, 4, 4, 4))
    root.attrs["multiscales"] = [{"version": "0.4", "datasets": [{"path": "0", "coordinateTransformations": [
        {"type": "scale", "scale": [1, 1, 4, 2, 2]}]}], "axes": [{"name": "t", "type": "time"},
                                                                  {"name": "c", "type": "channel"}, *AXES]}]
    labels = root.create_group("labels")
    labels.attrs["labels"] = ["cells", "nuclei"]
    cells = labels.create_group("cells")
    labels.create_group("nuclei")
    cells.create_dataset("fine", data=fine, chunks=(3, 3, 3))
    cells.create_dataset("coarse", data=coarse, chunks=(3, 3, 3))
    value = int(fine.max())
    cells.attrs["image-label"] = {"colors": [{"label-value": value, "rgba": [255, 51, 0, 255]}],
                                  "properties": [{"label-value": value, "name": "the largest"}]}
    cells.attrs["multiscales"] = [{"version": "0.4", "axes": AXES, "coordinateTransformations": [
        {"type": "scale", "scale": [2, 2, 2]}], "datasets": [
        {"path": "fine", "coordinateTransformations": [{"type": "scale", "scale": [2, 1, 1]}]},
        {"path": "coarse", "coordinateTransformations": [{"type": "scale", "scale": [4, 2, 2]},
                                                         {"type": "translation", "translation": [1, 0.5, 0.5]}]}]}]
    path = folder / "image.zarr/labels/cells"
    found = read(dump, path)
    same(found, fine.T, matrix((4, 2, 2)), "finest level")
    check(found["names"][str(value)] == "the largest" and found["colors"][str(value)][:2] == [1, 0.2], "image-label")
    same(read(dump, path, "level=1"), coarse.T, matrix((8, 4, 4), (2, 1, 1)), "level 1")
    same(read(dump, path / "coarse"), coarse.T, matrix((8, 4, 4), (2, 1, 1)), "a level by its folder")
    same(read(dump, str(path) + "/"), fine.T, matrix((4, 2, 2)), "a slash at the end")
    check("cells, nuclei" in str(read(dump, folder / "image.zarr/labels")), "labels are not named")
    for time, channel in itertools.product(range(2), range(3)):
        same(read(dump, folder / "image.zarr", f"volume={time}", f"component={channel}"), grey[time, channel].T,
             matrix((4, 2, 2)), f"time {time} channel {channel}")
    check("--volume 0 to --volume 1" in str(read(dump, folder / "image.zarr")), "time points are not asked for")
    check("--component" in str(read(dump, folder / "image.zarr", "volume=0")), "channels are not asked for")
    return 10


def test_parts(dump, folder, generator):
    """Chunks beside the part may be damaged or gone: nobody reads them."""
    values = numpy.zeros((12, 12, 12), "u1")
    values[5, 6, 7] = 9
    values[11, 0, 0] = 4
    write_ome(folder / "part.zarr", values, (1, 1, 1), chunks=(4, 4, 4), compressor=numcodecs.Zlib(),
              write_empty_chunks=True)
    for file in (folder / "part.zarr/0").glob("[0-9]*"):
        if file.name != "1.1.1":
            file.write_bytes(b"damaged")
    found = read(dump, folder / "part.zarr", "crop=4:8,4:8,4:8")
    check(not isinstance(found, str) and found["boxes"] == {"9": [[7, 6, 5], [1, 1, 1]]}, f"a part: {found}")
    check("does not unpack" in str(read(dump, folder / "part.zarr")), "damaged chunks are read as something")
    (folder / "part.zarr/0/1.1.1").unlink()
    check("nothing but background" in str(read(dump, folder / "part.zarr", "crop=4:8,4:8,4:8")), "a chunk that is gone")
    return 3


def test_refusals(dump, folder, generator):
    values = volume((6, 5, 4), "u2", generator)
    cases = {
        "lz4": dict(compressor=numcodecs.LZ4()), "delta": dict(filters=[numcodecs.Delta("u2")]),
        "fill": dict(fill_value=None, write_empty_chunks=False, chunks=(2, 2, 2)),
    }
    for name, how in cases.items():
        write_ome(folder / f"{name}.zarr", values, (1, 1, 1), **how)
    (next((folder / "fill.zarr/0").glob("[0-9]*"))).unlink()
    check("'lz4'" in str(read(dump, folder / "lz4.zarr")), "lz4 is not refused by its name")
    check("'delta'" in str(read(dump, folder / "delta.zarr")), "a filter is not refused by its name")
    check("no value is named" in str(read(dump, folder / "fill.zarr")), "a chunk that is not there is guessed")
    write_ome(folder / "huge.zarr", values, (1, 1, 1))
    meta = folder / "huge.zarr/0/.zarray"
    for shape in ([60000, 50000, 40000], [2**30, 2**30, 2**30]):
        meta.write_text(json.dumps({**json.loads(meta.read_text()), "shape": shape}))
        check(isinstance(read(dump, folder / "huge.zarr"), str), f"a shape of {shape} is believed")
    outside = json.loads((folder / "huge.zarr/.zattrs").read_text())
    outside["multiscales"][0]["datasets"][0]["path"] = "../bare.zarr"
    (folder / "huge.zarr/.zattrs").write_text(json.dumps(outside))
    check("does not lie in it" in str(read(dump, folder / "huge.zarr")), "a store leads out of itself")
    return 6


def main(dump):
    generator = seed()
    count = 0
    with tempfile.TemporaryDirectory() as name:
        for test in (test_packings, test_units_and_places, test_levels_labels_and_channels, test_parts, test_refusals):
            folder = pathlib.Path(name) / test.__name__
            folder.mkdir()
            count += test(dump, folder, generator)
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
