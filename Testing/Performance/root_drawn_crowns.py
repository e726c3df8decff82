#!/usr/bin/env python3
"""`roots` on crowns drawn at random as measured ones are: a row for each seed, and their mean.
usage: root_drawn_crowns.py PROGRAM [--seeds N] [--first SEED] [--keep FOLDER]      (python3-numpy, python3-scipy)

A stem 10 to 40 voxels thick with nodes, on each a whorl of roots, some with laterals; 40 to 120 roots in all. A pith
open at the top in half of them; thickness that varies along a root; roots that touch where they happen to meet; noise.
A voxel stands for some 0.4 mm. What the numbers were taken from:
Postma & Lynch 2011 (maize, as CPlantBox holds it): roots leave the stem at 64 degrees +-6, nodal ones later at 90 +-9;
  laterals leave at 70 degrees, none on the first 20 mm (here 5 to 20), then every 5 to 10 mm, 18 to 60 mm long; they
  turn by .26 (taproot), .05 (nodal) and .52 (laterals) rad / sqrt(cm) at random, and roots down by gravity.
Trachsel et al. 2011 (shovelomics of maize): whorls with 4 to 16 roots, at 20 to 70 degrees to the soil.
"""
import argparse
import math
import os
import subprocess
import sys
import tempfile

import numpy
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree

from root_truth import Roots, balance, compare, outside_parents, read_rsml, stem_path

CM = 25.0  # voxels


