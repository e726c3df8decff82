#!/usr/bin/env python3
"""Local thickness against its definition on bodies drawn afresh: the diameter of the largest ball inscribed in the true
body that holds a voxel's centre.
usage: inscribed.py PROGRAM [BODIES [SEED [KIND ...]]]   (python3-numpy, python3-scipy)
Prints the seed and, per kind and spacing, the bias and the mean absolute error in mm (a voxel is 1 x 1 x 1 or 1 x 1 x
2.5), means over bodies of means over voxels: of the default, of --refine off, of that with half a voxel (of a cube of
the voxel's volume) added, and of a distance map with painted balls. Last, how many of all voxels lie outside the
program's own bounds."""
import secrets
import subprocess
import sys
import tempfile

import numpy as np
from scipy.spatial import cKDTree

from bodies import random_turn, read_nrrd, write_nrrd

SIDE = 36.0  # mm
FINE = 0.4  # mm between places from which the true balls are sought


def smooth_noise(random, wave):
    """A function with waves of about that length and a deviation of 1."""
    count = 24
    k = random.normal(size=(count, 3))
    k *= (2 * np.pi / wave * random.uniform(0.7, 1.3, count) / np.linalg.norm(k, axis=1))[:, None]
    phase = random.uniform(0, 2 * np.pi, count)
    return lambda p: np.sqrt(2 / count) * sum(np.cos(k[i] @ np.stack([q.ravel() for q in p]) + phase[i])
                                              for i in range(count)).reshape(p[0].shape)


def walls_of_cells(points, thickness):
    """Between the Voronoi cells of points."""

    def depth(p):
        squared = np.stack([sum((p[k] - c[k])**2 for k in range(3)) for c in points])
        own = squared.argmin(0)
        least = np.full(own.shape, np.inf)
        for i, a in enumerate(points):
            for j, b in enumerate(points):
                if i != j:
                    away = (squared[j] - squared[i]) / (2 * np.linalg.norm(a - b))
                    least = np.where(own == i, np.minimum(least, away), least)
        return least - thickness / 2

    return depth


def body(kind, random):
    """Gives a function of places, mm from the middle, that is below 0 within a body at a random turn."""
    turn, half, shift = random_turn(random), SIDE / 2 - 3, random.uniform(-0.5, 0.5, 3)

    def turned(p):
        return [sum(turn[m][k] * (p[m] - shift[m]) for m in range(3)) for k in range(3)]

    def norm(q):
        return np.sqrt(sum(x * x for x in q))

    if kind == "elliptic tube":
        b = random.uniform(1.5, 4.5)
        a = min(b * random.uniform(1, 3), 0.9 * half)
        f = lambda q: np.maximum((np.hypot(q[0] / a, q[1] / b) - 1) * b, np.abs(q[2]) - half)
    elif kind == "ellipsoid":
        b = random.uniform(1.5, 4)
        a, c = (min(b * random.uniform(1, 3), half) for _ in range(2))
        f = lambda q: (norm([q[0] / a, q[1] / b, q[2] / c]) - 1) * b
    elif kind == "rough tube":
        r, noise, height = random.uniform(2, 5), smooth_noise(random, random.uniform(4, 8)), random.uniform(0.2, 0.5)
        f = lambda q: np.maximum(np.hypot(q[0], q[1]) - r - height * noise(q), np.abs(q[2]) - half)
    elif kind == "plate":
        t, bulge = random.uniform(2, 16), random.uniform(1, 1.6) / 2
        edge = 0.8 * half - bulge * t

        def f(q):
            away = np.hypot(q[0], q[1])
            rim = np.hypot(away - edge, q[2]) - bulge * t
            return np.minimum(np.maximum(np.abs(q[2]) - t / 2, away - edge), rim)
    elif kind == "shell":
        t = random.uniform(2, 7)
        f = lambda q: np.abs(norm(q) - half + t / 2) - t / 2
    elif kind == "trabeculae":
        wave, noise, level = random.uniform(10, 18), None, random.uniform(0.1, 0.5)
        noise = smooth_noise(random, wave)
        f = lambda q: np.maximum((noise(q) + level) * wave / 6, norm(q) - half)
    elif kind == "foam":
        walls = walls_of_cells(random.uniform(-0.8 * half, 0.8 * half, (random.integers(5, 9), 3)),
                               random.uniform(2.5, 5))
        f = lambda q: np.maximum(walls(q), norm(q) - half)
    elif kind == "rod":
        r = random.uniform(1.5, 6)
        f = lambda q: np.maximum(np.hypot(q[0], q[1]) - r, np.abs(q[2]) - half)
    elif kind == "sphere":
        r = random.uniform(2, 8)
        f = lambda q: norm(q) - r
    return lambda p: f(turned(p))


KINDS = ["elliptic tube", "ellipsoid", "rough tube", "plate", "shell", "trabeculae", "foam", "rod", "sphere"]


def columns(places):
    return [places[:, k] for k in range(3)]


def points_on(f, grid, values):
    """Where the surface passes the edges of a grid, by bisection and false position in turn."""
    found = []
    for k, axis in ((0, 2), (1, 1), (2, 0)):
        count = values.shape[axis]
        a, b = np.take(values, range(count - 1), axis), np.take(values, range(1, count), axis)
        passes = (a < 0) != (b < 0)
        low = np.stack([np.take(g, range(count - 1), axis)[passes] for g in grid], -1)
        high, at_low, at_high = low.copy(), a[passes].copy(), b[passes].copy()
        high[:, k] += FINE
        for _ in range(6):
            t = np.clip(at_low / (at_low - at_high), 0.05, 0.95)
            middle = low + (high - low) * t[:, None]
            value = f(columns(middle))
            same = (value < 0) == (at_low < 0)
            low[same], at_low[same] = middle[same], value[same]
            high[~same], at_high[~same] = middle[~same], value[~same]
        found.append(np.where((np.abs(at_low) < np.abs(at_high))[:, None], low, high))
    return np.concatenate(found)


