#!/usr/bin/env python3
"""Branches that keep their numbers over time: drawn root systems that grow, of which all is known.

usage: follow.py PROGRAM [--seeds 20] [--first 1] [--days 8] [--noise 0.4] [--folder FOLDER]

A root system is drawn of curved ways that are walked step by step: a tap root, laterals, laterals of these, each with
its day of birth and its rate. By day tips advance, older parts thicken, new laterals come; each day is turned at
random by any angle, shifted, and made voxels, of which the largest piece stays. Noise moves the surface, by 0.4 voxels
(standard deviation), alike within 0.8 voxels. One lateral is hidden on one day, as an artefact hides it, with all
that springs from it. A row a seed:

ids       of roots, told by the half before their tips, that are seen on two days that follow each other, how many have
          one number, which no other root has
back      whether the hidden root has its number again, days at a time
wrong     branches whose tip is on no root
growth    of all roots from day to day while their number is kept, by how much the sum is off; the median over those
          that grew by 10 voxels and more
move      by how much a day's motion misplaces the day before, voxels: root mean square, of the worst day

Exit 1 if fewer than 95 % of all identities are kept or growth is off by more than 3 %.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
import tempfile

import numpy
from scipy import ndimage

from hollow_warning import write_nrrd

SEEN = 4.0  # voxels beyond its parent's surface from which on a root counts: shorter ones no skeleton shows


class Root:
    def __init__(self, parent, at, way, birth, rate, radius):
        self.parent, self.at, self.way, self.birth, self.rate, self.radius = parent, at, way, birth, rate, radius
        self.arcs = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(way, axis=0), axis=1))])

    def length(self, day):
        return float(numpy.clip(self.rate * (day - self.birth), 0, self.arcs[-1]))

    def line(self, day):
        """Points from base to tip and the radius at each: older parts are thicker, the tip tapers."""
        length = self.length(day)
        arcs = numpy.append(self.arcs[self.arcs < length], length)
        points = numpy.stack([numpy.interp(arcs, self.arcs, self.way[:, k]) for k in range(3)], 1)
        age = day - self.birth - arcs / self.rate
        radii = (self.radius + 0.12 * age) * (0.7 + 0.3 * numpy.minimum(1, (length - arcs) / 8))
        return points, radii


def walk(random, start, way, length, down):
    """A way whose direction turns a little with each step of half a voxel."""
    points, bend = [start], random.normal(0, 0.02, 3)
    for _ in range(int(2 * length)):
        bend = 0.97 * bend + random.normal(0, 0.006, 3)
        way = way + bend + down * numpy.array([0, 0, -0.01])
        way = way / numpy.linalg.norm(way)
        points.append(points[-1] + way / 2)
    return numpy.array(points)


def draw(random, days):
    """Roots none of which comes near another but where it springs from."""
    roots = [Root(None, 0, walk(random, numpy.zeros(3), numpy.array([0, 0, -1.0]), 80 + 8 * days, 0.2),
                  1 - 80 / 8, 8.0, 3.2)]
    wanted = random.integers(10, 16)
    for attempt in range(600):
        if len(roots) > wanted:
            break
        second = len(roots) > 6 and random.random() < 0.35
        parent = roots[random.integers(1, len(roots))] if second else roots[0]
        birth = random.uniform(-3, days - 1.5)
        reach = parent.length(birth) - (6 if second else 12)
        if reach < 6:
            continue
        at = random.uniform(6, reach)
        place = numpy.searchsorted(parent.arcs, at)
        along = parent.way[min(place + 1, len(parent.way) - 1)] - parent.way[place - 1]
        across = numpy.cross(along, random.normal(0, 1, 3))
        way = across / numpy.linalg.norm(across) + random.uniform(0.0, 0.5) * along / numpy.linalg.norm(along)
        rate = random.uniform(2.5, 5)
        length = rate * (days + 1 - birth)
        root = Root(parent, parent.arcs[place],
                    walk(random, parent.way[place], way / numpy.linalg.norm(way), length, 0.2), birth, rate,
                    1.7 if second else random.uniform(2, 2.4))
        if not clashes(root, roots):
            roots.append(root)
    return roots


def clashes(root, roots):
    own = root.way[::4]
    for other in roots:
        away = numpy.linalg.norm(own[:, None] - other.way[None, ::4], axis=2).min(1)
        if other is root.parent:
            away = away[root.arcs[::4] > 12]
        if len(away) and away.min() < 8:
            return True
    return False


def turn(random):
    q = random.normal(0, 1, 4)
    w, x, y, z = q / numpy.linalg.norm(q)
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def solid(lines, random, noise):
    """Voxels of round cones, and what the first one's place is: the largest piece, with noise at the surface."""
    low = numpy.floor(numpy.min([points.min(0) for points, _ in lines], 0)) - 8
    size = (numpy.ceil(numpy.max([points.max(0) for points, _ in lines], 0)) + 8 - low).astype(int)
    depth = numpy.full(size, 9.0, numpy.float32)
    for points, radii in lines:
        for a, b, p, q in zip(points[:-1], points[1:], radii[:-1], radii[1:]):
            reach = max(p, q) + 3
            begin = numpy.maximum(numpy.floor(numpy.minimum(a, b) - reach - low), 0).astype(int)
            end = numpy.minimum(numpy.ceil(numpy.maximum(a, b) + reach - low) + 1, size).astype(int)
            grid = numpy.stack(numpy.meshgrid(*[numpy.arange(i, j) for i, j in zip(begin, end)], indexing="ij"), -1)
            way = b - a
            share = numpy.clip(((grid + low - a) @ way) / max(way @ way, 1e-12), 0, 1)
            away = numpy.linalg.norm(grid + low - a - share[..., None] * way, axis=-1) - (p + share * (q - p))
            part = depth[tuple(slice(i, j) for i, j in zip(begin, end))]
            numpy.minimum(part, away, out=part)
    rough = ndimage.gaussian_filter(random.normal(0, 1, depth.shape), 0.8)
    mask = depth + noise / rough.std() * rough < 0
    pieces, count = ndimage.label(mask)
    mask = pieces == numpy.argmax(numpy.bincount(pieces.ravel())[1:]) + 1
    return ndimage.binary_fill_holes(mask), low


