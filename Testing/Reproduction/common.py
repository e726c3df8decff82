"""What the scripts of this folder share: running voxelcore, its files, tables, meshes and distances."""

import argparse
import datetime
import io
import json
import os
import pickle
import re
import subprocess
import sys
import tarfile
import tempfile
import zlib

import matplotlib
import numpy as np
from PIL import Image
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
    parser.add_argument("--continue",
                        dest="go_on",
                        action="store_true",
                        help="with what an earlier run left in the output folder")
    options = parser.parse_args()
    text = options.resolutions or (small if options.small else resolutions)
    options.resolutions = [int(n) for n in text.split(",")]
    os.makedirs(options.output, exist_ok=True)
    return options


class Kept:
    """Results of single jobs, each written as it is made: a long run that is cut short goes on with `--continue`."""

    def __init__(self, options, name):
        self._folder = os.path.join(options.output, "kept")
        self._name = name
        self._go_on = options.go_on
        os.makedirs(self._folder, exist_ok=True)

    def get(self, key, make):
        """What make() returns, or what it returned then. Prints the first part of it, the table's row or rows."""
        path = os.path.join(self._folder, f"{self._name}_{key}.pickle".replace(" ", "_"))
        if self._go_on and os.path.exists(path):
            with open(path, "rb") as file:
                result = pickle.load(file)
        else:
            result = make()
            with open(path + ".part", "wb") as file:
                pickle.dump(result, file)
            os.replace(path + ".part", path)
        print(key, result[0], flush=True)
        return result


class Meshes:
    """CGAL's meshes, unpacked for the time being where no folder is given. Exits with 77, a skipped test, without
    them."""

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
    """Points and triangles (polygons as fans) of a .vtp that voxelcore wrote; lines and single points as triangles,
    too."""

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
            blocks = int(np.frombuffer(data, "<u8", 1, at)[0])
            at += 24
            lengths = np.frombuffer(data, "<u8", blocks, at)
            at += 8 * blocks
            values = b""
            for length in lengths:
                values += zlib.decompress(data[at:at + int(length)])
                at += int(length)
            kind = {b"Float64": "<f8", b"Int64": "<i8", b"Int32": "<i4"}[arrays[key][b"type"]]
            return np.frombuffer(values, kind)

        self.points = read("Points", "Points").reshape(-1, 3)
        self.radius = read("PointData", "Radius")
        self.measure = read("PointData", "Lambda")
        parts = []
        for name in ("Verts", "Lines", "Polys"):
            corners = read(name, "connectivity").astype(np.int64)
            ends = read(name, "offsets").astype(np.int64)
            starts = np.concatenate([[0], ends[:-1]]).astype(np.int64)
            sides = ends - starts
            for i in range(2, max(3, int(sides.max(initial=0)))):
                has = sides > i if i > 2 else sides > 0
                s, n = starts[has], sides[has]
                parts.append(
                    np.stack([corners[s], corners[s + np.minimum(i - 1, n - 1)], corners[s + np.minimum(i, n - 1)]], 1))
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


class Middles:
    """The middles of a Core's triangles, for distance_to_core()."""

    def __init__(self, one):
        self.corners = one.points[one.triangles]
        self.tree = cKDTree(self.corners.mean(axis=1), balanced_tree=False, compact_nodes=False)


def distance_to_core(samples, middles, neighbours=16):
    """Of each sample to the triangles of a Core: those whose middles are nearest are looked at."""
    corners = middles.corners
    count = min(neighbours, len(corners))
    found = middles.tree.query(samples, k=count)[1].reshape(len(samples), count)
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
        file.write(f"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {size}\n"
                   f"space directions: {step}\nkinds: domain domain domain\nencoding: raw\nspace origin: ({place})\n\n".
                   encode())
        for k in range(voxels.shape[2]):
            file.write(np.ascontiguousarray(voxels[:, :, k].T).astype(np.uint8).tobytes())


