#!/usr/bin/env python3
"""Figure 7: time and memory against boundary vertices, on phantoms of growing size, with fitted exponents and TetGen's part."""

import os
import tempfile

import numpy as np

from common import arguments, core, plt, run, save, write_table

KINDS = ["ellipsoid", "torus", "tanglecube", "gyroid", "root"]


def main():
    options = arguments(__doc__, "128,256,512,768,1024,1280", "24,48")
    rows, curves = [], {}
    with tempfile.TemporaryDirectory() as folder:
        scan, out = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "core.vtp")
        for kind in KINDS:
            for n in options.resolutions:
                run(options.program, "phantom", kind, "--size", n, "-o", scan, "--force")
                report = core(options.program, scan, folder, "--lambda", "2.5%", "-o", out)
                seconds = report["seconds"]
                vertices = sum(label["boundary_vertices"] for label in report["labels"])
                row = [kind, n, vertices, seconds["total"], seconds["delaunay"], float(report["peak_memory_mb"])]
                if n <= 512:  # TetGen takes about 20 times the memory
                    other = core(options.program, scan, folder, "--lambda", "2.5%", "-o", out, "--engine", "tetgen")
                    row += [other["seconds"]["total"], other["seconds"]["delaunay"] / other["seconds"]["total"],
                            float(other["peak_memory_mb"])]
                else:
                    row += ["", "", ""]
                rows.append(row)
                curves.setdefault(kind, []).append(row)
    fits = []
    for kind, points in curves.items():
        x = np.log([p[2] for p in points])
        fits.append([kind, *(float(np.polyfit(x, np.log([p[c] for p in points]), 1)[0]) for c in (3, 5))])
    write_table(options.output, "figure-7",
                ["shape", "resolution", "boundary vertices", "seconds", "of these Delaunay", "memory MB", "seconds, TetGen",
                 "TetGen's part", "memory MB, TetGen"], rows)
    write_table(options.output, "figure-7-exponents", ["shape", "exponent of time", "exponent of memory"], fits)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for panel, column, name in zip(axes, (3, 5), ("seconds", "peak memory, MB")):
        for kind, points in curves.items():
            panel.loglog([p[2] for p in points], [p[column] for p in points], "o-", label=kind)
        panel.set_xlabel("boundary vertices")
        panel.set_ylabel(name)
    axes[0].legend()
    save(figure, options.output, "figure-7")


if __name__ == "__main__":
    main()
