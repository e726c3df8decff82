#!/usr/bin/env python3
"""Whether the warning of hollow bodies comes where it should, and nowhere else: one table.

usage: hollow_warning.py PROGRAM [--seeds 1,2] [--folder FOLDER]

Grey roots whose stem and laterals are tubes, with closed walls and with holes in them, of three voxel sizes, cubic
and twice as high, with noise: hollow where the lumens come to a tenth of what is left, as voxels tell which are in
the solid root only, without noise. Not hollow: the same roots solid; vessels whose blood has a label of its own,
and the blood alone; trabecular bone (smooth noise above a threshold, of three densities); gyroids; rings, nets and
shells of neighbours. With VOXELCORE_TEST_DATA: scans of vessels, bones and organs, of which no answer is known;
what is said of them is listed. Exit 1 if a warning is missing or false.
"""
import argparse
import math
import os
import subprocess
import sys
import tempfile
import zlib

import numpy


def write_nrrd(path, voxels, spacing, kind="uint8"):
    """Voxels are a NumPy array in the order z, y, x."""
    sizes = " ".join(str(n) for n in reversed(voxels.shape))
    ways = " ".join(f"({','.join(repr(float(s)) if a == b else '0' for b in range(3))})" for a, s in enumerate(spacing))
    header = (f"NRRD0004\ntype: {kind}\nendian: little\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes}\n"
              f"space directions: {ways}\nkinds: domain domain domain\nencoding: raw\n\n")
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(voxels.astype(numpy.dtype(kind).newbyteorder("<")).tobytes())


def grid(size):
    z, y, x = numpy.indices(tuple(reversed(size)), dtype=numpy.float32)
    return x, y, z


def read_values(path):
    """A .nrrd of VoxelCore's own, in the order z, y, x."""
    with open(path, "rb") as file:
        header, data = file.read().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in header.decode().splitlines() if ": " in line)
    if fields["encoding"] != "raw":
        data = zlib.decompress(data, 31)
    sizes = [int(n) for n in fields["sizes"].split()]
    kind = {"float": "<f4", "float32": "<f4", "uint8": "u1", "unsigned char": "u1", "uint16": "<u2",
            "unsigned short": "<u2", "ushort": "<u2"}[fields["type"]]
    return numpy.frombuffer(data, kind).reshape(sizes[::-1])


def read_mask(path, level):
    return read_values(path) >= level


def vessel(random, size=96):
    """A bent vessel with a branch: distance from its line over its radius, in voxels."""
    x, y, z = grid((size, size, size))
    phase, bend = random.uniform(0, 6), random.uniform(6, 14)
    radius = random.uniform(7, 10)
    away = numpy.hypot(x - size / 2 - bend * numpy.sin(z / 20 + phase), y - size / 2 - bend * numpy.cos(z / 25 + phase))
    line = numpy.minimum(numpy.maximum(x - size / 2, 0), size)
    branch = numpy.sqrt((x - size / 2 - line) ** 2 + (y - size / 2) ** 2 + (z - size / 2 - line / 2) ** 2)
    return numpy.minimum(away / radius, branch / (0.7 * radius)), radius


def labelled_vessel(random, both):
    away, radius = vessel(random)
    wall = (away < 1) & (away >= 1 - 3 / radius)
    lumen = away < 1 - 3 / radius
    return wall.astype(numpy.uint8) + 2 * lumen if both else lumen.astype(numpy.uint8)


def net(random):
    """Rods of a cubic net, as in bone, with rings between them."""
    x, y, z = grid((80, 80, 80))
    period = random.uniform(14, 20)
    fold = [numpy.abs((a + random.uniform(0, period)) % period - period / 2) for a in (x, y, z)]
    thick = period * 0.18
    return ((numpy.hypot(fold[0], fold[1]) < thick) | (numpy.hypot(fold[1], fold[2]) < thick) |
            (numpy.hypot(fold[0], fold[2]) < thick)).astype(numpy.uint8)


def rings(random):
    x, y, z = grid((80, 80, 40))
    away = numpy.hypot(x - 40, y - 40) - random.uniform(18, 26)
    return (numpy.hypot(away, z - 20) < random.uniform(5, 9)).astype(numpy.uint8)


def tubes_apart(random):
    """Solid rods side by side, nearly touching, so that the gaps between them are narrow and long."""
    x, y, z = grid((70, 70, 80))
    radius = random.uniform(7, 9)
    pitch = 2 * radius + 2
    row = numpy.round(y / (pitch * math.sqrt(0.75)))
    shift = (row % 2) * pitch / 2
    dx = (x - shift) - pitch * numpy.round((x - shift) / pitch)
    dy = y - row * pitch * math.sqrt(0.75)
    return (numpy.hypot(dx, dy) < radius).astype(numpy.uint8)