class Crown:
    """A drawn plant; x, y, z in voxels, z downwards."""

    def __init__(self, seed):
        self.random = numpy.random.default_rng(seed)
        self.truth = Roots()
        self.points, self.reach, self.owner = [], [], []  # of all roots so far: balls that others keep out of
        self.contacts = 0
        self.draw()

    def uniform(self, low, high):
        return float(self.random.uniform(low, high))

    def draw(self):
        radius = self.uniform(5, 20)
        wanted = int(self.random.integers(40, 121))
        nodes = int(self.random.integers(4, 8))
        above = self.uniform(2, 5) * radius  # of stem, above the first whorl
        between = [self.uniform(1.0, 2.2) * radius + 4 for _ in range(nodes - 1)]
        whorls = above + numpy.concatenate([[0], numpy.cumsum(between)])
        below = self.uniform(2, 6) * radius
        self.axis, self.thick = self.stem(radius, whorls, below)
        self.radius = radius
        self.basal = self.uniform(0.5, 2) * CM
        self.hollow = (self.uniform(0.4, 0.9) * above, max(2.5, self.uniform(0.2, 0.4) * radius)) \
            if self.random.random() < 0.5 and radius > 7 else None
        end = int(numpy.flatnonzero(self.thick > 0.5 * radius).max())  # what is thinner is the first of the roots
        self.truth.add(self.axis[:end], self.thick[:end], 0)
        self.keep(self.axis[:end], self.thick[:end], 0)
        self.truth.add(self.axis[end:], self.thick[end:], 1, 0)
        self.keep(self.axis[end:], self.thick[end:], 1)
        nodal = max(nodes, int(self.uniform(0.5, 0.8) * wanted))
        shares = self.random.dirichlet(numpy.full(nodes, 6.0))
        for node, share in enumerate(shares):
            number = max(1, round(share * nodal))
            turn = self.uniform(0, 2 * math.pi)
            for which in range(number):
                around = turn + 2 * math.pi * (which + self.uniform(-0.25, 0.25)) / number
                self.nodal(whorls[node] + self.uniform(-1.5, 1.5), around, node / nodes)
        parents = [n for n in range(1, len(self.truth.lines)) if len(self.truth.lines[n]) > 30]
        tries = 0
        while len(self.truth.lines) - 1 < wanted and parents and tries < 20 * wanted:
            tries += 1
            self.lateral(int(self.random.choice(parents)))

    def stem(self, radius, whorls, below):
        """Down to the last whorl as thick as it is, a little more at nodes; then it thins into the first root."""
        length = int(whorls[-1] + below)
        depth = numpy.arange(0, length, 0.5)
        bend = self.uniform(0, 0.08), self.uniform(0, 2 * math.pi)
        sway = self.uniform(0, 2), self.uniform(60, 150), self.uniform(0, 6)
        out = bend[0] * depth ** 1.5 / 10 + sway[0] * numpy.sin(depth / sway[1] * 2 * math.pi + sway[2])
        axis = numpy.stack([out * math.cos(bend[1]), out * math.sin(bend[1]), depth], 1)
        last = self.uniform(1.5, 3.0)
        thick = numpy.interp(depth, [0, whorls[0], whorls[-1], whorls[-1] + 0.35 * below, length],
                             [radius, radius, 0.75 * radius, max(last, 0.3 * radius), last])
        for node in whorls:
            thick = thick * (1 + 0.12 * numpy.exp(-((depth - node) / (0.25 * radius)) ** 2))
        return axis, thick * self.ripple(len(depth), 0.03)

    def ripple(self, count, share):
        """Thickness varies along a root: a factor, correlated over some five voxels."""
        noise = gaussian_filter(self.random.standard_normal(count + 40), 10)[20:20 + count]
        return 1 + share * noise / max(noise.std(), 1e-9)

    def nodal(self, depth, around, high):
        at = min(int(numpy.searchsorted(self.axis[:, 2], depth)), len(self.truth.lines[0]) - 1)  # of the stem itself
        steep = math.radians(self.uniform(35, 90) if high < 0.5 else self.uniform(25, 65))  # from straight down
        way = numpy.array([math.cos(around) * math.sin(steep), math.sin(around) * math.sin(steep), math.cos(steep)])
        thick = min(self.uniform(1.5, 4.5), 0.5 * self.radius)
        self.grow(0, at, way, thick, self.uniform(2.0, 6.0) * CM, 0.05, self.uniform(0.1, 0.35))

    def lateral(self, parent):
        line = self.truth.lines[parent]
        first = int(2 * self.basal)
        if first >= len(line) - 8:
            return
        at = int(self.random.integers(first, len(line) - 8))
        along = line[at + 3] - line[at - 3]
        along /= numpy.linalg.norm(along)
        side = self.random.standard_normal(3)
        side -= along * (side @ along)
        side /= numpy.linalg.norm(side)
        angle = math.radians(self.random.normal(70, 8))
        way = math.cos(angle) * along + math.sin(angle) * side
        thick = min(self.uniform(1.0, 1.75), 0.8 * self.truth.radii[parent][at])
        self.grow(parent, at, way, max(thick, 1.0), self.uniform(0.6, 2.4) * CM, 0.52, 0.1)

    def grow(self, parent, at, way, thick, length, wander, gravity):
        """A root from the axis of its parent on, steps of half a voxel; none if it runs into another: roots touch."""
        step = 0.5
        place = self.truth.lines[parent][at].copy()
        points = [place.copy()]
        for _ in range(int((length + self.truth.radii[parent][at]) / step)):
            place = place + step * way
            points.append(place.copy())
            way = way + wander * math.sqrt(step / CM) * self.random.standard_normal(3)
            way[2] += gravity * step / CM
            way /= numpy.linalg.norm(way)
        points = numpy.array(points)
        if points[:, 2].min() < thick + 2:
            return  # above the cut through the stem
        radii = numpy.linspace(thick, max(1.0, 0.7 * thick), len(points)) * self.ripple(len(points), 0.05)
        start = self.truth.lines[parent][at]
        reach = self.truth.radii[parent][at]
        away = numpy.linalg.norm(points - start, axis=1)
        near = cKDTree(numpy.concatenate(self.points))
        owner, balls = numpy.concatenate(self.owner), numpy.concatenate(self.reach)
        free = 1.3 * reach + 3 * thick + 3  # where the whorl is one body
        touched = set()
        inside = numpy.ones(len(points), bool)
        for which, (point, radius) in enumerate(zip(points, radii)):
            others = near.query_ball_point(point, radius + balls.max() + 0.5)
            gap = numpy.linalg.norm(near.data[others] - point, axis=1) - balls[others] - radius
            whose = owner[others]
            inside[which] = ((whose == parent) & (gap < -radius)).any()  # the axis lies within the parent
            if away[which] < free:
                continue
            if (gap < -0.8).any() or ((whose == parent) & (gap < 1)).any():
                return
            touched.update(whose[gap < 0.5].tolist())
        first = int(numpy.flatnonzero(inside).max()) + 1 if inside.any() else 0
        if len(points) - first < 12 or len(touched) > 2:
            return
        self.contacts += len(touched)
        number = self.truth.add(points[first:], radii[first:], self.truth.levels[parent] + 1, parent)
        self.keep(points, radii, number)

    def keep(self, points, radii, number):
        self.points.append(points)
        self.reach.append(radii)
        self.owner.append(numpy.full(len(points), number))

    def volume(self):
        """Grey values as bytes, and what is added to places to find them in it. Soil and air are dark."""
        points, radii = numpy.concatenate(self.points), numpy.concatenate(self.reach)
        low = numpy.floor((points - radii[:, None]).min(0)) - 6
        low[2] = 0  # the stem is cut where the scan begins
        size = (numpy.ceil((points + radii[:, None]).max(0)) + 7 - low).astype(int)
        grey = numpy.zeros(size, numpy.float32)
        for owner in range(len(self.points)):
            self.fill(grey, self.points[owner] - low, self.reach[owner])
        if self.hollow:
            depth, wall = self.hollow
            pith = numpy.zeros(size, numpy.float32)
            inner = self.axis[:, 2] < depth
            fade = numpy.minimum(1, (depth - self.axis[inner][:, 2]) / self.radius)
            self.fill(pith, self.axis[inner] - low, (self.thick[inner] - wall) * numpy.sqrt(fade))
            grey = numpy.minimum(grey, 1 - pith)
        noise = self.uniform(0.03, 0.12)
        grey = gaussian_filter(grey, 0.5) + gaussian_filter(
            self.random.standard_normal(size).astype(numpy.float32), 0.6) * noise / 0.37
        return numpy.clip(40 + 160 * grey, 0, 255).astype(numpy.uint8), -low

    @staticmethod
    def fill(grey, points, radii):
        for (x, y, z), radius in zip(points, radii):
            if radius <= 0:
                continue
            begin = [max(0, int(c - radius - 1)) for c in (x, y, z)]
            end = [min(n, int(c + radius + 3)) for c, n in zip((x, y, z), grey.shape)]
            i, j, k = numpy.ogrid[begin[0]:end[0], begin[1]:end[1], begin[2]:end[2]]
            away = numpy.sqrt((i - x) ** 2 + (j - y) ** 2 + (k - z) ** 2)
            box = grey[begin[0]:end[0], begin[1]:end[1], begin[2]:end[2]]
            numpy.maximum(box, numpy.clip(radius + 0.5 - away, 0, 1), out=box)


