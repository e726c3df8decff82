#!/usr/bin/python3
"""VoxelCore beside TetGen and CGAL on the same boundary vertices: time, memory, and how both grow.

usage: speed_table.py BIN FOLDER [--repetitions 5] [--parts engines,large,growth,giants,atlases] [--sides 256,512,...]
       speed_table.py --show FOLDER [--plot OUT.png]

BIN holds voxelcore, VoxelCoreBenchmark and, where CGAL was found, VoxelCoreCgalTask. Every run is a process of its own,
and those to be compared take turns. FOLDER receives the scans, which are deleted again, and figures.json, to which each
run adds, so that the parts can be run one at a time. Prints medians and, after +-, half the distance between the
quartiles. --show prints the tables from figures.json alone; --plot needs python3-matplotlib.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import time

from memory_at_hand import have_memory_at_hand

ENGINE_SHAPES = [("root", 512), ("gyroid", 256), ("ellipsoid", 512)]
GROWTH_KINDS = ["ellipsoid", "gyroid", "root"]
ATLASES = {"AAL, 116 labels": "/usr/share/mricron/templates/aal.nii.gz",
           "INIA19, 724 labels": "/usr/share/mricron/templates/inia19-NeuroMaps.nii.gz"}  # package mricron-data


def run(command):
    """Standard output of a process, its seconds and its peak memory in bytes."""
    have_memory_at_hand()
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    output = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"speed_table.py: exit {child.returncode} of {' '.join(command)}")
    return output, time.perf_counter() - start, 1024 * usage.ru_maxrss


class Table:
    """Figures of this and former runs, kept in a file after every one."""

    def __init__(self, folder):
        self.path = os.path.join(folder, "figures.json")
        self.rows = json.load(open(self.path)) if os.path.exists(self.path) else {}

    def add(self, shape, task, **figures):
        self.rows.setdefault(shape, {}).setdefault(task, []).append(figures)
        with open(self.path + ".new", "w") as file:
            json.dump(self.rows, file, indent=1)
        os.replace(self.path + ".new", self.path)
        print(f"  {shape}, {task}: " + ", ".join(f"{k} {v:.6g}" for k, v in figures.items()), file=sys.stderr)

    def all(self, shape, task, figure):
        return [row[figure] for row in self.rows.get(shape, {}).get(task, []) if figure in row]

    def median(self, shape, task, figure):
        values = self.all(shape, task, figure)
        return statistics.median(values) if values else None

    def text(self, shape, task, figure, scale=1.0, form="{:.2f}"):
        values = [scale * value for value in self.all(shape, task, figure)]
        if not values:
            return "-"
        middle = form.format(statistics.median(values))
        if len(values) < 4:
            return middle
        low, _, high = statistics.quantiles(values, n=4)
        return f"{middle} +- {form.format((high - low) / 2)}"


class Bench:
    def __init__(self, binaries, folder, repetitions):
        self.program = os.path.join(binaries, "voxelcore")
        self.benchmark = os.path.join(binaries, "VoxelCoreBenchmark")
        self.cgal = os.path.join(binaries, "VoxelCoreCgalTask")
        self.folder = folder
        self.repetitions = repetitions
        self.table = Table(folder)

    def phantom(self, kind, side):
        """The scan and the points, which exist until forget."""
        run([self.benchmark, "--task", "phantom", kind, str(side), self.folder])
        return os.path.join(self.folder, f"{kind}-{side}")

    @staticmethod
    def forget(stem):
        for ending in (".nrrd", ".nii", ".points", ".vtp", ".json"):
            if os.path.exists(stem + ending):
                os.remove(stem + ending)

    def job(self, shape, task, scan, stem, *options):
        command = [self.program, "core", scan, "-o", stem + ".vtp", "--report", stem + ".json", "--force", "--quiet"]
        _, seconds, memory = run(command + list(options))
        with open(stem + ".json") as file:
            report = json.load(file)
        stages = report["seconds"]
        vertices = sum(label["boundary_vertices"] for label in report["labels"])
        voxels = math.prod(report["input"]["size"])
        shape_bytes = sum(math.prod(label["bounding_box"]["size"]) / 8 for label in report["labels"])
        self.table.add(shape, task, seconds=seconds, memory=memory, vertices=vertices, voxels=voxels,
                       shape_bytes=shape_bytes, **{f"{name}_s": value for name, value in stages.items()})

    def engines(self):
        for kind, side in ENGINE_SHAPES:
            shape = f"{kind} {side}"
            stem = self.phantom(kind, side)
            for _ in range(self.repetitions):
                for threads in ("1", "2"):
                    self.job(shape, f"job {threads}", stem + ".nrrd", stem, "--lambda", "2.5vox", "--threads", threads)
                output, _, memory = run([self.benchmark, "--task", "tetgen", stem + ".points"])
                self.table.add(shape, "tetgen", seconds=float(output), memory=memory)
                if os.path.exists(self.cgal):
                    for task, threads in (("cgal", []), ("cgal tbb 2", ["2"])):
                        output, _, memory = run([self.cgal, stem + ".points"] + threads)
                        self.table.add(shape, task, seconds=float(output), memory=memory)
            self.forget(stem)

    def large(self):
        stem = os.path.join(self.folder, "corn")  # raw: a NIfTI that is not compressed
        run([self.program, "phantom", "root", "--size", "1560,789,1041", "-o", stem + ".nii", "--force", "--quiet"])
        for _ in range(self.repetitions):
            self.job("root 1560 x 789 x 1041", "job 2", stem + ".nii", stem, "--lambda", "2.5vox", "--threads", "2")
        self.forget(stem)

    def growth(self, sides):
        for kind in GROWTH_KINDS:
            for side in sides:
                stem = self.phantom(kind, side)
                os.remove(stem + ".points")
                for _ in range(self.repetitions if side <= 512 else 1):
                    self.job(f"{kind} {side}", "growth", stem + ".nrrd", stem, "--lambda", "2.5vox", "--threads", "2")
                self.forget(stem)

    def giants(self):
        for kind in ("root", "ellipsoid"):
            stem = os.path.join(self.folder, f"{kind}-2048")
            run([self.program, "phantom", kind, "--size", "2048", "-o", stem + ".nrrd", "--force", "--quiet"])
            self.job(f"{kind} 2048", "giant", stem + ".nrrd", stem, "--lambda", "2.5vox", "--threads", "2")
            self.forget(stem)

    def atlases(self):
        for name, scan in ATLASES.items():
            if os.path.exists(scan):
                for _ in range(self.repetitions):
                    self.job(name, "atlas", scan, os.path.join(self.folder, name), "--threads", "2")
                self.forget(os.path.join(self.folder, name))


def print_rows(head, rows):
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def ratio(numerator, denominator):
    return "-" if numerator is None or denominator is None else f"{numerator / denominator:.1f}"


def points_per_second(table, shape, task, figure):
    vertices = table.median(shape, "job 1", "vertices")
    seconds = table.median(shape, task, figure)
    return "-" if vertices is None or seconds is None else f"{vertices / seconds / 1000:.0f}"


def show_engines(table):
    shapes = [f"{kind} {side}" for kind, side in ENGINE_SHAPES if f"{kind} {side}" in table.rows]
    if not shapes:
        return
    print("Delaunay stage: thousand points a second, and times TetGen's speed\n")
    rows = []
    for shape in shapes:
        tetgen = table.median(shape, "tetgen", "seconds")
        rows.append([shape, f"{table.median(shape, 'job 1', 'vertices'):.0f}",
                     points_per_second(table, shape, "tetgen", "seconds"),
                     points_per_second(table, shape, "cgal", "seconds"),
                     points_per_second(table, shape, "cgal tbb 2", "seconds"),
                     points_per_second(table, shape, "job 1", "delaunay_s"),
                     points_per_second(table, shape, "job 2", "delaunay_s"),
                     ratio(tetgen, table.median(shape, "job 1", "delaunay_s")),
                     ratio(table.median(shape, "job 1", "delaunay_s"), table.median(shape, "job 2", "delaunay_s"))])
    print_rows(["shape", "boundary vertices", "TetGen", "CGAL", "CGAL, TBB, 2 threads", "lattice, 1 thread",
                "2 threads", "1 thread over TetGen", "2 threads over 1"], rows)
    print("The whole job, `core --lambda 2.5vox` from raw NRRD to .vtp, beside TetGen's tetrahedralize alone\n")
    rows = []
    for shape in shapes:
        vertices = table.median(shape, "job 2", "vertices")
        beyond = table.median(shape, "job 2", "memory") - table.median(shape, "job 2", "shape_bytes") - 50e6
        rows.append([shape, table.text(shape, "tetgen", "seconds"), table.text(shape, "job 1", "seconds"),
                     table.text(shape, "job 2", "seconds"),
                     ratio(table.median(shape, "tetgen", "seconds"), table.median(shape, "job 2", "seconds")),
                     table.text(shape, "tetgen", "memory", 1e-6, "{:.0f}"),
                     table.text(shape, "job 2", "memory", 1e-6, "{:.0f}"), f"{beyond / vertices:.0f}"])
    print_rows(["shape", "TetGen s", "job s, 1 thread", "2 threads", "TetGen over job", "TetGen MB", "job MB",
                "bytes a vertex beyond shape bits and 50 MB"], rows)


def show_jobs(table):
    rows = []
    for shape in table.rows:
        for task in ("job 2", "giant", "atlas"):
            if task in table.rows[shape] and (task != "job 2" or " x " in shape):
                rows.append([shape, f"{table.median(shape, task, 'vertices'):.0f}", table.text(shape, task, "seconds"),
                             table.text(shape, task, "memory", 1e-6, "{:.0f}")])
    if rows:
        print("Whole jobs, 2 threads\n")
        print_rows(["scan", "boundary vertices", "seconds", "MB"], rows)


def show_growth(table):
    rows = []
    for shape in table.rows:
        if "growth" not in table.rows[shape]:
            continue
        vertices = table.median(shape, "growth", "vertices")
        read = table.median(shape, "growth", "read_s")
        after = table.median(shape, "growth", "total_s") - read
        each = [1e6 * table.median(shape, "growth", f"{stage}_s") / vertices
                for stage in ("shape", "delaunay", "core", "prune", "write")]
        rows.append([shape, f"{vertices:.0f}", f"{1e6 * after / vertices:.2f}"] + [f"{value:.2f}" for value in each]
                    + [f"{table.median(shape, 'growth', 'memory') / 1e6:.0f}",
                       f"{table.median(shape, 'growth', 'voxels') / read / 1e6:.0f}" if read > 0 else "-"])
    if rows:
        print("Seconds per million boundary vertices after reading, 2 threads, and by stage\n")
        print_rows(["shape", "boundary vertices", "all", "shape", "Delaunay", "core", "prune", "write", "MB",
                    "reading, Mvoxel/s"], rows)


def plot(table, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for kind, marker in zip(GROWTH_KINDS, "os^"):
        shapes = [shape for shape in table.rows if shape.startswith(kind) and "growth" in table.rows[shape]]
        shapes.sort(key=lambda shape: table.median(shape, "growth", "vertices"))
        vertices = [table.median(shape, "growth", "vertices") for shape in shapes]
        axes[0].plot(vertices, [table.median(s, "growth", "total_s") - table.median(s, "growth", "read_s")
                                for s in shapes], marker=marker, label=kind)
        axes[1].plot(vertices, [table.median(s, "growth", "memory") / 1e6 for s in shapes], marker=marker, label=kind)
    for task, marker, label in (("tetgen", "x", "TetGen alone"), ("cgal", "+", "CGAL alone")):
        shapes = [shape for shape in table.rows if task in table.rows[shape]]
        vertices = [table.median(shape, "job 1", "vertices") for shape in shapes]
        axes[0].plot(vertices, [table.median(s, task, "seconds") for s in shapes], marker, color="black", label=label)
        axes[1].plot(vertices, [table.median(s, task, "memory") / 1e6 for s in shapes],
                     marker,
                     color="black",
                     label=label)
    for axis, label in zip(axes, ("seconds after reading", "peak memory, MB")):
        axis.set(xscale="log", yscale="log", xlabel="boundary vertices", ylabel=label)
        axis.grid(True, which="major", alpha=0.4)
        axis.legend()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n\n")[0])
    parser.add_argument("places", nargs="+")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--plot")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--parts", default="engines,large,growth,giants,atlases")
    parser.add_argument("--sides", default="256,512,768,1024,1280")
    arguments = parser.parse_args()
    if len(arguments.places) != (1 if arguments.show else 2):
        parser.error("one FOLDER with --show, else BIN and FOLDER")
    folder = arguments.places[-1]
    os.makedirs(folder, exist_ok=True)
    if not arguments.show:
        bench = Bench(arguments.places[0], folder, arguments.repetitions)
        for part in arguments.parts.split(","):
            if part == "growth":
                bench.growth([int(side) for side in arguments.sides.split(",")])
            elif part in ("engines", "large", "giants", "atlases"):
                getattr(bench, part)()
            else:
                parser.error(f"there is no part '{part}'")
    table = Table(folder)
    show_engines(table)
    show_jobs(table)
    show_growth(table)
    if arguments.plot:
        plot(table, arguments.plot)


if __name__ == "__main__":
    main()