def processor():
    with open("/proc/cpuinfo", encoding="utf8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown processor"


def write_table(folder, name, head, rows, note=""):
    """OUT.csv and OUT.md, which also says when and where."""
    text = [[
        cell if isinstance(cell, str) else f"{cell:.4g}" if isinstance(cell, float) else str(cell) for cell in row
    ] for row in rows]
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


VIEW = np.array([[0.80, -0.28, 0.53], [-0.60, -0.37, 0.71], [0.0, 0.886, 0.464]])  # from the left above


def standing_view(points):
    """A `turn` for paint(): y up, the longest way across, seen a little from above."""
    flat = points[:, [0, 2]] - points[:, [0, 2]].mean(axis=0)
    across = np.linalg.svd(flat, full_matrices=False)[2][0]
    across = across * np.sign(across[np.abs(across).argmax()])  # the same whatever the library's sign
    right = np.array([across[0], 0, across[1]])
    up = np.array([0.0, 1.0, 0.0])
    eye = np.cross(right, up)
    c, s = np.cos(0.3), np.sin(0.3)
    return np.stack([right, c * up - s * eye, s * up + c * eye], 1)


def paint(one, turn=VIEW, values=None, pixels=360, box=None, measure_first=False, colours="viridis", most=None):
    """A Core in parallel projection: columns of `turn` are the picture's right, its up, and towards the eye. Colours by
    `values` per point up to `most`, light by the normal. Where elements hide each other the nearest is seen, or with
    `measure_first` the one of greatest value. Returns the pixels, for hang(), and the box (left, right, bottom, top);
    lines are a pixel wide."""
    turned = one.points @ turn
    values = one.radius if values is None else values
    most = most or values.max(initial=0) or 1
    if box is None:
        low, high = turned[:, :2].min(axis=0), turned[:, :2].max(axis=0)
        rim = 0.03 * (high - low).max()
        box = (low[0] - rim, high[0] + rim, low[1] - rim, high[1] + rim)
    step = max(box[1] - box[0], box[3] - box[2]) / pixels
    width, height = int(np.ceil((box[1] - box[0]) / step)), int(np.ceil((box[3] - box[2]) / step))
    front = np.full(width * height, -np.inf)
    colour = np.zeros(width * height)
    light = np.ones(width * height)
    lamp = np.array([-0.35, 0.45, 0.82])
    for begin in range(0, len(one.triangles), 200000):
        ids = one.triangles[begin:begin + 200000]
        corners, value = turned[ids], values[ids]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1)
        shade = np.where(length > 0, 0.4 + 0.6 * np.abs(normal @ lamp) / np.where(length > 0, length, 1), 0.7)
        longest = np.linalg.norm(corners - np.roll(corners, 1, 1), axis=2).max(axis=1)
        cuts = 2 ** np.ceil(np.log2(np.maximum(1, 1.5 * longest / step))).astype(int)
        for n in np.unique(cuts):  # triangles in so many parts a side that parts are smaller than a pixel
            u, v = (g.ravel() for g in np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n))
            weights = np.stack([1 - u - v, u, v], 1)[u + v <= 1] if n > 1 else np.full((1, 3), 1 / 3)
            some = np.flatnonzero(cuts == n)
            for part in np.array_split(some, 1 + len(some) * len(weights) // 2000000):
                there, right, up, near = ((of[part] @ weights.T).ravel() for of in (value, *np.moveaxis(corners, 2, 0)))
                dark = np.repeat(shade[part], len(weights))
                x, y = ((right - box[0]) / step).astype(int), ((box[3] - up) / step).astype(int)
                depth = there if measure_first else near
                keep = np.flatnonzero((x >= 0) & (x < width) & (y >= 0) & (y < height))
                keep = keep[depth[keep] > front[y[keep] * width + x[keep]]]
                keep = keep[np.argsort(depth[keep], kind="stable")]  # of those at one pixel the last is kept
                pixel = y[keep] * width + x[keep]
                front[pixel], colour[pixel], light[pixel] = depth[keep], there[keep], dark[keep]
    picture = plt.get_cmap(colours)(np.clip(colour / most, 0, 1))
    picture[:, :3] *= light[:, None]
    picture[front == -np.inf] = 1
    return (255 * picture.reshape(height, width, 4) + 0.5).astype(np.uint8), box


def hang(panel, painted):
    """What paint() returned."""
    panel.imshow(painted[0], extent=painted[1], interpolation="nearest")
    panel.set_axis_off()


def save(figure, folder, name):
    """As .png of few colours, so that a picture stays small."""
    figure.tight_layout()
    data = io.BytesIO()
    figure.savefig(data, dpi=110)
    plt.close(figure)
    data.seek(0)
    Image.open(data).convert("RGB").quantize(96).save(os.path.join(folder, name + ".png"), optimize=True)


def require(condition, what):
    """A claim of the paper that must hold; the script fails where it does not."""
    if not condition:
        sys.exit("does not hold: " + what)
