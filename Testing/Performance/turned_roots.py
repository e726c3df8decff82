#!/usr/bin/env python3
"""The same plant, turned, mirrored and padded: whether `roots` finds the same tree, with roots that touch. One table.

usage: turned_roots.py PROGRAM [--seeds 1,2,3] [--contacts 0,5] [--all] [--folder FOLDER]

Grey phantoms, hollow and with noise. Each is given as it is, then padded by 7 voxels of air, mirrored along each
axis, and turned: by 4 of the 23 further rotations of the grid, or with --all by all of them. The same are: numbers
of roots of each level, and who is whose parent (tips within two voxels of each other and of their parents' tips).
Length may differ by half a percent. Exit 1 if a plant differs.
"""
import argparse
import csv
import itertools
import math
import os
import subprocess
import sys
import tempfile

import numpy

from hollow_warning import read_values, write_nrrd


def rotations():
    """Axis orders with signs, of determinant 1; the first is none."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            matrix = numpy.zeros((3, 3))
            for row, (axis, sign) in enumerate(zip(order, signs)):
                matrix[row][axis] = sign
            if round(numpy.linalg.det(matrix)) == 1:
                yield order, signs


def moved(values, order, signs, border=0):
    """Values in the order z, y, x; order and signs are those of x, y, z."""
    turned = values.transpose([2 - order[2], 2 - order[1], 2 - order[0]])
    turned = turned[tuple(slice(None, None, sign) for sign in reversed(signs))]
    return numpy.pad(turned, border, constant_values=10000)


def back(place, order, signs, size, border):
    """Where a place lay before, in voxels; size is that of the turned volume without its border."""
    result = [0.0, 0.0, 0.0]
    for row, (axis, sign) in enumerate(zip(order, signs)):
        at = place[row] - border
        result[axis] = at if sign > 0 else size[row] - 1 - at
    return tuple(result)


def plant(program, folder, values, order, signs, border):
    scan, out = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "out/")
    given = moved(values, order, signs, border)
    write_nrrd(scan, given, (1, 1, 1), "uint16")
    subprocess.run([program, "roots", scan, "--threshold", "20000:inf", "--no-pictures", "-q", "--force", "-o", out],
                   check=True, stderr=subprocess.DEVNULL)
    size = [n - 2 * border for n in reversed(given.shape)]
    with open(os.path.join(out, "roots.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    return [(int(row["level"]), int(row["parent"]) if row["parent"] else None, float(row["length"]),
             back([float(row["tip_" + axis]) for axis in "xyz"], order, signs, size, border)) for row in rows]


def same(one, other):
    """How many roots of one have a like root in the other: the same level, tip, and parent's tip."""
    found = 0
    for level, parent, _, tip in one:
        found += any(level == l and math.dist(tip, t) <= 2 and (parent is None) == (p is None) and
                     (parent is None or math.dist(one[parent][3], other[p][3]) <= 2) for l, p, _, t in other)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--contacts", default="0,5")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--folder")
    options = parser.parse_args()
    program, wrong = os.path.realpath(options.program), 0
    turns = list(rotations())[1:]
    ways = [("padded", (0, 1, 2), (1, 1, 1), 7)]
    ways += [(f"mirrored along {'xyz'[axis]}", (0, 1, 2), tuple(-1 if a == axis else 1 for a in range(3)), 0)
             for axis in range(3)]
    ways += [("turned", *turn, 0) for turn in (turns if options.all else turns[3::5])]
    print("| seed, contacts | roots | ways | with every root the same | roots that differ, worst | length off, "
          "worst |\n"
          "| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        for contacts in options.contacts.split(","):
            for seed in options.seeds.split(","):
                path = os.path.join(folder, "phantom.nrrd")
                subprocess.run([program, "phantom", "root", "--size", "112", "--seed", seed, "--radius", "6",
                                "--laterals", "8", "--sub-laterals", "1", "--detail", "1.4", "--contacts", contacts,
                                "--grey-values", "--hollow", "0.6", "--holes", "4", "--noise-level", "0.05", "-q",
                                "--force", "-o", path], check=True)
                values = read_values(path)
                plain = plant(program, folder, values, (0, 1, 2), (1, 1, 1), 0)
                length = sum(root[2] for root in plain)
                equal, most, off = 0, 0, 0.0
                for name, order, signs, border in ways:
                    other = plant(program, folder, values, order, signs, border)
                    differ = max(len(plain) - same(plain, other), len(other) - same(other, plain))
                    equal += differ == 0
                    most = max(most, differ)
                    off = max(off, abs(sum(root[2] for root in other) / length - 1))
                    if differ and os.environ.get("VERBOSE"):
                        print(seed, contacts, name, order, signs, differ, len(plain), len(other), file=sys.stderr)
                wrong += equal < len(ways) or off > 0.005
                print(f"| {seed}, {contacts} | {len(plain)} | {len(ways)} | {equal} | {most} | {100 * off:.2f} % |",
                      flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
