#!/usr/bin/env python3
"""How every command's time and memory grow with shapes of many small parts: dust, a checkerboard, needles.

usage: scattered_shapes.py VOXELCORE [--few 100000] [--many 1000000] [--limit SECONDS] [--only COMMAND,...]

Each shape is made with about FEW and about MANY voxels, and each command runs on both, on one thread. The table has
the processor's seconds, the peak memory in MB, and the ratio of the times over that of the voxels: 1 is linear. What
takes less than a tenth of a second is not compared, as loading libraries takes as long. A ratio above 1.6 is marked.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy

SLOW = 1.6  # an n log n over ten times as much is 1.2; caches that no longer hold the data do the rest


def dust(voxels):
    """Single voxels, each with its own boundary."""
    side = round(voxels ** (1 / 3))
    array = numpy.zeros((2 * side,) * 3, numpy.uint8)
    array[::2, ::2, ::2] = 1
    return array


def checkerboard(voxels):
    """Voxels that meet in edges only: as many components and the most boundary there is."""
    side = round((2 * voxels) ** (1 / 3))
    return (numpy.indices((side,) * 3).sum(0) % 2 == 0).astype(numpy.uint8)


def needles(voxels):
    """Rods of one voxel's width, 100 long."""
    side = round((voxels / 100) ** 0.5)
    array = numpy.zeros((2 * side, 2 * side, 100), numpy.uint8)
    array[::2, ::2, :] = 1
    return array


def write(path, array):
    sizes = " ".join(map(str, array.shape))
    header = (
        f"NRRD0005\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes}\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n\n"
    )
    path.write_bytes(header.encode() + array.tobytes(order="F"))


def commands(folder, scan):
    """By name, in an order in which each finds what it needs."""
    at = lambda name: str(folder / name)  # noqa: E731
    return {
        "info": ["info", scan],
        "core": ["core", scan, "-o", at("core.vtp")],
        "core --lambda 0": ["core", scan, "--lambda", "0", "--keep-edges", "-o", at("whole.vtp")],
        "skeleton": ["skeleton", scan, "-o", at("skeleton.vtp"), "--also", "csv"],
        "skeleton CORE": ["skeleton", at("whole.vtp"), "-o", at("again.vtp")],
        "thickness": ["thickness", scan, "-o", at("map.nrrd"), "--table", at("map.csv")],
        "sheets": ["sheets", scan, "-o", at("sheets.vtp"), "--table", at("sheets.csv"), "--voxels", at("owners.nrrd")],
        "sheets CORE": ["sheets", at("whole.vtp"), "-o", at("cut.vtp")],
        "roots": ["roots", scan, "-o", at("roots") + "/", "--no-pictures"],
        "verify": ["verify", scan, at("core.vtp")],
        "prune": ["prune", at("whole.vtp"), "--lambda", "1.5vox", "-o", at("pruned.vtp")],
        "measure": ["measure", at("skeleton.vtp"), "-o", at("measured.csv")],
        "reconstruct": ["reconstruct", at("core.vtp"), "-o", at("rebuilt.nrrd")],
        "render": ["render", at("core.vtp"), "-o", at("picture.png")],
        "core --split": ["core", scan, "--split-components", "-o", at("split.vtp")],
        "batch": ["batch", scan, "-o", at("batch"), "--jobs", "1"],
    }


def run(program, words, limit):
    """Seconds of the processor, MB, and what was said where it failed."""
    if words[0] not in ("info", "verify"):
        words = [*words, "--force"]
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen([program, *words], stdout=subprocess.DEVNULL, stderr=said)
        end = time.monotonic() + limit
        done, status, used = os.wait4(child.pid, os.WNOHANG)
        while done == 0 and time.monotonic() < end:
            time.sleep(0.02)
            done, status, used = os.wait4(child.pid, os.WNOHANG)
        if done == 0:
            child.kill()
            os.wait4(child.pid, 0)
            return None, None, f"over {limit:.0f} s"
        said.seek(0)
        lines = said.read().strip().splitlines()
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, "" if status == 0 else lines[-1][:100]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--few", type=int, default=100_000)
    parser.add_argument("--many", type=int, default=1_000_000)
    parser.add_argument("--limit", type=float, default=600)
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    print("| shape | command | few: s | many: s | many: MB | ratio |\n| --- | --- | --- | --- | --- | --- |")
    slow = 0
    for make in (dust, checkerboard, needles):
        found = {}
        voxels = []
        for count in (given.few, given.many):
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                scan = folder / "scan.nrrd"
                array = make(count)
                voxels.append(int(array.sum()))
                write(scan, array)
                del array
                for command, words in commands(folder, str(scan)).items():
                    if not given.only or command in given.only.split(","):
                        found.setdefault(command, []).append(run(given.program, words, given.limit))
        for command, ((few, _, trouble), (many, memory, more)) in found.items():
            ratio = ""
            if few is not None and many is not None and many > 0.1:
                grown = many / max(few, 0.1) / (voxels[1] / voxels[0])
                ratio = f"{grown:.2f}" + (" !" if grown > SLOW else "")
                slow += grown > SLOW
            text = [f"{x:.2f}" if x is not None else "-" for x in (few, many)]
            print(f"| {make.__name__} | {command} | {text[0]} | {text[1]} | "
                  f"{'-' if memory is None else round(memory)} | {ratio or more or trouble} |", flush=True)
    print(f"\n{slow} of them grow faster than they should" if slow else "\nall grow as they should")
    return 1 if slow else 0


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(main())