def write(path, mask, low):
    write_nrrd(path, mask.transpose(2, 1, 0).astype("u1"), [1, 1, 1])
    with open(path, "rb") as file:
        data = file.read()
    origin = f"space origin: ({','.join(repr(float(k)) for k in low)})\n".encode()
    with open(path, "wb") as file:
        file.write(data.replace(b"encoding:", origin + b"encoding:", 1))


def follow(program, files, output, *more):
    done = subprocess.run([program, "follow", *files, "-o", output, "--force", *more], text=True, capture_output=True)
    if done.returncode != 0:
        print("#  ", done.stderr.strip())
        return None
    for line in done.stderr.splitlines():
        print("#  ", line)
    with open(os.path.join(output, "days.csv")) as file:
        days = list(csv.DictReader(file))
    rows = {}
    with open(os.path.join(output, "branches.csv")) as file:
        for row in csv.DictReader(file):
            if row["state"] != "lost":
                rows[int(row["day"]), int(row["id"])] = float(row["growth"] or "nan")
    return days, rows, lines_of(output, len(days))


def lines_of(output, count):
    """The polylines of day-N.rsml by day and id."""
    import xml.etree.ElementTree as tree
    lines = {}
    for day in range(1, count + 1):
        for root in tree.parse(os.path.join(output, f"day-{day}.rsml")).iter("root"):
            points = root.find("geometry/polyline").findall("point")
            lines[day, int(root.get("ID").split("-")[1])] = numpy.array(
                [[float(point.get(axis)) for axis in "xyz"] for point in points])
    return lines


def motion_of(row):
    """Of a day into the space of the first."""
    return (numpy.array([[float(row[f"r{i}{j}"]) for j in (1, 2, 3)] for i in (1, 2, 3)]),
            numpy.array([float(row[axis]) for axis in "xyz"]))


def dense(points):
    """Places half a voxel apart."""
    arcs = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
    at = numpy.arange(0, arcs[-1] + 0.25, 0.5)
    return numpy.stack([numpy.interp(at, arcs, points[:, k]) for k in range(3)], 1), at


def score(truth, found, count):
    """truth: by day a list of (key, points in that day's scan, radii, length, parent's radius at the base); hidden keys
    are left out. What numbers roots have by day, and the growth of both."""
    days, rows, lines = found
    motions = [motion_of(row) for row in days]
    ids, lengths, wrong = {}, {}, 0
    for day in range(1, count + 1):
        roots = [root for root in truth[day]]
        shares = {}
        for (other, number), line in lines.items():
            if other != day:
                continue
            turned, shift = motions[day - 1]
            places, arcs = dense((line - shift) @ turned)
            away = []
            for key, points, radii, _, base in roots:  # of each the half before its tip, outside its parent
                own, along = dense(points)
                own = own[along >= min(base, along[-1]) + (along[-1] - min(base, along[-1])) / 2]
                away.append(numpy.linalg.norm(places[:, None] - own[None], axis=2).min(1))
            nearest = numpy.argmin(away, 0)
            isNear = numpy.min(away, 0) < 3
            counts = numpy.bincount(nearest[isNear], minlength=len(roots)) / 2
            wrong += all(numpy.linalg.norm(places[-1] - points, axis=1).min() > 3 for _, points, *_ in roots)
            for k, length in enumerate(counts):
                shares.setdefault(roots[k][0], []).append((length, number))
        for key, points, radii, length, base in roots:
            if length - base >= SEEN:
                best = max(shares.get(key, [(0, 0)]))
                ids[day, key] = best[1] if best[0] >= 0.25 * (length - base) else 0
                lengths[day, key] = length
    # A number that stands for two roots on one day is right for neither but that with most of it: the others' are 0.
    for day in range(1, count + 1):
        taken = {}
        for (other, key), number in ids.items():
            if other == day and number:
                taken.setdefault(number, []).append(key)
        for number, keys in taken.items():
            for key in sorted(keys, key=lambda one: -lengths[day, one])[1:]:
                ids[day, key] = 0
    pairs = kept = 0
    measured = true = 0
    grown = {}
    for (day, key), number in ids.items():
        if (day + 1, key) in ids:
            pairs += 1
            other = ids[day + 1, key]
            kept += number != 0 and number == other
            if number and number == other:
                more = rows[day + 1, other]
                measured += more
                true += lengths[day + 1, key] - lengths[day, key]
                one = grown.setdefault(key, [0, 0])
                one[0] += more
                one[1] += lengths[day + 1, key] - lengths[day, key]
    errors = [abs(a / b - 1) for a, b in grown.values() if b >= 10]
    return ids, pairs, kept, wrong, measured, true, errors


