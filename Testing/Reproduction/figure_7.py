#!/usr/bin/env python3
"""Figure 7: time and memory against boundary vertices, on phantoms of growing size, with fitted exponents and TetGen's part."""

import os
import resource
import tempfile

import numpy as np

from common import arguments, core, plt, run, save, write_table

MEMORY = 6000  # MB: sizes are left out that would take more, by what the size before took
SECONDS = 400
KINDS = ["ellipsoid", "torus", "tanglecube", "gyroid", "root"]


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    options = arguments(__doc__, "128,256,384,512,768,1024,1280", "24,48")
    rows, curves = [], {}
    with tempfile.TemporaryDirectory() as folder:
        scan, out = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "core.vtp")
        for kind in KINDS:
            for n in options.resolutions:
                if kind in curves:
                    last = curves[kind][-1]
                    growth = (n / last[1]) ** 2
                    if growth * last[5] > MEMORY or growth * last[3] > SECONDS:
                        print(f"{kind} {n}: left out, as about {growth * last[5]:.0f} MB and {growth * last[3]:.0f} s are to be expected")
                        continue
                run(options.program, "phantom", kind, "--size", n, "-o", scan, "--force")
                # One thread, and the processor's time: what else the machine does matters little then.
                begin = processor_seconds()
                report = core(options.program, scan, folder, "--lambda", "2.5%", "-o", out, "--threads", 1)
                taken = processor_seconds() - begin
                vertices = sum(label["boundary_vertices"] for label in report["labels"])
                part = report["seconds"]["delaunay"] / report["seconds"]["total"]
                row = [kind, n, vertices, taken, part, float(report["peak_memory_mb"])]
                if n <= 384:
                    begin = processor_seconds()
                    other = core(options.program, scan, folder, "--lambda", "2.5%", "-o", out, "--engine", "tetgen", "--threads", 1)
                    taken = processor_seconds() - begin
                    row += [taken, other["seconds"]["delaunay"] / other["seconds"]["total"], float(other["peak_memory_mb"])]
                else:
                    row += ["", "", ""]
                rows.append(row)
                curves.setdefault(kind, []).append(row)
    fits = []
    for kind, points in curves.items():
        x = np.log([p[2] for p in points])
        fits.append([kind, *(float(np.polyfit(x, np.log([p[c] for p in points]), 1)[0]) for c in (3, 5))])
    write_table(options.output, "figure-7",
                ["shape", "resolution", "boundary vertices", "processor s", "Delaunay's part", "memory MB", "processor s, TetGen",
                 "TetGen's part", "memory MB, TetGen"], rows)
    write_table(options.output, "figure-7-exponents", ["shape", "exponent of time", "exponent of memory"], fits)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for panel, column, name in zip(axes, (3, 5), ("seconds of one processor", "peak memory, MB")):
        for kind, points in curves.items():
            panel.loglog([p[2] for p in points], [p[column] for p in points], "o-", label=kind)
        panel.set_xlabel("boundary vertices")
        panel.set_ylabel(name)
    axes[0].legend()
    save(figure, options.output, "figure-7")


if __name__ == "__main__":
    main()
