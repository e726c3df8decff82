#!/usr/bin/env python3
"""Figures 13 and 14: high resolutions of meshes: time, memory, topology, and a picture of each."""

import os
import resource
import tempfile

from common import Core, Kept, Meshes, arguments, core, hang, paint, plt, standing_view, save, write_table
from figure_10_12 import read_off

NAMES = ["elephant", "elk", "femur"]


def measure(options, meshes, name, n):
    """The table's row, and a picture."""
    # The finer the voxels the smaller a lambda may be: figure 14 shows more detail at 2048.
    part = "1.25%" if n >= 2048 else "2.5%"
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "core.vtp")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        report = core(options.program, meshes.path(name), folder, "--resolution", n, "--lambda", part, "-o", out)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        label = report["labels"][0]
        pruned = label["pruned"][0]
        seconds = report["seconds"]
        topology = lambda one: f"{one['euler']}: {'/'.join(map(str, one['betti']))}"  # noqa: E731
        row = [
            name, n, part, label["voxels"], label["boundary_vertices"], seconds["read"], seconds["delaunay"],
            seconds["core"], seconds["prune"], seconds["total"],
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            float(report["peak_memory_mb"]),
            topology(label["shape"]),
            topology(pruned)
        ]
        return row, paint(Core(out), standing_view(read_off(meshes.path(name))[0]), pixels=420)


def main():
    options = arguments(__doc__, "1024,2048", "64")
    kept = Kept(options, "figure-13")
    meshes = Meshes(options.meshes)
    jobs = [(name, n) for n in options.resolutions for name in (NAMES if n < 2048 and not options.small else NAMES[:1])]
    rows = []
    figure, panels = plt.subplots(-(-len(jobs) // 2),
                                  min(2, len(jobs)),
                                  squeeze=False,
                                  figsize=(8.4, 3.1 * -(-len(jobs) // 2)))
    for panel in panels.flat:
        panel.set_axis_off()
    for (name, n), panel in zip(jobs, panels.flat):
        row, painted = kept.get(f"{name} {n}", lambda: measure(options, meshes, name, n))
        rows.append(row)
        hang(panel, painted)
        panel.set_title(f"{name} {n}, lambda {row[2]}", fontsize=9)
    write_table(options.output, "figure-13", [
        "mesh", "resolution", "lambda", "voxels", "boundary vertices", "s voxelize", "s Delaunay", "s core", "s prune",
        "s total", "processor s", "memory MB", "shape chi: b0/b1/b2", "pruned core"
    ], rows)
    save(figure, options.output, "figure-13")


if __name__ == "__main__":
    main()
