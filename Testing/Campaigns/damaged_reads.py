"""Damaged files of every format, read in one process each: thousands a second.

usage: damaged_reads.py --programs DIR [--totals FILE] [--minutes M] [--rounds N] [--chunk N]
       [--formats a,b]

The whole files are those of damaged_files.py. A round reads a chunk of each. Goes on where the totals say."""

import argparse
import os
import sys
import tempfile
import time

from campaign import Totals, run
from damaged_files import Seeds

FORMATS = {"scan.nrrd": "scan", "gz.nrrd": "scan", "raw.nrrd": "scan", "text.nrrd": "scan", "mask.nii.gz": "scan",
           "a.nii": "scan", "a.mha": "scan", "a.tif": "scan", "a.off": "mesh", "a.obj": "mesh", "a.ply": "mesh",
           "a.stl": "mesh", "a.vtk": "mesh", "core.vtp": "model", "core.vtk": "model", "edges.vtp": "model",
           "edges_skeleton.vtp": "skeleton", "manifest.csv": "manifest", "edits.txt": "changes",
           # A name with a folder is part of the scan that is the folder, but for headers.
           "a.mgh": "scan", "a.mgz": "scan", "a.lsm": "scan", "a.ome.tif": "scan", "slices/s1.png": "scan",
           "a.zarr/.zattrs": "scan", "a.zarr/0/.zarray": "scan", "a.zarr/0/0/0/0": "scan", "b.zarr/zarr.json": "scan",
           "b.zarr/c/0/0/0": "scan", "a.seg.nrrd": "scan", "numbered/a.nhdr": "scan", "numbered/a.mhd": "scan"}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--rounds", type=int, default=10**9)
    parser.add_argument("--chunk", type=int, default=1000)
    parser.add_argument("--formats", default=",".join(FORMATS))
    options = parser.parse_args()
    totals = Totals(options.totals, "damaged reads")
    before = len(totals.of["found"])
    until = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory(prefix="voxelcore-reads-") as folder:
        seeds = Seeds(os.path.abspath(os.path.join(options.programs, "voxelcore")), folder)
        while time.monotonic() < until and options.rounds > 0:
            options.rounds -= 1
            for name in options.formats.split(","):
                first = totals.place(name)
                code, out, error, _ = run([os.path.join(options.programs, "VoxelCoreDamagedReads"), FORMATS[name],
                                           folder, name, first, options.chunk], limit=3600)
                *lines, last = out.splitlines() or [""]
                if code == 0:
                    read, refused = map(int, last.split())
                    totals.count(f"{name}, read", read)
                    totals.count(f"{name}, refused", refused)
                else:
                    for line in lines + [last] if code != 1 or len(last.split()) != 2 else lines:
                        totals.found(f"{name}: {line}"[:400])
                    if not out:
                        totals.found(f"{name}, seeds from {first}: exit {code}: {error.strip()}"[:400])
                totals.ran(options.chunk)
                totals.place(name, first + options.chunk)
                totals.save()
                if time.monotonic() > until:
                    break
    print(totals.of["runs"], "files,", len(totals.of["found"]), "found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
