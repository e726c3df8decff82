"""Damaged files: each must be read or refused within 10 seconds, by a process that survives it and does not take more
memory than what the file's bytes can stand for. The process reads one after the other; a new one takes its place when
it dies.

usage: damaged_files.py DUMP_PROGRAM mgh|numpy|bmp|zarr|tiff|lsm|vti|precomputed COUNT
exit 77: what writes the format is not there
"""
import json
import os
import pathlib
import random
import re
import resource
import select
import shutil
import subprocess
import sys
import tempfile
import time

SECONDS = 10
LIMIT = 1 << 30     # bytes of address space
ROOM = 48 << 20     # what the program takes by itself, and its buffers
LARGEST_RUN = 1100  # bytes that one packed by gzip can stand for; what blosc and zstd unpack is held against this, too


def write_mgh(folder):
    import nibabel
    import numpy
    values = numpy.zeros((20, 18, 16), numpy.int16)
    values[3:12, 4:9, 2:14] = 7
    for name in ("a.mgh", "b.mgz"):
        nibabel.save(nibabel.MGHImage(values, numpy.diag([-1, 2, 1.5, 1])), folder / name)
    return [[folder / "a.mgh"], [folder / "b.mgz"]], [folder / "a.mgh", folder / "b.mgz"]


def write_numpy(folder):
    import numpy
    values = numpy.zeros((20, 18, 16), numpy.int16)
    values[3:12, 4:9, 2:14] = 7
    names = [folder / "a.npy", folder / "b.npy"]
    numpy.save(names[0], values)
    numpy.save(names[1], numpy.asfortranarray(values.astype(">u4")))
    return [[name] for name in names], names


def write_bmp(folder):
    import numpy
    from PIL import Image
    values = numpy.zeros((40, 31), numpy.uint8)
    values[3:12, 4:9] = 7
    names = []
    for mode in ("1", "L", "RGB"):
        names.append(folder / f"{mode}.bmp")
        Image.fromarray(values).convert(mode).save(names[-1])
    for mode in ("L", "RGB"):
        names.append(folder / f"{mode}.jpg")
        Image.fromarray(values).convert(mode).save(names[-1], progressive=mode == "RGB")
    return [[name] for name in names], names


def write_tiff(folder):
    import numpy
    import tifffile
    values = numpy.zeros((2, 6, 2, 20, 16), numpy.uint16)
    values[:, 1:5, :, 3:12, 4:9] = 7
    tifffile.imwrite(folder / "a.tif", values, imagej=True, resolution=(2, 2),
                     metadata={"axes": "TZCYX", "spacing": 1, "unit": "um"})
    tifffile.imwrite(folder / "b.tif", values, ome=True, metadata={
        "axes": "TZCYX", "PhysicalSizeX": 1, "PhysicalSizeY": 1, "PhysicalSizeZ": 2})
    tifffile.imwrite(folder / "c.tif", values[0, :, 0], photometric="minisblack", compression="zlib", tile=(16, 16))
    tifffile.imwrite(folder / "d.tif", values[0, :, 0], photometric="minisblack", bigtiff=True)
    tifffile.imwrite(folder / "e.tif", values[0, :, 0], imagej=True, truncate=True, metadata={"axes": "ZYX"})
    names = [folder / f"{letter}.tif" for letter in "abcde"]
    return [[name] for name in names], names


def write_lsm(folder):
    import lsm_test
    import numpy
    values = numpy.zeros((2, 6, 20, 16), numpy.uint16)
    values[:, 1:5, 3:12, 4:9] = 7
    lsm_test.write_lsm(folder / "a.lsm", values[:1], (1e-6, 1e-6, 2e-6))
    lsm_test.write_lsm(folder / "b.lsm", values, (1e-6, 1e-6, 2e-6))
    names = [folder / "a.lsm", folder / "b.lsm"]
    return [[name] for name in names], names


