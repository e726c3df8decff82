#!/usr/bin/env python3
"""Counts of sheets, seams and junctions where they are known, at random turns, at twice the resolution, and with noise.
usage: sheets.py PROGRAM [TURNS [SEED [FOAMS [BODY ...]]]]   (python3-numpy)
Per body and variant: of how many turns the counts are as known, and those of the others. Foams are another one at each
turn."""
import collections
import json
import subprocess
import sys
import tempfile

import numpy as np

from bodies import places, random_turn, write_nrrd
from sheet_bodies import BODIES, foam

VARIANTS = ((1, 0, []), (2, 0, []), (1, 0.5, ["--denoise"]))  # resolution, noise in voxels, options
FOAM = "random foams"


def samples(kind, variant, turns, seed):
    """(mask, known counts) at random turns; walls are 5 voxels thick, 10 at twice the resolution."""
    scale, noise, _ = VARIANTS[variant]
    half, side = (34, 80) if kind == FOAM else (27, 64)
    random = np.random.default_rng([seed, len(kind), variant])
    for _ in range(turns if scale == 1 else max(1, turns // 4)):
        distance, known = foam(random, half) if kind == FOAM else BODIES[kind]
        p = places([side * scale] * 3, (1 / scale,) * 3, random.random(3) - 0.5, random_turn(random))
        field = distance(p, half)
        yield (field + noise * random.standard_normal(field.shape) if noise else field) < 2.5, known


def counts(program, mask, folder, more):
    write_nrrd(f"{folder}/a.nrrd", mask, (1, 1, 1))
    subprocess.run([program, "sheets", f"{folder}/a.nrrd", "-o", f"{folder}/s.vtp", "--report", f"{folder}/r.json",
                    "--force", "-q", *more], check=True)
    with open(f"{folder}/r.json") as file:
        record = json.load(file)["sheets"][0]
    return tuple(record[name] for name in ("sheets", "seams", "junctions", "rods"))


def main(program, turns=24, seed=1, foams=20, *kinds):
    turns, seed, foams = int(turns), int(seed), int(foams)
    print(f"seed {seed}, {turns} turns, {foams} foams; walls 5 voxels thick; sheets, seams, junctions, rods")
    print("| body | known | as they are | twice the resolution | noise of half a voxel |")
    print("| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for kind in kinds or [*BODIES, FOAM]:
            cells = []
            for variant, (_, _, more) in enumerate(VARIANTS):
                good = 0
                wrong = collections.Counter()
                for mask, known in samples(kind, variant, foams if kind == FOAM else turns, seed):
                    found = counts(program, mask, folder, more)
                    good += found == known
                    wrong[(f"{known}: " if kind == FOAM else "") + str(found)] += found != known
                rest = ", ".join(f"{n} x {key}" for key, n in wrong.most_common(4) if n)
                cells.append(f"{good} of {good + sum(wrong.values())}" + (f"; {rest}" if rest else ""))
            print(f"| {kind} | {'' if kind == FOAM else BODIES[kind][1]} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
