"""Neuroglancer's precomputed volumes, as a writer by their specification has them: raw and compressed_segmentation,
plain, by gzip and in shards, several resolutions, an offset, missing chunks, names; and what is refused.

usage: precomputed_test.py DUMP_PROGRAM      exit 77: NumPy is not there
"""
import gzip
import itertools
import json
import pathlib
import struct
import sys
import tempfile

try:
    import numpy
except ImportError:
    print("python3-numpy is not installed")
    sys.exit(77)

from oracles import check, finish, read, same, seed, volume


def compressed_segmentation(values, block):
    """One channel [x, y, z] of uint32 or uint64."""
    width = values.dtype.itemsize // 4
    grid = [-(-side // step) for side, step in zip(values.shape, block)]
    headers, body, tables = [], [], {}
    first = 2 * grid[0] * grid[1] * grid[2]
    for z, y, x in itertools.product(range(grid[2]), range(grid[1]), range(grid[0])):
        low = [n * step for n, step in zip((x, y, z), block)]
        part = values[tuple(slice(a, a + step) for a, step in zip(low, block))]
        found = numpy.unique(part)
        bits = next(b for b in (0, 1, 2, 4, 8, 16, 32) if len(found) <= 2 ** b)
        place = numpy.zeros(block, numpy.uint64)
        place[tuple(slice(0, side) for side in part.shape)] = numpy.searchsorted(found, part)
        codes = place.reshape(-1, order="F")
        at = first + len(body)
        if bits:
            words = [0] * (-(-len(codes) * bits // 32))
            for n, code in enumerate(codes.tolist()):
                words[n * bits // 32] |= code << (n * bits % 32)
            body += words
        key = tuple(found.tolist())
        if key not in tables:  # blocks may share one
            tables[key] = first + len(body)
            for value in key:
                body += [value & 0xFFFFFFFF] + ([value >> 32] if width == 2 else [])
        headers += [tables[key] | bits << 24, at]
    return struct.pack(f"<{1 + len(headers) + len(body)}I", 1, *headers, *body)


def morton(place, grid):
    code = to = 0
    for bit in range(32):
        for value, side in zip(place, grid):
            if 2 ** bit < side:
                code |= (value >> bit & 1) << to
                to += 1
    return code


def murmur(number):
    """MurmurHash3_x86_128, low 64 bits, after the reference in C++."""
    mask = 0xFFFFFFFF
    c = [0x239b961b, 0xab0e9789, 0x38b34ae5, 0xa1e38b93]

    def turn(x, r):
        return (x << r | x >> (32 - r)) & mask

    def final(h):
        h ^= h >> 16
        h = h * 0x85ebca6b & mask
        h ^= h >> 13
        h = h * 0xc2b2ae35 & mask
        return h ^ h >> 16

    low, high = number & mask, number >> 32
    h = [turn(low * c[0] & mask, 15) * c[1] & mask, turn(high * c[1] & mask, 16) * c[2] & mask, 0, 0]
    h = [x ^ 8 for x in h]
    h[0] = sum(h) & mask
    h[1:] = [(x + h[0]) & mask for x in h[1:]]
    h = [final(x) for x in h]
    h[0] = sum(h) & mask
    return h[0] | ((h[1] + h[0]) & mask) << 32


def write_shards(folder, chunks, sharding):
    pack = gzip.compress if sharding["data_encoding"] == "gzip" else bytes
    pack_index = gzip.compress if sharding["minishard_index_encoding"] == "gzip" else bytes
    shards = {}
    for number, data in sorted(chunks.items()):
        code = number >> sharding["preshift_bits"]
        code = murmur(code) if sharding["hash"] != "identity" else code
        mini = code & (2 ** sharding["minishard_bits"] - 1)
        shard = code >> sharding["minishard_bits"] & (2 ** sharding["shard_bits"] - 1)
        shards.setdefault(shard, {}).setdefault(mini, []).append((number, pack(data)))
    for shard, minis in shards.items():
        body, index = b"", b""
        tables = {}
        for mini, members in sorted(minis.items()):
            rows, before, end = [[], [], []], 0, 0
            for number, data in members:
                rows[0].append(number - before)
                rows[1].append(len(body) - end)
                rows[2].append(len(data))
                before = number
                body += data
                end = len(body)
            tables[mini] = pack_index(numpy.array(rows, "<u8").tobytes())
        for mini in range(2 ** sharding["minishard_bits"]):
            start = len(body)
            body += tables.get(mini, b"")
            index += struct.pack("<QQ", start, len(body))
        digits = -(-sharding["shard_bits"] // 4)
        name = f"{shard:0{digits}x}" if digits else "0"
        (folder / f"{name}.shard").write_bytes(index + body)


def write(folder, values, resolution=(8, 8, 40), chunk=(4, 4, 4), offset=(0, 0, 0), encoding="raw", packed="",
          sharding=None, names=None, sparse=False):
    """`values[x, y, z]`, also a list of resolutions."""
    levels = values if isinstance(values, list) else [values]
    info = {"@type": "neuroglancer_multiscale_volume", "type": "segmentation", "num_channels": 1,
            "data_type": levels[0].dtype.name, "scales": []}
    for level, data in enumerate(levels):
        scale = {"key": f"s{level}", "size": list(data.shape), "voxel_offset": list(offset),
                 "resolution": [side * 2 ** level for side in resolution], "chunk_sizes": [list(chunk)],
                 "encoding": encoding}
        if encoding != "raw":
            scale["compressed_segmentation_block_size"] = [3, 2, 4]
        if sharding:
            scale["sharding"] = {"@type": "neuroglancer_uint64_sharded_v1", **sharding}
        info["scales"].append(scale)
        target = folder / scale["key"]
        target.mkdir(parents=True)
        grid = [-(-side // step) for side, step in zip(data.shape, chunk)]
        chunks = {}
        for place in itertools.product(*map(range, grid)):
            low = [n * step for n, step in zip(place, chunk)]
            part = data[tuple(slice(a, a + step) for a, step in zip(low, chunk))]
            if sparse and not part.any():
                continue
            stored = (part.astype(part.dtype.newbyteorder("<")).tobytes(order="F") if encoding == "raw"
                      else compressed_segmentation(part, (3, 2, 4)))
            if sharding:
                chunks[morton(place, grid)] = stored
                continue
            name = "_".join(f"{o + a}-{o + a + side}" for o, a, side in zip(offset, low, part.shape))
            file = target / (name + (".gz" if packed == ".gz" else ""))
            file.write_bytes(gzip.compress(stored) if packed else stored)
        if sharding:
            write_shards(target, chunks, sharding)
    if names:
        info["segment_properties"] = "names"
        (folder / "names").mkdir()
        (folder / "names/info").write_text(json.dumps({"@type": "neuroglancer_segment_properties", "inline": {
            "ids": list(map(str, names)), "properties": [
                {"id": "label", "type": "label", "values": list(names.values())}]}}))
    (folder / "info").write_text(json.dumps(info))
    return folder


def main(dump):
    generator = seed()
    count = 0

    def matrix(resolution, offset=(0, 0, 0)):
        step = numpy.array(resolution) * 1e-6
        return numpy.column_stack([numpy.diag(step), (numpy.array(offset) + .5) * step])

    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)

        def store(*args, **options):
            nonlocal count
            count += 1
            return write(root / f"store{count}", *args, **options)

        for kind in ("u1", "u2", "u4", "u8"):
            values = volume((11, 9, 14), kind, generator)
            for packed in ("", "inside", ".gz"):
                same(read(dump, store(values, packed=packed)), values, matrix((8, 8, 40)), f"raw {kind} {packed}")
            if kind in ("u4", "u8"):
                for packed in ("", "inside"):
                    same(read(dump, store(values, encoding="compressed_segmentation", packed=packed)), values,
                         matrix((8, 8, 40)), f"compressed_segmentation {kind} {packed}")
                many = generator.permutation(11 * 9 * 14).astype(kind).reshape(11, 9, 14) + numpy.array(1, kind)
                found = read(dump, store(many, encoding="compressed_segmentation", chunk=(11, 9, 14)))
                boxes = {str(int(many[tuple(at)])): [at.tolist(), [1, 1, 1]] for at in numpy.argwhere(many)}
                check(not isinstance(found, str) and found["boxes"] == boxes, f"every voxel another {kind}")
        values = volume((11, 9, 14), "u8", generator)
        for hashed, preshift, mini, bits, packed in itertools.product(
                ("identity", "murmurhash3_x86_128"), (0, 1), (0, 2), (0, 3, 6), ("raw", "gzip")):
            how = {"hash": hashed, "preshift_bits": preshift, "minishard_bits": mini, "shard_bits": bits,
                   "minishard_index_encoding": packed, "data_encoding": packed}
            for encoding in ("raw", "compressed_segmentation"):
                same(read(dump, store(values, sharding=how, encoding=encoding, sparse=True)), values,
                     matrix((8, 8, 40)), f"{encoding} in shards {how}")
        moved = store(values, offset=(100, 200, -30), resolution=(500, 250, 125), sparse=True)
        same(read(dump, moved), values, matrix((500, 250, 125), (100, 200, -30)), "an offset, chunks missing")
        half = volume((6, 5, 7), "u8", generator)
        levels = store([values, half])
        same(read(dump, levels), values, matrix((8, 8, 40)), "the finest")
        same(read(dump, levels, "level=1"), half, matrix((16, 16, 80)), "the next")
        named = numpy.zeros((5, 5, 5), "u4")
        named[1:3, 1:3, 1:3] = 3
        found = read(dump, store(named, names={3: "axon"}))
        check(not isinstance(found, str) and found["boxes"] == {"3": [[1, 1, 1], [2, 2, 2]]}, f"names: {found}")
        broken = store(values, encoding="raw")
        info = json.loads((broken / "info").read_text())
        for change, words in (({"encoding": "png"}, "'png'"), ({"size": [11, 9]}, "three numbers"),
                              ({"resolution": [0, 8, 8]}, "resolution"), ({"chunk_sizes": []}, "chunk_sizes")):
            scale = {**info["scales"][0], **change}
            (broken / "info").write_text(json.dumps({**info, "scales": [scale]}))
            found = read(dump, broken)
            check(isinstance(found, str) and words in found and ";" in found, f"{change}: {found}")
        (broken / "info").write_text(json.dumps(info))
        chunk = next((broken / "s0").iterdir())
        data = chunk.read_bytes()
        for part in (0, 1, len(data) - 1):
            chunk.write_bytes(data[:part])
            check(isinstance(read(dump, broken), str), f"{part} bytes of a chunk are read")
    finish(count)


if __name__ == "__main__":
    main(sys.argv[1])