def series(program, name, roots, count, random, noise, folder):
    """Draws the days and follows them; the files are called by `name`."""
    candidates = [k for k, root in enumerate(roots) if root.parent is roots[0] and root.birth < count - 5
                  and root.length(count) < 0.1 * sum(other.length(count) for other in roots)]
    hidden = roots[candidates[random.integers(len(candidates))]] if candidates else None
    gone = int(random.integers(3, count)) if hidden else 0
    files, truth, moves = [], {}, []
    for day in range(1, count + 1):
        move = turn(random), random.uniform(-20, 20, 3)
        moves.append(move)
        lines, truth[day] = [], []
        for key, root in enumerate(roots):
            above = root
            while above is not None and not (above is hidden and day == gone):
                above = above.parent
            if root.length(day) < 1 or above is not None:
                continue
            points, radii = root.line(day)
            lines.append((points @ move[0].T + move[1], radii))
            base = 0
            if root.parent is not None:
                way, around = root.parent.line(day)
                base = around[numpy.argmin(numpy.linalg.norm(way - points[0], axis=1))]
            truth[day].append((key, points @ move[0].T + move[1], radii, root.length(day), base))
        mask, low = solid(lines, random, noise)
        files.append(os.path.join(folder, f"{name}-day{day}.nrrd"))
        write(files[-1], mask, low)
    top = moves[0][0] @ roots[0].way[0] + moves[0][1]
    found = follow(program, files, os.path.join(folder, name), "--root", ",".join(f"{k:.3f}" for k in top))
    if found is None:
        return None
    ids, *numbers = score(truth, found, count)
    off, before = [], None
    for row, move, day in zip(found[0], moves, range(1, count + 1)):
        turned, shift = motion_of(row)
        if before is not None:  # where the day before would be put in this day's scan, and where it is
            points = numpy.concatenate([root.line(day - 1)[0] for root in roots if root.length(day - 1) > 1])
            there = ((points @ before[2].T + before[3]) @ before[0].T + before[1] - shift) @ turned
            off.append(numpy.sqrt((numpy.linalg.norm(there - points @ move[0].T - move[1], axis=1) ** 2).mean()))
        before = turned, shift, *move
    back = "-"
    if hidden is not None:
        key = roots.index(hidden)
        if ids.get((gone - 1, key)) and (gone + 1, key) in ids:
            back = "yes" if ids[gone - 1, key] == ids[gone + 1, key] else "no"
    return len(roots), back, max(off), numbers


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--days", type=int, default=8)
    parser.add_argument("--noise", type=float, default=0.4)
    parser.add_argument("--folder")
    options = parser.parse_args()
    folder = options.folder or tempfile.mkdtemp()
    sums, errors, failed, backs = numpy.zeros(5), [], 0, []
    print("seed  roots  pairs  ids      back  wrong  growth   median   move", flush=True)
    for seed in range(options.first, options.first + options.seeds):
        random = numpy.random.default_rng(seed)
        result = series(options.program, f"seed{seed}", draw(random, options.days), options.days, random,
                        options.noise, folder)
        if result is None:
            failed += 1
            continue
        roots, back, off, (pairs, kept, wrong, measured, true, each) = result
        sums += [pairs, kept, wrong, measured, true]
        errors += each
        backs.append(back)
        print(f"{seed:4}  {roots:5}  {pairs:5}  {100 * kept / pairs:5.1f} %  {back:4}  {wrong:5}  "
              f"{100 * (measured / true - 1):+5.1f} %  {100 * numpy.median(each):5.1f} %  {off:5.2f}", flush=True)
    pairs, kept, wrong, measured, true = sums
    ids, growth = 100 * kept / pairs, 100 * (measured / true - 1)
    back = f"{backs.count('yes')} of {backs.count('yes') + backs.count('no')}"
    print(f"all   {pairs:.0f} pairs, ids {ids:.2f} %, back {back}, wrong {wrong:.0f}, growth {growth:+.2f} %, "
          f"median {100 * numpy.median(errors):.2f} %, 90th percentile {100 * numpy.quantile(errors, 0.9):.2f} %, "
          f"refused {failed}")
    sys.exit(failed > 0 or ids < 95 or abs(growth) > 3)


if __name__ == "__main__":
    main()
