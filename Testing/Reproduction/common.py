"""What the scripts of this folder share: running voxelcore, its files, tables, meshes and distances."""

import argparse
import datetime
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile

import matplotlib
import numpy as np
from scipy.spatial import cKDTree

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

CGAL = "/usr/share/doc/libcgal-dev/data.tar.gz"  # of Debian's libcgal-demo


def arguments(description, resolutions, small):
    """The options all scripts have. `--small` stands for resolutions that take seconds."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("program", help="voxelcore")
    parser.add_argument("output", help="folder for table and picture")
    parser.add_argument("--small", action="store_true", help="what the tests run")
    parser.add_argument("--resolutions", help=f"comma-separated; default {resolutions}")
    parser.add_argument("--meshes", help=f"folder with CGAL's data/meshes; default: out of {CGAL}")
    options = parser.parse_args()
    text = options.resolutions or (small if options.small else resolutions)
    options.resolutions = [int(n) for n in text.split(",")]
    os.makedirs(options.output, exist_ok=True)
    return options


class Meshes:
    """CGAL's meshes, unpacked for the time being where no folder is given. Exits with 77, a skipped test, without them."""

    def __init__(self, folder):
        self._temporary = None
        self._folder = folder
        if folder is None:
            if not os.path.exists(CGAL):
                print(f"{CGAL} is missing: bash Applications/install-packages.sh reproduction")
                sys.exit(77)
            self._temporary = tempfile.TemporaryDirectory()
            self._folder = os.path.join(self._temporary.name, "data", "meshes")
            with tarfile.open(CGAL) as archive:
                members = [m for m in archive.getmembers() if m.isfile() and m.name.startswith("data/meshes/")]
                archive.extractall(self._temporary.name, members)

    def path(self, name):
        return os.path.join(self._folder, name + ".off")


def run(program, *parts):
    done = subprocess.run([program, *map(str, parts)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, parts))}: exit code {done.returncode}: {done.stderr.strip()}")
    return done


def core(program, source, folder, *options):
    """Runs `voxelcore core`; returns the report."""
    report = os.path.join(folder, "report.json")
    run(program, "core", source, *options, "--report", report, "--force", "-q")
    with open(report, encoding="utf8") as file:
        return json.load(file)


