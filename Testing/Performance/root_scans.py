#!/usr/bin/env python3
"""`roots` on grey slices of a root system too large for most programs: elapsed time, peak memory, topology.

usage: root_scans.py PROGRAM [--size 1600] [--laterals 40] [--limit 12000] [--folder FOLDER]

The mask of a phantom with five contacts is made grey slice by slice (background 90, root 210, a noise of 9 that is
nearly normal) and written as one TIFF a slice, so that nothing here holds the volume. `roots` reads them without any
option but the voxel size, under a limit in MB for what it allocates; nothing is downsampled. The mask that comes out
must be one piece without loops and cavities. With --folder, slices that are there are used again.
"""
import argparse
import json
import os
import random
import sys
import tempfile

from blocks_memory import expect, run
from large_scan import slices_of, write_tiff


def grey(voxels, noise):
    """A slice of bytes 0 and 1 as grey values; the noise begins at a random place of a long table."""
    tone = bytes.maketrans(bytes([0, 1]), bytes([60, 180]))
    start = random.randrange(len(noise) - len(voxels))
    lift = int.from_bytes(noise[start:start + len(voxels)], "little")
    # Bytes are added all at once: none goes over 255.
    return (int.from_bytes(voxels.translate(tone), "little") + lift).to_bytes(len(voxels), "little")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=1600)
    parser.add_argument("--laterals", type=int, default=40)
    parser.add_argument("--limit", type=int, default=12000)
    parser.add_argument("--folder")
    options = parser.parse_args()
    program, size = os.path.realpath(options.program), options.size
    temporary = tempfile.TemporaryDirectory(dir=options.folder)
    slices = f"{options.folder or temporary.name}/slices-{size}"
    if not os.path.isdir(slices):
        mask = f"{temporary.name}/mask.nrrd"
        code, _, _, said = run([program, "phantom", "root", "--size", str(size), "--spacing", "0.1,0.1,0.1",
                                "--laterals", str(options.laterals), "--sub-laterals", "6", "--contacts", "5",
                                "-o", mask, "-q"])
        expect(code == 0, said)
        random.seed(1)
        # Sums of four even numbers from 0 to 15: a standard deviation of 9.2, 0.08 of the contrast.
        noise = bytes(random.randrange(16) + random.randrange(16) + random.randrange(16) + random.randrange(16)
                      for _ in range(1 << 16)) * (size * size // (1 << 16) + 3)
        os.makedirs(slices)
        for number, voxels in enumerate(slices_of(mask, size)):
            write_tiff(grey(voxels, noise), size, f"{slices}/{number:05d}.tif")
        os.remove(mask)
    out = f"{temporary.name}/out/"
    code, peak, seconds, said = run([program, "roots", slices, "--spacing", "0.1,0.1,0.1", "--no-pictures", "-o", out],
                                    options.limit)
    expect(code == 0, f"exit code {code}: {said}")
    with open(f"{out}report.json", encoding="utf-8") as file:
        report = json.load(file)
    label = report["labels"][0]
    expect(label["shape"]["betti"] == [1, 0, 0], f"pieces, loops, cavities: {label['shape']['betti']}")
    print(f"{size}^3: {label['voxels']} voxels, {label['boundary_vertices']} boundary vertices, "
          f"{report['roots']['axes']} roots, {len(report['roots']['contacts'])} contacts, {seconds:.0f} s, "
          f"{peak:.0f} MB")


if __name__ == "__main__":
    sys.exit(main())
