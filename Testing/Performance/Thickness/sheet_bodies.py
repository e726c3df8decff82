"""Bodies whose sheets, seams, junctions and rods are known: distances to their middles, in mm; walls are 5 thick."""
import numpy as np

import foams

SHORTEST = 10  # mm, of a foam's seams, and of its walls' widths: twice the walls' thickness
SHARPEST = 60  # degrees between two of its walls
RIM = 5  # mm beyond a foam's rim nothing else begins


def walls_about_a_line(p, angles, half):
    """Distance to walls that meet in the z axis, and to their rims."""
    distance = np.full(p[0].shape, np.inf)
    for angle in angles:
        along = p[0] * np.cos(angle) + p[1] * np.sin(angle)
        across = p[1] * np.cos(angle) - p[0] * np.sin(angle)
        distance = np.minimum(distance, np.hypot(across, np.maximum(0, -along)))
    return np.maximum(distance, np.maximum(np.hypot(p[0], p[1]) - half, np.abs(p[2]) - half) + 2.5)


def cells(p, points):
    """Distance to the walls between the cells of some points."""
    squared = np.stack([(p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2 for q in points])
    first = squared.argmin(0)
    nearest = np.take_along_axis(squared, first[None], 0)[0]
    distance = np.full(p[0].shape, np.inf)
    for k, q in enumerate(points):
        apart = np.sqrt(((points - q) ** 2).sum(1))[first]
        wall = (squared[k] - nearest) / (2 * np.maximum(apart, 1e-9))
        distance = np.where(first == k, distance, np.minimum(distance, wall))
    return distance


def rounded(distance, p, reach):
    """Walls that end in a ball, with round rims."""
    return np.hypot(distance, np.maximum(0, radius(p) - reach))


def radius(p):
    return np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)


def strut(p, a, b):
    """Distance to the piece of a line from a to b."""
    a, b = np.array(a, float), np.array(b, float)
    along = (b - a) / np.linalg.norm(b - a)
    t = np.clip(sum((p[k] - a[k]) * along[k] for k in range(3)), 0, np.linalg.norm(b - a))
    return np.sqrt(sum((p[k] - a[k] - t * along[k]) ** 2 for k in range(3)))


def slab(p, half, thick):
    """A disc of this thickness, its rim round, as the distance to its middle less what walls of 5 have more."""
    return np.hypot(p[2], np.maximum(0, np.hypot(p[0], p[1]) - half + thick / 2)) - thick / 2 + 2.5


def gyroid(p, half):
    """(its value, its gradient, both in mm)"""
    t = 2 * np.pi / (0.9 * half)
    (a, b, c), (u, v, w) = [np.sin(q * t) for q in p], [np.cos(q * t) for q in p]
    return (a * v + b * w + c * u) / t, [u * v - c * a, v * w - a * b, w * u - b * c]


def cut_gyroid(p, half):
    """With a rim like a wedge, which has holes where it is thinner than a voxel."""
    return np.maximum(np.abs(gyroid(p, half)[0]) / 1.73, radius(p) - half + 2.5)


def round_gyroid(p, half):
    """Distance to the piece of a gyroid in a ball, by its nearest point, and the way along it to the rim."""
    value, _ = gyroid(p, half)
    near = np.abs(value) < 5
    at = [q[near] for q in p]
    foot = at
    for _ in range(4):
        value, slope = gyroid(foot, half)
        square = np.maximum(sum(s ** 2 for s in slope), 0.1)
        foot = [q - value * s / square for q, s in zip(foot, slope)]
    value, slope = gyroid(foot, half)
    out = radius(foot)
    upright = sum(q * s for q, s in zip(foot, slope)) / (out * np.sqrt(sum(s ** 2 for s in slope)))
    way = np.maximum(0, out - 0.867 * half) / np.sqrt(np.maximum(1 - upright ** 2, 0.01))
    distance = np.full(near.shape, np.inf)
    # Where steps led nowhere the value says so.
    distance[near] = np.sqrt(sum((q - f) ** 2 for q, f in zip(at, foot)) + way ** 2) + 10 * np.abs(value)
    return distance


def box_frame(p, half):
    c = half / 1.9
    corners = [(x, y, z) for x in (-c, c) for y in (-c, c) for z in (-c, c)]
    edges = [(a, b) for a in corners for b in corners if a < b and sum(u != v for u, v in zip(a, b)) == 1]
    return np.minimum.reduce([strut(p, a, b) for a, b in edges])


def moebius(p, half):
    turn = np.arctan2(p[1], p[0])
    out = np.hypot(p[0], p[1]) - 0.68 * half
    along = out * np.cos(turn / 2) + p[2] * np.sin(turn / 2)
    across = p[2] * np.cos(turn / 2) - out * np.sin(turn / 2)
    return np.maximum(np.abs(across), np.abs(along) - 0.26 * half + 2.5)


TETRAHEDRON = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) * 10.0

# Per body: its distance, and its counts of sheets, seams, junctions, rods.
BODIES = {
    "plate": (lambda p, h: np.maximum(np.abs(p[2]), np.hypot(p[0], p[1]) - h + 2.5), (1, 0, 0, 0)),
    "closed shell": (lambda p, h: np.abs(radius(p) - h + 3), (1, 0, 0, 0)),
    "Moebius band": (moebius, (1, 0, 0, 0)),
    "Y of three walls": (lambda p, h: walls_about_a_line(p, [0.1, 2.1, 4.3], h), (3, 1, 0, 0)),
    "X of four walls": (lambda p, h: walls_about_a_line(p, [0, 1.5, 3.1, 4.7], h), (4, 1, 0, 0)),
    "four cells": (lambda p, h: np.maximum(cells(p, TETRAHEDRON), radius(p) - h + 2.5), (6, 4, 1, 0)),
    "gyroid, round rim": (round_gyroid, (1, 0, 0, 0)),
    "gyroid cut by a sphere": (cut_gyroid, (1, 0, 0, 0)),
    "plate, in its middle 9 thick": (lambda p, h: np.minimum(slab(p, h, 5), slab(p, 0.6 * h, 9)), (1, 0, 0, 0)),
    "plate with a rod": (
        lambda p, h: np.minimum(slab([p[0], p[1], p[2] + h / 3], h, 5), strut(p, (0, 0, -h / 3), (0, 0, h - 6))),
        (1, 0, 1, 1)),
    "box frame": (box_frame, (0, 0, 8, 12)),
}


def foam(random, half):
    """(its distance, its counts)"""
    points, counts = foams.random_foam(random, half - 5, SHORTEST, SHARPEST, RIM)
    return (lambda p, h: rounded(cells(p, points), p, h - 5)), (*counts, 0)