class Core:
    """Points and triangles (polygons as fans) of a .vtp that voxelcore wrote; lines and single points as triangles, too."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        tag = data.index(b'<AppendedData encoding="raw">')
        begin = data.index(b"_", tag) + 1
        arrays, section = {}, ""
        for found in re.finditer(rb"<(\w+)([^>]*)>", data[:tag]):
            attributes = dict(re.findall(rb'(\w+)="([^"]*)"', found.group(2)))
            if found.group(1) == b"DataArray":
                arrays[section, attributes[b"Name"].decode()] = attributes
            elif found.group(1) != b"Array":
                section = found.group(1).decode()

        def read(*key):
            if key not in arrays:
                return np.zeros(0)
            at = begin + int(arrays[key][b"offset"])
            size = int(np.frombuffer(data, "<u8", 1, at)[0])
            kind = {b"Float64": "<f8", b"Int64": "<i8", b"Int32": "<i4"}[arrays[key][b"type"]]
            return np.frombuffer(data, kind, size // int(kind[2]), at + 8)

        self.points = read("Points", "Points").reshape(-1, 3)
        self.radius = read("PointData", "Radius")
        parts = []
        for name in ("Verts", "Lines", "Polys"):
            corners = read(name, "connectivity").astype(np.int64)
            ends = read(name, "offsets").astype(np.int64)
            starts = np.concatenate([[0], ends[:-1]]).astype(np.int64)
            sides = ends - starts
            for i in range(2, max(3, int(sides.max(initial=0)))):
                has = sides > i if i > 2 else sides > 0
                s, n = starts[has], sides[has]
                parts.append(np.stack([corners[s], corners[s + np.minimum(i - 1, n - 1)], corners[s + np.minimum(i, n - 1)]], 1))
        self.triangles = np.concatenate(parts) if parts else np.zeros((0, 3), np.int64)


def point_triangle(p, a, b, c):
    """Distances of points to triangles (n x 3 each), degenerate ones included."""
    ab, ac, ap = b - a, c - a, p - a
    dot = lambda u, v: np.einsum("ij,ij->i", u, v)  # noqa: E731

    def to_segment(q, direction, offset):
        length = dot(direction, direction)
        t = np.clip(dot(offset, direction) / np.where(length > 0, length, 1), 0, 1)
        return np.linalg.norm(offset - t[:, None] * direction, axis=1)

    best = np.minimum(to_segment(a, ab, ap), np.minimum(to_segment(a, ac, ap), to_segment(b, c - b, p - b)))
    normal = np.cross(ab, ac)
    squared = dot(normal, normal)
    flat = squared <= 1e-30
    safe = np.where(flat, 1, squared)
    v = dot(np.cross(ap, ac), normal) / safe
    w = dot(np.cross(ab, ap), normal) / safe
    inside = (v >= 0) & (w >= 0) & (v + w <= 1) & ~flat
    return np.where(inside, np.abs(dot(ap, normal)) / np.sqrt(safe), best)


def distance_to_core(samples, one, neighbours=16):
    """Of each sample to the triangles of a Core: those whose middles are nearest are looked at."""
    corners = one.points[one.triangles]
    tree = cKDTree(corners.mean(axis=1))
    count = min(neighbours, len(corners))
    found = tree.query(samples, k=count)[1].reshape(len(samples), count)
    best = np.full(len(samples), np.inf)
    for k in range(count):
        best = np.minimum(best, point_triangle(samples, *(corners[found[:, k], i] for i in range(3))))
    return best


def write_nrrd(path, voxels, spacing, origin=(0, 0, 0)):
    """Booleans [i, j, k]; centre of voxel (0,0,0) at `origin`."""
    size = " ".join(map(str, voxels.shape))
    step = " ".join("(" + ",".join(repr(float(spacing if a == b else 0)) for b in range(3)) + ")" for a in range(3))
    place = ",".join(repr(float(x)) for x in origin)
    with open(path, "wb") as file:
        file.write(
            f"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {size}\n"
            f"space directions: {step}\nkinds: domain domain domain\nencoding: raw\nspace origin: ({place})\n\n".encode()
        )
        for k in range(voxels.shape[2]):
            file.write(np.ascontiguousarray(voxels[:, :, k].T).astype(np.uint8).tobytes())


def processor():
    with open("/proc/cpuinfo", encoding="utf8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown processor"


def write_table(folder, name, head, rows, note=""):
    """OUT.csv and OUT.md, which also says when and where."""
    text = [[cell if isinstance(cell, str) else f"{cell:.4g}" if isinstance(cell, float) else str(cell) for cell in row] for row in rows]
    with open(os.path.join(folder, name + ".csv"), "w", encoding="utf8") as file:
        for row in [head] + text:
            file.write(",".join(row) + "\n")
    with open(os.path.join(folder, name + ".md"), "w", encoding="utf8") as file:
        file.write(f"{datetime.date.today()}, {processor()}\n\n")
        file.write("| " + " | ".join(head) + " |\n|" + " --- |" * len(head) + "\n")
        for row in text:
            file.write("| " + " | ".join(row) + " |\n")
        file.write(f"\n{note}\n" if note else "")
    widths = [max(len(row[c]) for row in [head] + text) for c in range(len(head))]
    for row in [head] + text:
        print("  ".join(cell.rjust(width) for cell, width in zip(row, widths)))


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name + ".png"), dpi=110)
    plt.close(figure)


def require(condition, what):
    """A claim of the paper that must hold; the script fails where it does not."""
    if not condition:
        sys.exit("does not hold: " + what)
