#!/usr/bin/env python3
"""Figures 13 and 14: high resolutions of meshes: time, memory, topology, and a picture of each."""

import os
import tempfile

from common import Meshes, arguments, core, run, write_table

NAMES = ["elephant", "elk", "femur"]


def main():
    options = arguments(__doc__, "1024,2048", "64")
    meshes = Meshes(options.meshes)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "core.vtp")
        for n in options.resolutions:
            for name in NAMES if n < 2048 and not options.small else NAMES[:1]:
                report = core(options.program, meshes.path(name), folder, "--resolution", n, "--lambda", "2.5%", "-o", out)
                label = report["labels"][0]
                pruned = label["pruned"][0]
                seconds = report["seconds"]
                topology = lambda one: f"{one['euler']}: {'/'.join(map(str, one['betti']))}"  # noqa: E731
                rows.append([name, n, label["voxels"], label["boundary_vertices"], seconds["read"], seconds["delaunay"],
                             seconds["core"], seconds["prune"], seconds["total"], float(report["peak_memory_mb"]),
                             topology(label["shape"]), topology(pruned)])
                run(options.program, "render", out, "-o", os.path.join(options.output, f"figure-13-{name}-{n}.png"),
                    "--size", "900x700", "--force")
    write_table(options.output, "figure-13",
                ["mesh", "resolution", "voxels", "boundary vertices", "s voxelize", "s Delaunay", "s core", "s prune", "s total",
                 "memory MB", "shape chi: b0/b1/b2", "pruned core"], rows)


if __name__ == "__main__":
    main()