def paint(mask, spacing, centres, radii):
    """Centres in mm x, y, z from the grid's corner."""
    sides, out = np.array(spacing[::-1]), np.zeros(mask.shape, np.float32)
    for i in np.argsort(radii, kind="stable"):
        r, c = radii[i], centres[i][::-1]
        low = np.maximum(np.ceil((c - r) / sides - 0.5).astype(int), 0)
        end = np.minimum(np.floor((c + r) / sides - 0.5).astype(int) + 1, mask.shape)
        if r > 0 and np.all(end > low):
            z, y, x = (((np.arange(low[k], end[k]) + 0.5) * sides[k] - c[k])**2 for k in range(3))
            ball = z[:, None, None] + y[None, :, None] + x[None, None, :] <= r * r + 1e-9
            out[low[0]:end[0], low[1]:end[1], low[2]:end[2]][ball] = 2 * r  # ascending: later ones are greater
    return out * mask


def true_thickness(f, spacing):
    """(mask, thickness): balls about places on a fine grid, each moved to where it is greatest nearby."""
    size = [int(round(SIDE / s)) for s in spacing]
    corner = np.array([n * s / 2 for n, s in zip(size, spacing)])
    coarse = [(np.arange(n) + 0.5) * s - c for n, s, c in zip(size, spacing, corner)]
    z, y, x = np.meshgrid(coarse[2], coarse[1], coarse[0], indexing="ij")
    mask = f([x, y, z]) < 0
    axis = (np.arange(int(SIDE / FINE)) + 0.5) * FINE - SIDE / 2
    grid = np.meshgrid(axis, axis, axis, indexing="ij")[::-1]
    values = f(grid)
    inside = values < 0
    tree = cKDTree(points_on(f, grid, values))
    distance = np.full(values.shape, -1.0)
    distance[inside] = tree.query(np.stack([g[inside] for g in grid], -1))[0]
    ridge = inside.copy()
    for step in np.ndindex(3, 3, 3):
        if step != (1, 1, 1):
            way = np.array(step) - 1
            ridge &= ~(np.roll(distance, way, (0, 1, 2)) >= distance + 0.9 * FINE * np.linalg.norm(way))
    centres = np.stack([g[ridge] for g in grid], -1)
    radii, nearest = tree.query(centres)
    for scale in (0.8, 0.4, 0.2):
        away = centres - tree.data[nearest]
        away /= np.maximum(np.linalg.norm(away, axis=1), 1e-9)[:, None]
        best, greatest = centres.copy(), radii.copy()
        for part in (-1, -0.5, 0.5, 1):
            there = centres + away * (part * scale * FINE)
            radius = np.where(f(columns(there)) < 0, tree.query(there)[0], -1)
            better = radius > greatest
            best[better], greatest[better] = there[better], radius[better]
        centres = best
        radii, nearest = tree.query(centres)
    truth = paint(mask, spacing, centres + corner, radii)
    left = mask & (truth == 0)
    truth[left] = 2 * tree.query(np.stack([q[left] for q in (x, y, z)], -1))[0]
    return mask, truth


def distance_map(mask, spacing):
    """As ImageJ's: balls about voxels' centres as great as these are far from the nearest centre that is out."""
    from scipy import ndimage
    radii = ndimage.distance_transform_edt(mask, sampling=spacing[::-1])
    at = np.argwhere(mask)
    return paint(mask, spacing, ((at + 0.5) * np.array(spacing[::-1]))[:, ::-1], radii[mask])


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else secrets.randbelow(10**6)
    kinds = sys.argv[4:] or KINDS
    print(f"seed {seed}, {count} bodies of each kind and spacing; bias, mean absolute error, mm")
    print("| body | spacing | default | --refine off | off + half a voxel | distance map |")
    print("| --- | --- | --- | --- | --- | --- |")
    outside = voxels = 0
    with tempfile.TemporaryDirectory() as folder:

        def run(*more):
            subprocess.run([program, "thickness", f"{folder}/a.nrrd", "-o", f"{folder}/t.nrrd", "--force", "-q", *more],
                           check=True)
            return read_nrrd(f"{folder}/t.nrrd")

        for kind in kinds:
            for spacing in ((1, 1, 1), (1, 1, 2.5)):
                errors = []
                for number in range(count):
                    random = np.random.default_rng([seed, KINDS.index(kind), int(2 * spacing[2]), number])
                    mask, truth = true_thickness(body(kind, random), spacing)
                    if not mask.any():
                        continue
                    write_nrrd(f"{folder}/a.nrrd", mask, spacing)
                    found = run("--bounds")
                    lower, upper = (read_nrrd(f"{folder}/t_{which}.nrrd") for which in ("lower", "upper"))
                    outside += int(((found < lower) | (found > upper))[mask].sum())
                    voxels += int(mask.sum())
                    off = run("--refine", "off")
                    maps = [found, off, off + 0.5 * np.cbrt(np.prod(spacing)), distance_map(mask, spacing)]
                    errors.append([((m - truth)[mask].mean(), np.abs(m - truth)[mask].mean()) for m in maps])
                cells = " | ".join(f"{bias:+.2f}, {mean:.2f}" for bias, mean in np.mean(errors, axis=0))
                print(f"| {kind} | 1:1:{spacing[2]:g} | {cells} |", flush=True)
    print(f"{outside} of {voxels} voxels outside the bounds")
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(main())
