"""Random volumes, against the definition, between both engines, through all that is certified, and through the program.

usage: random_volumes.py KIND --programs DIR [--totals FILE] [--minutes M] [--first SEED]

KIND: definition, engines, certified (VoxelCoreRandomVolumes), or program (core, tolerance, refine, skeleton, thickness
and verify as commands). Goes on where the totals say; a seed makes the same volume everywhere."""

import argparse
import os
import random
import sys
import tempfile
import time

from campaign import Totals, run

CHUNK = {"definition": 200, "engines": 200, "certified": 50}


def write_nrrd(path, seed):
    draw = random.Random(seed)
    most = 24 if seed % 8 == 0 else 10
    size = [min(most, 1 + int(draw.random() ** 2 * most)) for _ in range(3)]
    spacing = [1, 1, 1] if draw.random() < 0.5 else [draw.choice((1, 2, 3, 0.5, 0.7, 2.5)) for _ in range(3)]
    density = 0.05 + 0.9 * draw.random()
    voxels = bytes(1 if draw.random() < density else 0 for _ in range(size[0] * size[1] * size[2]))
    if not any(voxels):
        voxels = b"\1" + voxels[1:]
    with open(path, "wb") as file:
        file.write((f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {size[0]} {size[1]} {size[2]}\nspace: "
                    f"left-posterior-superior\nspace directions: ({spacing[0]},0,0) (0,{spacing[1]},0) "
                    f"(0,0,{spacing[2]})\nspace origin: (1,-2,3)\nencoding: raw\nkinds: domain domain domain\n\n")
                   .encode() + voxels)


def through_program(program, seed, folder, totals):
    scan = os.path.join(folder, "scan.nrrd")
    write_nrrd(scan, seed)
    core, exact = os.path.join(folder, "core.vtp"), os.path.join(folder, "exact.vtp")
    once = ["--progress", "none", "--force"]
    for step in (["core", scan, "-o", core, *once], ["verify", scan, core],
                 ["core", scan, "--lambda", "0", "--keep-edges", "-o", exact, *once], ["verify", scan, exact],
                 ["skeleton", scan, "-o", os.path.join(folder, "s.vtp"), *once],
                 ["thickness", scan, "-o", os.path.join(folder, "t.nrrd"), *once]):
        code, out, error, _ = run([program, *step], limit=120)
        if code != 0:
            totals.found(f"seed {seed}: {step[0]}: exit {code}: {error.strip() or out.strip()}"[:600])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind")
    parser.add_argument("--programs", required=True)
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1)
    parser.add_argument("--first", type=int, default=1)
    options = parser.parse_args()
    totals = Totals(options.totals, f"random volumes, {options.kind}")
    before = len(totals.of["found"])
    seed = max(options.first, totals.place("seed"))
    until = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory(prefix="voxelcore-random-") as folder:
        while time.monotonic() < until:
            if options.kind == "program":
                through_program(os.path.join(options.programs, "voxelcore"), seed, folder, totals)
                done = 1
            else:
                done = CHUNK[options.kind]
                code, out, error, _ = run([os.path.join(options.programs, "VoxelCoreRandomVolumes"), options.kind, seed,
                                           done], {"OMP_NUM_THREADS": "1"}, limit=3600)
                for line in out.splitlines():
                    if not line.startswith("ok "):
                        totals.found(line)
                if code not in (0, 1):
                    totals.found(f"seeds from {seed}: exit {code}: {error.strip()}"[:600])
            totals.ran(done)
            seed += done
            totals.place("seed", seed)
            totals.save()
    totals.save()
    print(totals.of["runs"], "volumes,", len(totals.of["found"]), "found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
