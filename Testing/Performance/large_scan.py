#!/usr/bin/env python3
"""Whole jobs on a phantom too large for dense bits: from a packed NRRD, from bare voxels and from TIFF slices.

usage: large_scan.py PROGRAM [--kind root] [--size 4096] [--forms gzip,raw,tiff] [--threads 2] [--limit 16000]
                     [--folder FOLDER]

The phantom is written packed; the other forms are made of it, the bare voxels as a sparse file (about a third of its
length on disk), the slices packed. Forms are made one at a time and removed. Each job prunes at 1.5vox and is ended
when it takes more than --limit MB of memory (what is resident: buffers are reserved for the worst and hardly touched).
Its certificate must hold, and all forms must give the same numbers. With --folder the packed phantom is kept and used
again.
"""
import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import time
import zlib

from blocks_memory import expect, run


def run_within(words, limit):
    """Exit code, peak memory in MB, seconds, what it said; ended over `limit` MB resident, before others suffer."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(words, stderr=said)
        peak = 0
        while child.poll() is None:
            try:
                with open(f"/proc/{child.pid}/status", encoding="ascii") as file:
                    peak = max([peak] + [int(line.split()[1]) * 1.024e-3 for line in file if line.startswith("VmHWM")])
            except FileNotFoundError:
                pass
            if peak > limit:
                child.kill()
            time.sleep(.2)
        said.seek(0)
        text = said.read().decode(errors="replace").strip()
    return child.returncode, peak, time.monotonic() - start, text if peak <= limit else f"over {limit} MB"


def slices_of(path, size):
    """The slices of a packed NRRD of bytes, one after the other."""
    with open(path, "rb") as file:
        while file.readline().strip():
            pass
        unpack, rest = zlib.decompressobj(31), b""
        for _ in range(size):
            parts, have = [rest], len(rest)
            while have < size * size:
                part = unpack.decompress(unpack.unconsumed_tail or file.read(1 << 20), 1 << 24)
                parts.append(part)
                have += len(part)
            whole = b"".join(parts)
            yield whole[:size * size]
            rest = whole[size * size:]


def write_raw(slices, path):
    """Pages of nothing stay holes."""
    page, empty = 1 << 16, bytes(1 << 16)
    with open(path, "wb") as file:
        at = 0
        for voxels in slices:
            for first in range(0, len(voxels), page):
                part = voxels[first:first + page]
                if part != empty[:len(part)]:
                    os.pwrite(file.fileno(), part, at + first)
            at += len(voxels)
        file.truncate(at)


def write_tiff(voxels, size, path):
    """One packed strip of bytes, after the TIFF 6.0 specification."""
    data = zlib.compress(voxels, 1)
    tags = [(256, 4, size), (257, 4, size), (258, 3, 8), (259, 3, 8), (262, 3, 1), (273, 4, 8), (277, 3, 1),
            (278, 4, size), (279, 4, len(data))]
    offset = 8 + len(data) + len(data) % 2
    entries = b"".join(struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in tags)
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHI", b"II", 42, offset) + data + b"\0" * (len(data) % 2))
        file.write(struct.pack("<H", len(tags)) + entries + struct.pack("<I", 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kind", default="root")
    parser.add_argument("--size", type=int, default=4096)
    parser.add_argument("--forms", default="gzip,raw,tiff")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--limit", type=int, default=16000)
    parser.add_argument("--folder")
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    temporary = tempfile.TemporaryDirectory(dir=options.folder)
    folder, size = temporary.name, options.size
    packed = f"{options.folder or folder}/{options.kind}-{size}.nrrd"
    if not os.path.exists(packed):
        code, peak, seconds, said = run([program, "phantom", options.kind, "--size", str(size), "-o", packed, "-q"])
        expect(code == 0, said)
        print(f"phantom: {peak:.0f} MB, {seconds:.0f} s, {os.stat(packed).st_size / 1e6:.0f} MB on disk", flush=True)
    numbers = None
    for form in options.forms.split(","):
        scan, reading = packed, []
        if form == "raw":
            scan = f"{folder}/scan.raw"
            reading = ["--raw", f"{size},{size},{size},uint8", "--spacing", "1,1,1"]
            write_raw(slices_of(packed, size), scan)
        elif form == "tiff":
            scan = f"{folder}/slices"
            reading = ["--spacing", "1,1,1"]
            os.makedirs(scan)
            for number, voxels in enumerate(slices_of(packed, size)):
                write_tiff(voxels, size, f"{scan}/{number:05d}.tif")
        report = f"{folder}/report.json"
        code, peak, seconds, said = run_within(
            [program, "core", scan, "-o", f"{folder}/core.vtp", "--lambda", "1.5vox", "--report", report, "--threads",
             str(options.threads), "--quiet", "--force"] + reading, options.limit)
        expect(code == 0, f"{form}: exit code {code}: {said}")
        with open(report, encoding="utf-8") as file:
            written = json.load(file)
        label = written["labels"][0]
        found = [label["voxels"], label["boundary_vertices"], label["shape"], label["core"]]
        expect(numbers in (None, found), f"{form}: other numbers")
        numbers = found
        stages = ", ".join(f"{stage} {value:.1f}" for stage, value in written["seconds"].items())
        print(f"{form}: {label['boundary_vertices']} boundary vertices, {peak:.0f} MB = "
              f"{1e6 * peak / label['boundary_vertices']:.0f} bytes each, {seconds:.0f} s ({stages})",
              flush=True)
        os.remove(f"{folder}/core.vtp")
        if form == "raw":
            os.remove(scan)
        elif form == "tiff":
            subprocess.run(["rm", "-r", scan], check=True)


if __name__ == "__main__":
    sys.exit(main())