class Table:
    def __init__(self, program, folder):
        self.program, self.folder, self.wrong = program, folder, 0

    def phantom(self, name, *arguments):
        path = os.path.join(self.folder, name)
        subprocess.run([self.program, "phantom", *arguments, "-q", "--force", "-o", path], check=True)
        return path

    def warned(self, scan, *arguments):
        """The body's hollow parts as told by `info`'s sister commands; None if nothing is said."""
        result = subprocess.run(
            [self.program, "core", scan, *arguments, "--lambda", "5vox", "--refine", "off", "--force", "-o",
             os.path.join(self.folder, "out.vtp")],
            capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"{scan}: {result.stderr}")
        return [line for line in (result.stdout + result.stderr).splitlines() if "looks hollow" in line]

    def row(self, name, expected, scans):
        """scans: (path, arguments); `expected` one answer for all or one for each, None where none is known."""
        told = [bool(self.warned(*scan)) for scan in scans]
        right = expected if isinstance(expected, list) else [expected] * len(scans)
        fails = sum(one != other for one, other in zip(told, right) if other is not None)
        self.wrong += fails
        wanted = "-" if None in right else sum(right)
        print(f"| {name} | {len(told)} | {wanted} | {sum(told)} | {fails} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", default="1,2")
    parser.add_argument("--folder")
    options = parser.parse_args()
    seeds = [int(seed) for seed in options.seeds.split(",")]
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        table = Table(os.path.realpath(options.program), folder)
        print("| bodies | number | hollow | warned of | wrong |\n| --- | --- | --- | --- | --- |")
        grey = ("--threshold", "20000:inf")

        def root(seed, voxel, slices, hollow, holes, noise=0.08):
            side = int(120 / voxel)
            name = f"root-{seed}-{voxel}-{slices}-{hollow}-{holes}-{noise}.nrrd"
            more = ("--hollow", str(hollow), "--holes", str(holes)) if hollow else ()
            return (table.phantom(name, "root", "--size", f"{side},{side},{int(side / slices)}", "--spacing",
                                  f"{voxel},{voxel},{slices * voxel}", "--seed", str(seed), "--radius", "10",
                                  "--detail", "1.1", "--laterals", "10", "--sub-laterals", "2", "--contacts", "2",
                                  "--grey-values", "--noise-level", str(noise), "--rings", str(noise / 3),
                                  *more), *grey)

        def is_hollow(*which):
            solid = read_mask(root(*which, 0, 0, 0)[0], 20000)
            return lambda hollow: lumens(solid, read_mask(root(*which, hollow, 0, 0)[0], 20000)) >= 0.1

        def lumens(solid, hollow):
            return (solid & ~hollow).sum() / hollow.sum()

        for slices in (1, 2):
            for voxel in (1, 0.75, 0.5):
                size = f"{voxel:g} mm, 1:1:{slices}"
                scans, expected = [], []
                for seed in seeds:
                    truth = is_hollow(seed, voxel, slices)
                    for hollow in (0.5, 0.65, 0.8):
                        for holes in (0, 8):
                            scans.append(root(seed, voxel, slices, hollow, holes))
                            expected.append(bool(truth(hollow)))
                table.row(f"roots with lumens, {size}", expected, scans)
                table.row(f"solid roots, {size}", False, [root(seed, voxel, slices, 0, 0) for seed in seeds])

        def made(name, make, spacing=(1, 1, 1)):
            scans = []
            for seed in seeds:
                for turn in range(3):
                    path = os.path.join(folder, f"{name}-{seed}-{turn}.nrrd")
                    write_nrrd(path, make(numpy.random.default_rng([seed, turn])), spacing)
                    scans.append((path,))
            return scans

        table.row("vessels, wall and blood labelled", False, made("both", lambda r: labelled_vessel(r, True)))
        table.row("vessels, blood alone", False, made("blood", lambda r: labelled_vessel(r, False)))
        table.row("vessels, wall alone", True, made("wall", lambda r: labelled_vessel(r, True) == 1))
        table.row("nets of rods", False, made("net", net))
        table.row("rings", False, made("rings", rings))
        table.row("rods side by side", False, made("rods", tubes_apart))
        for density in (0.2, 0.3, 0.45):
            table.row(f"trabecular bone, {100 * density:.0f} % of the volume", False,
                      [(table.phantom(f"porous-{density}-{seed}-{period}.nrrd", "porous", "--size", "96", "--density",
                                      str(density), "--period", str(period), "--seed", str(seed)),)
                       for seed in seeds for period in (8, 12, 16)])
        table.row("gyroids", False,
                  [(table.phantom(f"gyroid-{period}.nrrd", "gyroid", "--size", "96", "--period", str(period)),)
                   for period in (20, 32, 48)])
        data = os.environ.get("VOXELCORE_TEST_DATA")
        for name in ("wasserth+TotalSegmentator/aorta.nii.gz", "wasserth+TotalSegmentator/T710_renal.nii.gz",
                     "CIBC-Internal+Seg3DData/Skull.nrrd", "mhalle+spl-abdominal-atlas/seg.nrrd"):
            if data and os.path.exists(os.path.join(data, name)):
                table.row(name.split("/")[1], None, [(os.path.join(data, name),)])
    return 1 if table.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
