#!/usr/bin/env python3
"""Stenoses, bulges and domes told by `voxelcore skeleton --sections`, on bodies drawn afresh in random directions.
usage: PYTHONPATH=BUILD/python lesions.py PROGRAM [BODIES [SEED]]   (python3-numpy)
Straight tubes as in stenoses.py: radii of 1.5 to 4 mm become 30 to 90 % less, or 30 to 150 % more, in the shape of a
Gaussian of standard deviation 1 to 5 mm; even ones have no lesion. Domes are balls of radius 2.8 to 3.6 mm at the side
of tubes of 1.6 to 2 mm, with their middle .6 to .85 radii off the tube's side, in voxels of .4 mm. Prints the seed and,
per size of voxels, how far degrees by diameter are off, in points of a hundred, and how many bodies have not just the
one lesion that they should have; of domes how far the neck and the height are off, in mm. Masks that give more than
one branch of a tube are counted, not measured."""
import csv
import pathlib
import secrets
import subprocess
import sys
import tempfile

import numpy as np

from stenoses import VOXELS, tube


def write(path, mask, spacing):
    """As NRRD, x fastest."""
    head = ["NRRD0004", "type: uint8", "dimension: 3", "space: left-posterior-superior",
            "sizes: {} {} {}".format(*mask.shape), "space directions: ({},0,0) (0,{},0) (0,0,{})".format(*spacing),
            "space origin: (0,0,0)", "encoding: raw", "", ""]
    path.write_bytes("\n".join(head).encode() + mask.astype(np.uint8).tobytes(order="F"))


def lesions(program, mask, spacing):
    """Rows of the table, and the number of branches."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write(folder / "scan.nrrd", mask, spacing)
        subprocess.run([program, "skeleton", folder / "scan.nrrd", "--sections", "2vox", "--also", "csv", "--quiet",
                        "-o", folder / "s.vtp"], check=True, capture_output=True)
        with open(folder / "s_lesions.csv", newline="") as table, open(folder / "s_branches.csv", newline="") as all_of:
            return list(csv.DictReader(table)), len(list(csv.DictReader(all_of)))


def dome(random, radius, ball, away):
    axis, side = np.linalg.qr(random.normal(size=(3, 2)))[0].T
    half = 22.0
    count = int(2 * half / 0.4)
    middle = count * 0.4 / 2 + random.uniform(-0.2, 0.2, 3) - side * away / 2
    places = np.stack(np.meshgrid(*[(np.arange(count) + 0.5) * 0.4] * 3, indexing="ij"), -1) - middle
    along = places @ axis
    across = (places * places).sum(-1) - along * along
    from_middle = ((places - side * away)**2).sum(-1)
    return ((across < radius**2) & (np.abs(along) < 18)) | (from_middle < ball**2)


def summary(errors):
    errors = np.array(errors)
    return f"{np.abs(errors).mean():6.2f} {np.abs(errors).max():6.2f} {errors.mean():6.2f}" if len(errors) else "none"


def main():
    program = sys.argv[1]
    bodies = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else secrets.randbelow(10**6)
    random = np.random.default_rng(seed)
    print(f"seed {seed}, {bodies} bodies of each kind; mean absolute error, greatest, bias")
    for spacing in VOXELS:
        for kind in ("stenosis", "bulge", "even"):
            errors, other, parted = [], 0, 0
            for _ in range(bodies):
                radius = random.uniform(1.5, 4)
                depth = {"stenosis": random.uniform(0.3, 0.9), "bulge": -random.uniform(0.3, 1.5), "even": 0}[kind]
                width = random.uniform(1, 5)
                mask = tube(random, spacing, lambda s: radius * (1 - depth * np.exp(-s * s / (2 * width * width))),
                            max(12 * width, 30), radius * (1 - min(depth, 0)))
                rows, branches = lesions(program, mask, spacing)
                if branches != 1:
                    parted += 1
                elif [row["kind"] for row in rows] != ([] if kind == "even" else [kind]):
                    other += 1
                elif rows:
                    errors.append(float(rows[0]["degree_by_diameter"]) - 100 * abs(depth))
            print(f"{spacing} {kind:8} {summary(errors)}   ({other} with other lesions, {parted} of several branches)",
                  flush=True)
    necks, heights, other = [], [], 0
    for _ in range(bodies):
        radius, ball = random.uniform(1.6, 2), random.uniform(2.8, 3.6)
        below = random.uniform(0.6, 0.85) * ball
        rows, _ = lesions(program, dome(random, radius, ball, radius + below), (0.4, 0.4, 0.4))
        if [row["kind"] for row in rows] != ["dome"]:
            other += 1
            continue
        necks.append(float(rows[0]["neck_width"]) - 2 * np.sqrt(ball * ball - below * below))
        heights.append(float(rows[0]["dome_height"]) - ball - below)
    print(f"domes: neck {summary(necks)}, height {summary(heights)}   ({other} with other lesions)")


if __name__ == "__main__":
    main()