def write_zarr(folder):
    import numcodecs
    import numpy
    import zarr_test
    values = numpy.zeros((12, 14, 16), numpy.uint16)
    values[2:9, 3:11, 4:13] = 7
    stores = []
    for number, compressor in enumerate((numcodecs.Blosc("lz4"), numcodecs.Blosc("zstd", shuffle=2), numcodecs.Zlib(),
                                         numcodecs.Zstd(), None)):
        stores.append(folder / f"v2-{number}.zarr")
        zarr_test.write_ome(stores[-1], values, (2, 1, 1), chunks=(6, 6, 6), compressor=compressor)
    for number, how in enumerate(({"codecs": ("zstd", "crc32c")}, {"codecs": ("blosc",), "inner": (3, 2, 6)},
                                  {"codecs": (), "inner": (6, 6, 6)}, {"codecs": ("gzip",), "order": [2, 0, 1]})):
        stores.append(folder / f"v3-{number}.zarr")
        zarr_test.write_ome(stores[-1], values, (2, 1, 1), version=3, chunk=(6, 6, 6), **how)
    # Metadata are as many as chunks.
    return [sorted(p for p in store.rglob("*") if p.is_file()) +
            [p for p in store.rglob("*") if p.is_file() and p.read_bytes()[:1] == b"{"] * 6 for store in stores], stores


def write_vti(folder):
    import numpy
    import vti_test
    values = numpy.zeros((20, 18, 16), numpy.int16)
    values[3:12, 4:9, 2:14] = 7
    names = []
    for mode, packed, base64 in (("ascii", False, True), ("binary", False, True), ("binary", True, True),
                                 ("appended", False, False), ("appended", True, False), ("appended", True, True)):
        names.append(folder / f"{len(names)}.vti")
        vti_test.write(names[-1], vti_test.image_of(values), mode, packed, base64=base64)
    return [[name] for name in names], names


def write_precomputed(folder):
    import numpy
    import precomputed_test
    values = numpy.zeros((12, 14, 16), numpy.uint64)
    values[2:9, 3:11, 4:13] = 7
    shards = {"hash": "identity", "preshift_bits": 0, "minishard_bits": 1, "shard_bits": 1,
              "minishard_index_encoding": "gzip", "data_encoding": "gzip"}
    stores = []
    for how in ({}, {"packed": ".gz"}, {"encoding": "compressed_segmentation"}, {"sharding": shards},
                {"sharding": {**shards, "minishard_index_encoding": "raw", "data_encoding": "raw",
                              "hash": "murmurhash3_x86_128"}, "encoding": "compressed_segmentation"}):
        stores.append(folder / f"store{len(stores)}")
        precomputed_test.write(stores[-1], values, chunk=(6, 6, 6), **how)
    return [sorted(p for p in store.rglob("*") if p.is_file()) + [store / "info"] * 6 for store in stores], stores


def damaged(data, dice):
    data = bytearray(data)
    way = dice.randrange(8)
    at = dice.randrange(len(data)) if data else 0
    if way == 0:
        return bytes(data[:at])
    if way == 1:
        return bytes(data[:at] + dice.randbytes(dice.randrange(1, 40)) + data[at:])
    if way == 2:
        return bytes(data[:at] + data[at + dice.randrange(1, 40):])
    if way == 3 and data[:1] == b"{":  # another number
        numbers = list(re.finditer(rb"-?\d+(\.\d+)?", bytes(data)))
        if numbers:
            match = dice.choice(numbers)
            value = dice.choice([b"0", b"-1", b"1", b"3.5", b"1e9", b"2147483648", b"4294967296", b"99999", b"1e400",
                                 b"18446744073709551615", b"null", b"\"7\"", b"[]", b"{}", b"1000", b"17"])
            return bytes(data[:match.start()] + value + data[match.end():])
    if way in (3, 4):  # a number of the header
        at = dice.randrange(min(len(data), 400)) if data else 0
        data[at:at + 4] = dice.choice([b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\0\0\0\0", b"\0\1\0\0", b"\0\0\1\0",
                                       b"\x80\0\0\0", dice.randbytes(4)])
        return bytes(data)
    for _ in range(dice.choice((1, 1, 2, 8))):
        if data:
            data[dice.randrange(len(data))] = dice.randrange(256)
    return bytes(data)


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def is_sanitized(program):
    """Whether AddressSanitizer is in it, which maps terabytes, holds freed memory back, and says what it finds."""
    return b"__asan_init" in pathlib.Path(program).read_bytes()


