"""Kills at random instants of core, skeleton, thickness, batch, --block and --join: nothing partial or wrong under a
final name, and what is done again ends with the bytes of an undisturbed run.

usage: kills.py VOXELCORE [--totals FILE] [--minutes M] [--first SEED]"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from campaign import Totals, checked, digests, run

COMMANDS = {
    "core": "core {i}/labels.nrrd -o {o}/d/ --lambda 0,1vox --keep-edges",
    "core-file": "core {i}/scan.nrrd -o {o}/a.vtp --with-skeleton --table {o}/a.csv",
    "skeleton": "skeleton {i}/scan.nrrd -o {o}/s.vtp --also csv,swc,mrk.json,graphml,ma",
    "batch": "batch {i}/cases -o {o}/b --jobs 2",
    "refined": "core {i}/labels.nrrd -o {o}/r/ --with-skeleton",
    "thickness": "thickness {i}/scan.nrrd -o {o}/t.nii.gz --table {o}/t.csv",
    "block": "core {i}/scan.nrrd --blocks 2 --block 1 -o {o}/parts/",
    "join": "core {i}/scan.nrrd --join {i}/parts -o {o}/j.vtp",
}


def inputs(program, folder):
    def make(*arguments):
        checked([program, *arguments, "-q"])

    path = lambda name: os.path.join(folder, name)
    make("phantom", "root", "--size", "48", "-o", path("scan.nrrd"))
    make("phantom", "root", "--size", "48", "-o", path("labels.nrrd"))
    os.mkdir(path("cases"))
    for name, kind, size in (("a", "torus", "24"), ("b", "ellipsoid", "20"), ("c", "root", "32"),
                             ("d", "gyroid", "16")):
        make("phantom", kind, "--size", size, "-o", path(f"cases/{name}.nrrd"))
    for block in ("1", "2"):
        make("core", path("scan.nrrd"), "--blocks", "2", "--block", block, "-o", path("parts/"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1)
    parser.add_argument("--first", type=int, default=1)
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    totals = Totals(options.totals, "kills")
    before = len(totals.of["found"])
    until = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory(prefix="voxelcore-kills-") as folder:
        i, o = os.path.join(folder, "in"), os.path.join(folder, "out")
        os.mkdir(i)
        inputs(program, i)

        def words(name):
            return [program, *(word.format(i=i, o=o) for word in COMMANDS[name].split()), "--progress", "none"]

        expected, length = {}, {}
        for name in COMMANDS:
            results = []
            for _ in range(2):
                shutil.rmtree(o, ignore_errors=True)
                os.mkdir(o)
                code, _, said, seconds = run(words(name), limit=300)
                if code != 0:
                    raise SystemExit(f"{name}: exit {code}: {said}")
                results.append(digests(o))
            length[name] = seconds
            # Reports and records hold times; of these only that they are there.
            expected[name] = {key: value if results[1][key] == value else None for key, value in results[0].items()}

        seed = max(options.first, totals.place("seed"))
        while time.monotonic() < until:
            name = list(COMMANDS)[seed % len(COMMANDS)]
            draw = random.Random(seed)
            shutil.rmtree(o, ignore_errors=True)
            os.mkdir(o)
            hits = 0
            for _ in range(draw.choice((1, 1, 2, 3))):
                process = subprocess.Popen(words(name), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                           stdin=subprocess.DEVNULL)
                time.sleep(draw.random() * length[name])
                process.send_signal(signal.SIGKILL)
                hits += process.wait() == -signal.SIGKILL
                if name == "batch":
                    time.sleep(0.3)  # its cases end by themselves: they are told when their parent dies
                for key, value in digests(o).items():
                    if ".part-" in key or key.endswith((".lock", ".jsonl")) or expected[name].get(key, 0) is None:
                        continue
                    if expected[name].get(key) != value:
                        totals.found(f"seed {seed}, {name}: {key} is partial or wrong after a kill")
                if process.returncode == 0:
                    break
            totals.count(f"{name}, killed", hits)
            again = words(name) + (["--force"] if name in ("core-file", "skeleton", "thickness", "join") else [])
            code, _, said, _ = run(again, limit=300)
            left = digests(o)
            wrong = [key for key, value in expected[name].items() if key not in left or value and left[key] != value]
            parts = [key for key in left if ".part-" in key]
            if code != 0 or wrong or parts:
                totals.found(f"seed {seed}, {name}: after a run again: exit {code}, {wrong} differ, {parts} left: "
                             f"{said}"[:500])
            totals.ran(hits)
            seed += 1
            totals.place("seed", seed)
            totals.save()
    totals.save()
    print(totals.of["runs"], "kills,", len(totals.of["found"]), "found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