def write_nrrd(path, grey):
    with open(path, "wb") as file:
        file.write(("NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
                    f"sizes: {grey.shape[0]} {grey.shape[1]} {grey.shape[2]}\n"
                    "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n").encode())
        file.write(grey.tobytes(order="F"))


def evaluate(program, seed, folder):
    crown = Crown(seed)
    grey, offset = crown.volume()
    write_nrrd(f"{folder}/{seed}.nrrd", grey)
    subprocess.run([program, "roots", f"{folder}/{seed}.nrrd", "--no-pictures", "-q", "-o", f"{folder}/{seed}"],
                   check=True)
    for lines in crown.truth.lines:
        lines += offset
    middle, length, level, radius, _ = crown.truth.samples()
    tips = [line[-1] for line in crown.truth.lines] + [crown.truth.lines[0][0]]
    at_tips = [radii[-1] for radii in crown.truth.radii] + [crown.truth.radii[0][0]]
    found = outside_parents(read_rsml(f"{folder}/{seed}/roots.rsml"))
    figures = compare(found, middle, level, length, radius, numpy.array(tips), numpy.array(at_tips))
    figures["stem %"], _ = stem_path(found, crown.truth.lines[0], crown.truth.radii[0])
    balanced = balance(f"{folder}/{seed}")
    figures["balance"] = balanced
    return crown, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=None)
    parser.add_argument("--keep", default=None)
    arguments = parser.parse_args()
    first = arguments.first if arguments.first is not None else int.from_bytes(os.urandom(3), "little")
    columns = ["stem %", "tips found %", "spurious %", "length %", "level %"]
    print("| seed | stem thick | roots | contacts | hollow | " + " | ".join(columns) + " | roots found | levels |")
    print("| --- " * (7 + len(columns)) + "|")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + arguments.seeds):
            crown, figures = evaluate(arguments.program, seed, arguments.keep or folder)
            rows.append([figures[name] for name in columns])
            print(f"| {seed} | {2 * crown.radius:.0f} | {len(crown.truth.lines)} | {crown.contacts} | "
                  f"{'yes' if crown.hollow else 'no'} | " + " | ".join(f"{value:.1f}" for value in rows[-1]) +
                  f" | {figures['roots']} | {figures['levels']} |", flush=True)
            if arguments.keep:
                print(figures["balance"], file=sys.stderr)
    print("| mean | | | | | " + " | ".join(f"{value:.1f}" for value in numpy.mean(rows, 0)) + " | | |")


if __name__ == "__main__":
    main()
