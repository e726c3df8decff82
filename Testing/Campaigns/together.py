"""Two batches at once in one folder, started a random time apart, in some of them with one killed at a random instant
and with a clock that jumps back and forth: every result as of one undisturbed batch, and nothing left over.

usage: together.py VOXELCORE LAYER.so [--totals FILE] [--minutes M] [--count N] [--first SEED]

LAYER.so is FaultLayer.c, built as a library. Exit 1: something was found."""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from campaign import Totals, digests, run
from kills import inputs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("layer")
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--count", type=int, default=10**9)
    parser.add_argument("--first", type=int, default=1)
    options = parser.parse_args()
    program, layer = os.path.abspath(options.program), os.path.abspath(options.layer)
    totals = Totals(options.totals, "two batches in one folder")
    before = len(totals.of["found"])
    until = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory(prefix="voxelcore-together-") as folder:
        i, o, counter = (os.path.join(folder, name) for name in ("in", "out", "counter"))
        os.mkdir(i)
        inputs(program, i)
        words = [program, "batch", f"{i}/cases", "-o", f"{o}/b", "--jobs", "2", "--progress", "none"]
        results, seconds = [], 0
        for _ in range(2):
            shutil.rmtree(o, ignore_errors=True)
            os.mkdir(o)
            code, _, said, seconds = run(words, limit=300)
            if code != 0:
                raise SystemExit(f"batch: exit {code}: {said}")
            results.append(digests(o))
        # Reports and records hold times; of these only that they are there.
        expected = {key: value if results[1].get(key) == value else None for key, value in results[0].items()}

        def off(name):
            return [key for key, value in expected.items() if key not in name or value and name[key] != value]

        seed = max(options.first, totals.place("seed"))
        for seed in range(seed, seed + options.count):
            if time.monotonic() > until:
                break
            draw = random.Random(seed)
            shutil.rmtree(o, ignore_errors=True)
            os.mkdir(o)
            both = []
            for number in (0, 1):
                with open(counter + str(number), "wb") as file:
                    file.write(bytes(16))
                jumps = {"LD_PRELOAD": layer, "FAULT_CALL": "clock", "FAULT_AT": str(draw.randrange(1, 40)),
                         "FAULT_ERROR": str(draw.choice((-1, 1)) * draw.choice((1, 3600, 10**8))),
                         "FAULT_COUNTER": counter + str(number)} if draw.random() < 0.5 else {}
                totals.count("with a clock that jumps", 1 if jumps else 0)
                both.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                             stdin=subprocess.DEVNULL, env={**os.environ, **jumps}))
                time.sleep(draw.random() * seconds * draw.choice((0.01, 0.3, 1)))
            killed = draw.random() < 0.3
            if killed:
                both[0].send_signal(signal.SIGKILL)
                totals.count("one killed")
            for number, process in enumerate(both):
                try:
                    said = process.communicate(timeout=300)[1]
                except subprocess.TimeoutExpired:
                    process.kill()
                    said = "it hangs"
                    process.communicate()
                if process.returncode not in (0, -signal.SIGKILL if killed and number == 0 else 0):
                    totals.count(f"exit {process.returncode}: {said.strip().splitlines()[-1][:100] if said else ''}"
                                 .replace(folder, ""))
                    if process.returncode not in (1, 3):
                        totals.found(f"seed {seed}: batch {number} ends with {process.returncode}: {said}"[:500])
            time.sleep(0.3)  # the cases of a killed batch end when they are told
            wrong = [key for key, value in digests(o).items() if expected.get(key) and value != expected[key]]
            if wrong:
                totals.found(f"seed {seed}: {wrong} differ")
            # Once more, alone: everything is there, and it is no more than what one batch leaves.
            code, _, said, _ = run(words, limit=300)
            left = digests(o)
            parts = [key for key in left if ".part-" in key]
            if code != 0 or off(left) or parts or set(left) - set(expected):
                totals.found(f"seed {seed}: then alone: exit {code}, {off(left)} differ, {parts} left, "
                             f"{sorted(set(left) - set(expected))} too much: {said}"[:600])
            totals.ran()
            totals.place("seed", seed + 1)
            totals.save()
    totals.save()
    print(totals.of["runs"], "runs,", totals.of["counts"], len(totals.of["found"]), "found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
