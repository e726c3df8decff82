#!/usr/bin/env python3
"""Counts of sheets, seams and junctions where they are known, at random turns, at twice the resolution, and with noise.
usage: sheets.py PROGRAM [TURNS [SEED]]   (python3-numpy)
Per body and variant: of how many turns the counts are as known, and those of the others."""
import collections
import json
import subprocess
import sys
import tempfile

import numpy as np

from bodies import places, random_turn, write_nrrd

PROGRAM = sys.argv[1]
TURNS = int(sys.argv[2]) if len(sys.argv) > 2 else 24
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1


def walls_about_a_line(p, angles, half):
    """Distance to walls that meet in the z axis, and to their rims."""
    distance = np.full(p[0].shape, np.inf)
    for angle in angles:
        along = p[0] * np.cos(angle) + p[1] * np.sin(angle)
        across = p[1] * np.cos(angle) - p[0] * np.sin(angle)
        distance = np.minimum(distance, np.hypot(across, np.maximum(0, -along)))
    return np.maximum(distance, np.maximum(np.hypot(p[0], p[1]) - half, np.abs(p[2]) - half) + 2.5)


def foam(p, points, half):
    """Distance to the walls between the cells of some points, within a ball."""
    squared = np.stack([(p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2 for q in points])
    first = squared.argmin(0)
    nearest = np.take_along_axis(squared, first[None], 0)[0]
    distance = np.full(p[0].shape, np.inf)
    for k, q in enumerate(points):
        apart = np.sqrt(((points - q) ** 2).sum(1))[first]
        wall = (squared[k] - nearest) / (2 * np.maximum(apart, 1e-9))
        distance = np.where(first == k, distance, np.minimum(distance, wall))
    return np.maximum(distance, np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2) - half + 2.5)


TETRAHEDRON = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) * 10.0


def body(kind, p, half):
    """Distance to the middle surface, mm; walls are 5 thick."""
    if kind == "plate":
        return np.maximum(np.abs(p[2]), np.hypot(p[0], p[1]) - half + 2.5)
    if kind == "Y of three walls":
        return walls_about_a_line(p, [0.1, 2.1, 4.3], half)
    if kind == "X of four walls":
        return walls_about_a_line(p, [0, 1.5, 3.1, 4.7], half)
    if kind == "closed shell":
        return np.abs(np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2) - half + 3)
    if kind == "four cells":
        return foam(p, TETRAHEDRON, half)
    if kind == "Moebius band":
        turn = np.arctan2(p[1], p[0])
        out = np.hypot(p[0], p[1]) - 0.68 * half
        along = out * np.cos(turn / 2) + p[2] * np.sin(turn / 2)
        across = p[2] * np.cos(turn / 2) - out * np.sin(turn / 2)
        return np.maximum(np.abs(across), np.abs(along) - 0.26 * half + 2.5)
    if kind.startswith("gyroid"):
        t = 2 * np.pi / (0.9 * half)
        x, y, z = p[0] * t, p[1] * t, p[2] * t
        value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        across, out = np.abs(value) / t / 1.73, np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2) - half + 2.5
        # Cut by a sphere its rim is a wedge, with holes where that is thinner than a voxel.
        return np.hypot(across, np.maximum(0, out + 2.5)) if kind == "gyroid, round rim" else np.maximum(across, out)
    raise ValueError(kind)


KNOWN = {
    "plate": (1, 0, 0),
    "closed shell": (1, 0, 0),
    "Moebius band": (1, 0, 0),
    "gyroid": (1, 0, 0),
    "gyroid, round rim": (1, 0, 0),
    "Y of three walls": (3, 1, 0),
    "X of four walls": (4, 1, 0),
    "four cells": (6, 4, 1),
}


def counts(mask, folder, more):
    write_nrrd(f"{folder}/a.nrrd", mask, (1, 1, 1))
    subprocess.run([PROGRAM, "sheets", f"{folder}/a.nrrd", "-o", f"{folder}/s.vtp", "--report", f"{folder}/r.json",
                    "--force", "-q", *more], check=True)
    with open(f"{folder}/r.json") as file:
        record = json.load(file)["sheets"][0]
    return tuple(record[name] for name in ("sheets", "seams", "junctions"))


print(f"seed {SEED}, {TURNS} turns; walls 5 voxels thick; sheets, seams, junctions")
print("| body | known | as they are | twice the resolution | noise of half a voxel |\n| --- | --- | --- | --- | --- |")
with tempfile.TemporaryDirectory() as folder:
    for kind, known in KNOWN.items():
        random = np.random.default_rng([SEED, len(kind)])
        cells = []
        for scale, noise, more in ((1, 0, []), (2, 0, []), (1, 0.5, ["--denoise"])):
            found = collections.Counter()
            for _ in range(TURNS if scale == 1 else max(1, TURNS // 4)):
                side = 64 * scale
                p = places([side] * 3, (1 / scale,) * 3, random.random(3) - 0.5, random_turn(random))
                distance = body(kind, p, 27)
                found[counts(distance + noise * random.standard_normal(distance.shape) < 2.5, folder, more)] += 1
            good = found.pop(known, 0)
            rest = ", ".join(f"{n} x {key}" for key, n in found.most_common(3))
            cells.append(f"{good} of {good + sum(found.values())}" + (f"; {rest}" if rest else ""))
        print(f"| {kind} | {known} | {' | '.join(cells)} |", flush=True)
