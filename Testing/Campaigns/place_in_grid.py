#!/usr/bin/env python3
"""Holds what the program says of a body against what it says of the same body elsewhere in the grid.
usage: place_in_grid.py PROGRAM [BODIES [SEED]]   (python3-numpy)
Random bodies (rough tubes that branch, and lumps) are written cropped tight, with room around them, and moved far
into a greater volume, with the origin such that they lie at the same place in mm; spacings have short binary fractions,
so that these places are the same numbers. Each command runs with its default options; but where a crop leaves no room,
skeletons are told that the border cuts nothing (--border closed), which nobody could tell from the scan. Of models,
tables and maps what is about the body must be the same bytes. Prints the seed and a table; exit 1: something
differs."""
import pathlib
import re
import secrets
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Performance" / "Thickness"))
from bodies import read_nrrd  # noqa: E402

PROGRAM = sys.argv[1]
BODIES = int(sys.argv[2]) if len(sys.argv) > 2 else 200
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else secrets.randbelow(10**6)
SPACINGS = [(1, 1, 1), (0.5, 0.5, 1.25), (1, 1, 2)]
COMMANDS = {
    "core": ["core", "SCAN", "-o", "OUT/core.obj"],
    "skeleton": ["skeleton", "SCAN", "-o", "OUT/s.vtp", "--also", "csv,swc"],
    "thickness": ["thickness", "SCAN", "-o", "OUT/t.nrrd", "--table", "OUT/t.csv"],
    "sheets": ["sheets", "SCAN", "-o", "OUT/s.vtp", "--table", "OUT/s.csv", "--voxels", "OUT/v.nrrd"],
    "roots": ["roots", "SCAN", "-o", "OUT/r", "--no-pictures"],
}
GOES_ON = ["skeleton", "roots"]  # up to the scan's border


def random_body(random):
    """[z, y, x], tight: what is below a noisy distance to a few lines."""
    size = random.integers(16, 30, 3)
    z, y, x = np.meshgrid(*(np.arange(n) + 0.5 for n in size), indexing="ij")
    at = np.stack([z, y, x], -1)
    nodes = random.uniform(0.2, 0.8, (random.integers(3, 6), 3)) * size
    distance = np.full(at.shape[:3], np.inf)
    for i in range(1, len(nodes)):
        a, b = nodes[random.integers(0, i)], nodes[i]
        along = np.clip(((at - a) @ (b - a)) / max((b - a) @ (b - a), 1e-9), 0, 1)
        away = np.linalg.norm(at - a - along[..., None] * (b - a), axis=-1)
        distance = np.minimum(distance, away - random.uniform(1.2, 4))
    mask = distance + random.uniform(0, 0.4) * random.standard_normal(distance.shape) < 0
    where = np.argwhere(mask)
    return mask[tuple(slice(a, b + 1) for a, b in zip(where.min(0), where.max(0)))]


def write(path, body, before, after, spacing):
    """Before and after: voxels of background, z, y, x. The body's first voxel lies at 0 mm."""
    volume = np.pad(body.astype(np.uint8), list(zip(before, after)))
    origin = [-before[2 - k] * spacing[k] for k in range(3)]
    ways = " ".join("(" + ",".join(str(spacing[k] if k == m else 0) for m in range(3)) + ")" for k in range(3))
    header = ("NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
              f"sizes: {volume.shape[2]} {volume.shape[1]} {volume.shape[0]}\nspace directions: {ways}\n"
              f"encoding: raw\nspace origin: ({','.join(str(x) for x in origin)})\n\n")
    path.write_bytes(header.encode() + volume.tobytes())


def about_the_body(folder, before, size):
    """What was written, but for what says where it came from."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.suffix == ".nrrd":
            values = read_nrrd(path)
            found[name] = values[tuple(slice(b, b + n) for b, n in zip(before, size))].tobytes()
        elif name == "t.csv" and min(before) == 0:
            continue  # it counts what touches the scan's border
        elif path.suffix in (".obj", ".csv", ".swc"):
            found[name] = re.sub(rb"(?m)^#.*\n", b"", path.read_bytes())
    return found


def main():
    print(f"seed {SEED}, {BODIES} bodies, each in four places")
    differing, refused = dict.fromkeys(COMMANDS, 0), dict.fromkeys(COMMANDS, 0)
    for number in range(BODIES):
        random = np.random.default_rng([SEED, number])
        body, spacing = random_body(random), SPACINGS[number % len(SPACINGS)]
        places = [((1, 1, 1), (1, 1, 1)), ((0, 0, 0), (0, 0, 0)), (random.integers(1, 9, 3), random.integers(1, 9, 3)),
                  (random.integers(20, 90, 3), random.integers(1, 20, 3))]
        for command, words in COMMANDS.items():
            results = []
            for before, after in places:
                with tempfile.TemporaryDirectory() as place:
                    scan, out = pathlib.Path(place) / "scan.nrrd", pathlib.Path(place) / "out"
                    out.mkdir()
                    write(scan, body, before, after, spacing)
                    run = [word.replace("SCAN", str(scan)).replace("OUT", str(out)) for word in words]
                    if command in GOES_ON and min(before) == 0:
                        run += ["--border", "closed"]
                    done = subprocess.run([PROGRAM, *run, "-q"], capture_output=True, text=True)
                    results.append((done.returncode, about_the_body(out, before, body.shape)))
            refused[command] += results[0][0] != 0
            names = {(name, files[name] == results[0][1].get(name)) for _, files in results for name in files}
            files = {name for name, same in names if not same}
            if files or len({code for code, _ in results}) > 1:
                differing[command] += 1
                print(f"{command}, body {number}: {', '.join(sorted(files)) or 'exit code'}", flush=True)
    print("| command | bodies | refused | differ |\n| --- | --- | --- | --- |")
    for command in COMMANDS:
        print(f"| {command} | {BODIES} | {refused[command]} | {differing[command]} |")
    return 1 if any(differing.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
