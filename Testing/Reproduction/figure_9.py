#!/usr/bin/env python3
"""Figure 9: the core of an ellipsoid against its medial axis, an ellipse's disc in the plane of the two longest axes,
and against its lambda-medial axis, that disc scaled by sqrt(1 - lambda^2/c^2). Hausdorff distances, both ways."""

import os
import tempfile

import numpy as np

from common import (Core, Kept, Middles, arguments, core, distance_to_core,
                    hang, paint, plt, require, save, write_nrrd, write_table)

A, B, C = 0.5, 0.35, 0.2  # semi-axes; the longest side of its box is about 1
LAMBDAS = [0, 1.5, 2.5, 5, 8.5]  # % of the longest side of the voxels' box


def rotation():
    """A turn along which no axis agrees with the grid's."""
    q = np.array([0.91, 0.17, -0.29, 0.23])
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def digitize(path, resolution, turn):
    """Gauss digitization, `resolution` voxels on the longest side; returns the size of a voxel."""
    half = np.sqrt(((turn * [A, B, C]) ** 2).sum(axis=1))
    step = 2 * half.max() / resolution
    size = np.ceil(2 * half / step - 1e-9).astype(int)
    x, y, z = (-half[a] + (np.arange(size[a]) + 0.5) * step for a in range(3))
    voxels = np.zeros(size, bool)
    # |D T p|^2 as a polynomial in z, its coefficients once for all x and y.
    form = (turn / np.square([A, B, C])) @ turn.T
    flat = form[0, 0] * x[:, None] ** 2 + 2 * form[0, 1] * x[:, None] * y + form[1, 1] * y ** 2
    slope = 2 * (form[0, 2] * x[:, None] + form[1, 2] * y)
    for k, height in enumerate(z):
        voxels[:, :, k] = flat + height * slope + form[2, 2] * height ** 2 <= 1
    write_nrrd(path, voxels, step, -half + 0.5 * step)
    return step


def to_disc(points, a, b):
    """Distances to the disc of the ellipse (a, b) in the plane z = 0."""
    p = np.abs(points)
    out = (p[:, 0] / a) ** 2 + (p[:, 1] / b) ** 2 > 1
    flat = np.zeros(len(p))
    u, v = p[out, 0], p[out, 1]
    # The foot is (a^2 u / (t + a^2), b^2 v / (t + b^2)) for the root t of a function that falls.
    low, high = np.zeros(len(u)), np.hypot(a * u, b * v) + 1e-12
    for _ in range(80):
        t = (low + high) / 2
        beyond = (a * u / (t + a * a)) ** 2 + (b * v / (t + b * b)) ** 2 > 1
        low, high = np.where(beyond, t, low), np.where(beyond, high, t)
    flat[out] = np.hypot(u - a * a * u / (high + a * a), v - b * b * v / (high + b * b))
    return np.hypot(flat, p[:, 2])


def farthest_from_disc(points, a, b):
    """The greatest of to_disc(): of those for which a bound from above, the way to the rim towards the middle, is
    greater."""
    over = np.sqrt((points[:, 0] / a) ** 2 + (points[:, 1] / b) ** 2)
    inward = np.hypot(points[:, 0], points[:, 1]) * np.where(over > 1, 1 - 1 / np.maximum(over, 1), 0)
    bound = np.hypot(inward, points[:, 2])
    order = np.argsort(-bound)
    greatest = 0.0
    for begin in range(0, len(order), 20000):
        if bound[order[begin]] <= greatest:
            break
        greatest = max(greatest, to_disc(points[order[begin:begin + 20000]], a, b).max())
    return greatest


def disc(a, b, count):
    """Points all over a disc, its rim included."""
    r = np.sqrt(np.linspace(0, 1, count))[:, None]
    t = 2 * np.pi * np.arange(6 * count)[None, :] / (6 * count)
    return np.stack([(a * r * np.cos(t)).ravel(), (b * r * np.sin(t)).ravel(), np.zeros(6 * count * count)], 1)


def draw(found, value):
    """As the paper has it: seen along the shortest axis; of the whole core what has the greatest measure lies in
    front."""
    return paint(found, np.eye(3), found.measure, pixels=230, box=(-A, A, -B, B), measure_first=value == 0,
                 colours="turbo" if value == 0 else "viridis", most=C)


