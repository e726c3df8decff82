#!/usr/bin/env python3
"""One block of a scan far too large to be read, beside a job on the same voxels as a scan of their own.

usage: grid_block.py PROGRAM [--scan 16384] [--side 512] [--body 1024] [--threads 2] [--limit 600] [--folder FOLDER]

A root phantom of --body voxels a side lies about the middle of a bare scan of --scan voxels a side, in a sparse file:
what is empty takes no disk, so the folder's file system must have holes and files of that size. The block in the middle
is computed with --block-size, under a limit in MB for what the process allocates, and `core` on its voxels alone. With
all blocks that meet the body (--all) it also joins those of a scan of the body alone and compares bits.
"""
import argparse
import filecmp
import gzip
import os
import resource
import subprocess
import sys
import tempfile

from blocks_memory import expect, run


def processor_seconds():
    """Of all processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def voxels_of(path):
    """The voxels of a packed NRRD of bytes."""
    with open(path, "rb") as file:
        while file.readline().strip():
            pass
        return gzip.decompress(file.read())


def write_body(path, voxels, body, scan, first):
    """Rows that hold anything, into a file that is holes elsewhere."""
    file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_TRUNC)
    os.ftruncate(file, scan**3)
    empty = bytes(body)
    for z in range(body):
        for y in range(body):
            row = voxels[(z * body + y) * body:(z * body + y + 1) * body]
            if row != empty:
                os.pwrite(file, row, ((z + first) * scan + y + first) * scan + first)
    os.close(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scan", type=int, default=16384)
    parser.add_argument("--side", type=int, default=512)
    parser.add_argument("--body", type=int, default=1024)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--limit", type=int, default=600)
    parser.add_argument("--folder")
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    temporary = tempfile.TemporaryDirectory(dir=options.folder)
    folder = temporary.name
    common = ["--threads", str(options.threads), "--quiet", "--force"]
    body, side, scan = options.body, options.side, options.scan

    packed, bare = f"{folder}/body.nrrd", f"{folder}/scan.raw"
    subprocess.run([program, "phantom", "root", "--size", str(body), "-o", packed, "-q"], check=True)
    voxels = voxels_of(packed)
    expect(len(voxels) == body**3, "the phantom is not packed bytes")
    first = scan // side // 2 * side + side // 2 - body // 2  # the middle of a block is that of the body
    write_body(bare, voxels, body, scan, first)
    middle = scan // side // 2
    count = -(-scan // side)
    number = 1 + middle + count * (middle + count * middle)
    reading = ["--raw", f"{scan},{scan},{scan},uint8", "--spacing", "1,1,1", "--binary"]

    # What one block holds, as a scan of its own: a job takes the digest of its whole scan.
    own = f"{folder}/own.raw"
    low = middle * side - first  # of the body
    with open(own, "wb") as file:
        for z in range(low, low + side):
            for y in range(low, low + side):
                file.write(voxels[(z * body + y) * body + low:(z * body + y) * body + low + side])
    del voxels
    before = processor_seconds()
    code, alone, alone_seconds, said = run([
        program, "core", own, "-o", f"{folder}/alone.vtp", "--lambda", "1.5vox", "--raw", f"{side},{side},{side},uint8",
        "--spacing", "1,1,1", "--binary"
    ] + common)
    expect(code == 0, said)
    alone_processor = processor_seconds() - before
    code, peak, seconds, said = run([program, "core", bare, "-o", f"{folder}/parts/", "--block-size",
                                     str(side), "--block", str(number)] + reading + common, options.limit)
    expect(code == 0, f"the block fails under {options.limit} MB: {said}")
    processor = processor_seconds() - before - alone_processor
    print(
        f"block {number} of {count**3} of {scan}^3: {peak:.0f} MB, {seconds:.1f} s, {processor:.1f} s of processor; "
        f"its voxels alone as a whole job: {alone:.0f} MB, {alone_seconds:.1f} s, {alone_processor:.1f} s; "
        f"file {os.stat(bare).st_size / 1e12:.2f} TB, "
        f"{os.stat(bare).st_blocks * 512 / 1e9:.1f} GB on disk",
        flush=True)

    if options.all:
        small = ["core", packed, "--binary"]
        worst, total = 0, 0.0
        for block in range(1, (-(-body // side))**3 + 1):
            code, peak, seconds, said = run(
                [program] + small + ["-o", f"{folder}/small/", "--block-size",
                                     str(side), "--block", str(block)] + common, options.limit)
            expect(code == 0, said)
            worst, total = max(worst, peak), total + seconds
        code, join, _, said = run([program] + small + ["--join", f"{folder}/small", "-o", f"{folder}/joined.vtp"] +
                                  common)
        expect(code == 0, said)
        code, single, seconds, said = run([program] + small + ["-o", f"{folder}/single.vtp"] + common)
        expect(code == 0, said)
        same = filecmp.cmp(f"{folder}/joined.vtp", f"{folder}/single.vtp", shallow=False)
        expect(same, "the joined file has other bits")
        print(f"body {body}^3 in blocks of {side}: at most {worst:.0f} MB, {total:.1f} s together; join {join:.0f} MB; "
              f"single run {single:.0f} MB, {seconds:.1f} s; same bits")


if __name__ == "__main__":
    sys.exit(main())