class Reader:
    """A process of DumpScan."""

    def __init__(self, dump):
        self.sanitized = is_sanitized(dump)
        self.process = subprocess.Popen([dump, "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        preexec_fn=None if self.sanitized else limited,
                                        stderr=None if self.sanitized else subprocess.DEVNULL,
                                        env={**os.environ, "OMP_NUM_THREADS": "1"})

    def read(self, words):
        """What it answers; None when it dies or takes too long, and then it is dead."""
        pathlib.Path(f"/proc/{self.process.pid}/clear_refs").write_text("5")  # VmHWM begins anew
        self.process.stdin.write(("\t".join(words) + "\n").encode())
        self.process.stdin.flush()
        answer, end = b"", time.monotonic() + SECONDS
        while not answer.endswith(b"\n"):
            ready, _, _ = select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))
            part = os.read(self.process.stdout.fileno(), 1 << 16) if ready else b""
            if not part:
                self.process.kill()
                self.process.wait()
                return None
            answer += part
        return json.loads(answer)

    def memory(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmHWM:\s+(\d+)", status).group(1)) << 10

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def main(dump, form, count):
    number = int(os.environ.get("VOXELCORE_SEED", random.randrange(2**31)))
    dice = random.Random(number)
    print("seed", number, flush=True)
    failures = slowest = largest = read = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        try:
            writers = {"mgh": write_mgh, "numpy": write_numpy, "bmp": write_bmp, "tiff": write_tiff, "lsm": write_lsm,
                       "zarr": write_zarr, "vti": write_vti, "precomputed": write_precomputed}
            parts, scans = writers[form](folder)
        except ImportError as missing:
            print(missing)
            return 77
        size = {scan: sum(p.stat().st_size for p in ([scan] if scan.is_file() else scan.rglob("*"))) for scan in scans}
        reader = Reader(dump)
        for _ in range(count):
            which = dice.randrange(len(scans))
            file, scan = dice.choice(parts[which]), scans[which]
            before = file.read_bytes()
            file.write_bytes(damaged(before, dice))
            options = dice.choice(([], [], ["volume=0", "component=0"], ["crop=2:9,1:8,3:5"]))
            begun = time.monotonic()
            answer = reader.read([str(scan), *options])
            seconds = time.monotonic() - begun
            memory = reader.memory() if answer is not None else 0
            slowest, largest = max(slowest, seconds), max(largest, memory)
            read += answer is not None and "refused" not in answer
            if answer is None or (memory > ROOM + LARGEST_RUN * size[scan] and not reader.sanitized):
                failures += 1
                print("FAILED", scan.name, file.name, *options, f"{seconds:.1f} s, {memory >> 20} MB,",
                      "dead" if answer is None else "alive", flush=True)
                kept = os.environ.get("VOXELCORE_KEEP")
                if kept:
                    target = pathlib.Path(kept) / f"{failures}-{scan.name}"
                    (shutil.copytree if scan.is_dir() else shutil.copy)(scan, target)
            if answer is None:
                reader = Reader(dump)
            file.write_bytes(before)
        reader.close()
    print(f"{count} damaged {form} files: {read} read, {count - read - failures} refused, {failures} failures; "
          f"longest {slowest:.2f} s, largest {largest / 2**20:.0f} MB")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3])))