def frame(panel, painted, value, n, semi):
    """With the axis' rim in red. The dashed rim is that of the lambda-medial axis."""
    hang(panel, painted)
    t = np.linspace(0, 2 * np.pi, 200)
    scale = np.sqrt(1 - (value / 100 / C) ** 2)  # the longest side of the voxels' box is about 1
    panel.plot(semi[0] * np.cos(t), semi[1] * np.sin(t), "r", linewidth=0.9)
    if value > 0:
        panel.plot(scale * semi[0] * np.cos(t), scale * semi[1] * np.sin(t), "r--", linewidth=0.6)
    panel.set_title(f"{n}, {'whole' if value == 0 else f'lambda {value} %'}", fontsize=7, pad=2)


def measure(options, n, turn, semi):
    """Of a resolution: the table's rows, the distances by (lambda, whether to the whole axis), and a picture by
    lambda."""
    rows, distances, painted = [], {}, {}
    with tempfile.TemporaryDirectory() as folder:
        scan = os.path.join(folder, "ellipsoid.nrrd")
        step = digitize(scan, n, turn)
        lambdas = ",".join("0" if v == 0 else f"{v}%" for v in LAMBDAS)
        report = core(options.program, scan, folder, "--lambda", lambdas, "-o", os.path.join(folder, "core.vtp"))
        label = report["labels"][0]
        require(label["certificate"]["passed"], "certificate")
        for value, pruned in zip(LAMBDAS, label["pruned"]):
            found = Core(os.path.join(folder, os.path.basename(pruned["output"])))
            found.points = found.points @ turn
            painted[value] = draw(found, value)
            middles = Middles(found)
            length = pruned["lambda_mm"]
            scale = np.sqrt(1 - (length / C) ** 2)
            row = [f"{value} %", n, float(length / step)]
            for factor, whole in ((1.0, True), (scale, False)):
                a, b = factor * semi[0], factor * semi[1]
                # The distance to a convex set is greatest at a corner, so corners say all.
                there = farthest_from_disc(found.points, a, b)
                back = distance_to_core(disc(a, b, 40 if options.small else 120), middles).max()
                row += [float(there), float(back)]
                distances[value, whole] = float(max(there, back))
            row += [float(max(row[5:7]) / step), "" if row[2] > 2.44 else "for comparison"]
            rows.append(row)
    return rows, distances, painted


def main():
    options = arguments(__doc__, "128,256,512,1024", "32,64")
    kept = Kept(options, "figure-9")
    turn = rotation()
    semi = (A * A - C * C) / A, (B * B - C * C) / B
    rows, curves = [], {}
    pictures, panels = plt.subplots(len(LAMBDAS), len(options.resolutions), squeeze=False,
                                    figsize=(2.0 * len(options.resolutions), 1.5 * len(LAMBDAS)))
    for column, n in enumerate(options.resolutions):
        of_size, distances, painted = kept.get(n, lambda: measure(options, n, turn, semi))
        rows += of_size
        for key, distance in distances.items():
            curves.setdefault(key, []).append(distance)
        for line, value in enumerate(LAMBDAS):
            frame(panels[line][column], painted[value], value, n, semi)
    rows.sort(key=lambda row: (float(row[0][:-2]), row[1]))
    write_table(
        options.output, "figure-9", [
            "lambda", "resolution", "lambda in voxels", "core to axis", "axis to core", "core to lambda-axis",
            "lambda-axis to core", "Hausdorff in voxels", "note"
        ], rows,
        "Distances are parts of the ellipsoid's longest axis. lambda at most 2.44 voxels is beyond the theorem.")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
    for panel, whole in zip(axes, (True, False)):
        for value in LAMBDAS:
            panel.loglog(options.resolutions, curves[value, whole], "o-", label=f"{value} %")
        panel.set_xlabel("resolution")
        panel.set_title("against the " + ("medial axis" if whole else "lambda-medial axis"))
        panel.set_xticks(options.resolutions, [str(n) for n in options.resolutions])
        panel.minorticks_off()
    axes[0].set_ylabel("Hausdorff distance")
    axes[1].legend(title="lambda")
    save(figure, options.output, "figure-9-distances")
    save(pictures, options.output, "figure-9")
    compared = 0
    for value in LAMBDAS:
        of_lambda = [row for row in rows if row[0] == f"{value} %"]
        above = [max(row[5:7]) for row in of_lambda if row[2] > 2.44]
        compared += max(0, len(above) - 1)
        require(all(b < a for a, b in zip(above, above[1:])), f"the distance falls with resolution at lambda {value} %")
        if value == 0:  # the whole core is not near the axis, but the axis is near the core
            near = [row[4] for row in of_lambda]
            require(all(b < a for a, b in zip(near, near[1:])), "the axis nears the whole core with resolution")
    require(compared > 0 or len(options.resolutions) < 2, "at least one lambda is above 2.44 voxels at two resolutions")


if __name__ == "__main__":
    main()
