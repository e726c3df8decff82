#!/usr/bin/env python3
"""Figure 7: time and memory against boundary vertices, of phantoms and meshes at growing resolution, with fitted
exponents and TetGen's part."""

import os
import resource
import tempfile

import numpy as np

from common import Kept, Meshes, arguments, core, plt, run, save, write_table

MEMORY = 14000  # MB: sizes are left out that would take more, by what the size before took
SECONDS = 900
TETGEN = 640  # voxels: finer ones are left to the default engine
KINDS = ["ellipsoid", "torus", "tanglecube", "elk", "hand"]
MESHES = ["elk", "hand"]  # also of the paper's five


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def after_reading(taken, report):
    """The scan's voxels are a matter of the file, and grow faster than the boundary."""
    return taken * (1 - report["seconds"]["read"] / report["seconds"]["total"])


def measure(options, meshes, kind, n):
    """The table's row. One thread, and the processor's time: what else the machine does matters little then."""
    with tempfile.TemporaryDirectory() as folder:
        scan, out = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "core.vtp")
        if kind in MESHES:
            run(options.program, "voxelize", meshes.path(kind), "--resolution", n, "-o", scan, "--force")
        else:
            run(options.program, "phantom", kind, "--size", n, "-o", scan, "--force")
        part = "1.5%" if kind == "elk" else "2.5%"  # as the paper

        def of_engine(*engine):
            begin = processor_seconds()
            report = core(options.program, scan, folder, "--lambda", part, "-o", out, "--threads", 1, *engine)
            taken = after_reading(processor_seconds() - begin, report)
            return report, [
                taken, report["seconds"]["delaunay"] / report["seconds"]["total"],
                float(report["peak_memory_mb"])
            ]

        report, row = of_engine()
        vertices = sum(label["boundary_vertices"] for label in report["labels"])
        return [[kind, n, vertices, *row, *(of_engine("--engine", "tetgen")[1] if n <= TETGEN else ["", "", ""])]]


def main():
    options = arguments(__doc__, "128,256,384,512,640,768,1024,1280", "24,48")
    kept = Kept(options, "figure-7")
    meshes = Meshes(options.meshes)
    rows, curves = [], {}
    # By size, so that what a cut leaves are the greatest.
    for n in options.resolutions:
        for kind in KINDS:
            if kind in curves:
                last = curves[kind][-1]
                growth = (n / last[1]) ** 2
                if growth * last[5] > MEMORY or growth * last[3] > SECONDS:
                    print(
                        f"{kind} {n}: left out, as about {growth * last[5]:.0f} MB and {growth * last[3]:.0f} s are "
                        "to be expected"
                    )
                    continue
            row = kept.get(f"{kind} {n}", lambda: measure(options, meshes, kind, n))[0]
            rows.append(row)
            curves.setdefault(kind, []).append(row)
    rows.sort(key=lambda row: (KINDS.index(row[0]), row[1]))
    fits = []
    for kind, points in curves.items():
        for engine, columns in (("lattice", (3, 5)), ("TetGen", (6, 8))):
            # Small ones are the program itself, not its work.
            of_engine = [p for p in points if p[columns[0]] != "" and (p[2] > 50000 or options.small)]
            if len(of_engine) > 1:
                x = np.log([p[2] for p in of_engine])
                fits.append(
                    [kind, engine, *(float(np.polyfit(x, np.log([p[c] for p in of_engine]), 1)[0]) for c in columns)])
    write_table(options.output, "figure-7", [
        "shape", "resolution", "boundary vertices", "processor s", "Delaunay's part", "memory MB",
        "processor s, TetGen", "TetGen's part", "memory MB, TetGen"
    ], rows)
    write_table(options.output, "figure-7-exponents", ["shape", "engine", "exponent of time", "exponent of memory"],
                fits)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4))
    for panel, columns, name in zip(axes, ((3, 6), (5, 8)), ("seconds of one processor", "peak memory, MB")):
        for i, (kind, points) in enumerate(curves.items()):
            panel.plot([p[2] / 1e6 for p in points], [p[columns[0]] for p in points],
                       "o-",
                       color=f"C{i}",
                       markersize=3,
                       label=kind)
            other = [p for p in points if p[columns[1]] != ""]
            panel.plot([p[2] / 1e6 for p in other], [p[columns[1]] for p in other], "x--", color=f"C{i}", linewidth=0.8,
                       label=kind + ", TetGen")
        panel.set_xlabel("million boundary vertices")
        panel.set_ylabel(name)
        panel.set_ylim(bottom=0)
    axes[0].legend(fontsize=7)
    save(figure, options.output, "figure-7")


if __name__ == "__main__":
    main()
