#!/usr/bin/env python3
"""Figures 13 and 14: high resolutions of meshes: time, memory, topology, and a picture of each."""

import os
import tempfile

from common import Core, Meshes, arguments, core, paint, plt, standing_view, save, write_table
from figure_10_12 import read_off

NAMES = ["elephant", "elk", "femur"]


def main():
    options = arguments(__doc__, "1024,2048", "64")
    meshes = Meshes(options.meshes)
    jobs = [(name, n) for n in options.resolutions for name in (NAMES if n < 2048 and not options.small else NAMES[:1])]
    rows = []
    figure, panels = plt.subplots(-(-len(jobs) // 2), min(2, len(jobs)), squeeze=False, figsize=(8.4, 3.1 * -(-len(jobs) // 2)))
    for panel in panels.flat:
        panel.set_axis_off()
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "core.vtp")
        for (name, n), panel in zip(jobs, panels.flat):
            # The finer the voxels the smaller a lambda may be: figure 14 shows more detail at 2048.
            part = "1.25%" if n >= 2048 else "2.5%"
            report = core(options.program, meshes.path(name), folder, "--resolution", n, "--lambda", part, "-o", out)
            label = report["labels"][0]
            pruned = label["pruned"][0]
            seconds = report["seconds"]
            topology = lambda one: f"{one['euler']}: {'/'.join(map(str, one['betti']))}"  # noqa: E731
            rows.append([name, n, part, label["voxels"], label["boundary_vertices"], seconds["read"], seconds["delaunay"],
                         seconds["core"], seconds["prune"], seconds["total"], float(report["peak_memory_mb"]),
                         topology(label["shape"]), topology(pruned)])
            paint(panel, Core(out), standing_view(read_off(meshes.path(name))[0]), pixels=420)
            panel.set_title(f"{name} {n}, lambda {part}", fontsize=9)
    write_table(options.output, "figure-13",
                ["mesh", "resolution", "lambda", "voxels", "boundary vertices", "s voxelize", "s Delaunay", "s core", "s prune",
                 "s total", "memory MB", "shape chi: b0/b1/b2", "pruned core"], rows)
    save(figure, options.output, "figure-13")


if __name__ == "__main__":
    main()
