#!/usr/bin/env python3
"""What a batch adds to `voxelcore core`, and what a second job brings, on many small root phantoms.

usage: batch_throughput.py PROGRAM [--cases 500] [--size 40] [--rounds 3]      on a machine that does nothing else

Each round runs, one after the other: the program itself once per case (alone), the same in two loops side by side
(alone 2: what the machine has to give), a batch of all cases with one job and with two, --threads 1 throughout. Medians
over the rounds, wall-clock seconds and processor time of all processes, which other work disturbs less.
"""
import argparse
import os
import statistics
import subprocess
import tempfile
import threading
import time


def seconds(work):
    """Wall-clock seconds, and seconds of processor time of this process and of all it started."""
    start, before = time.monotonic(), sum(os.times()[:4])
    work()
    return time.monotonic() - start, sum(os.times()[:4]) - before


def quietly(words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=500)
    parser.add_argument("--size", type=int, default=40, help="voxels on a side")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    with tempfile.TemporaryDirectory() as work:
        os.makedirs(f"{work}/scans")
        scans = [f"{work}/scans/s{i:04}.nrrd" for i in range(options.cases)]
        for i, scan in enumerate(scans):
            quietly([program, "phantom", "root", "--size", str(options.size), "--seed", str(i + 1), "-o", scan, "-q"])

        def alone(part, stride):
            for i in range(part, options.cases, stride):
                stem = f"{work}/alone{i:04}"  # what a batch asks of each case
                quietly([
                    program, "core", scans[i], "-o", f"{stem}_medial.vtp", "--report", f"{stem}_report.json", "--force",
                    "--progress", "none", "--threads=1", "--with-skeleton", "--also=csv,swc"
                ])

        def side_by_side():
            loops = [threading.Thread(target=alone, args=(part, 2)) for part in (0, 1)]
            for loop in loops:
                loop.start()
            for loop in loops:
                loop.join()

        def batch(jobs):
            quietly([
                program, "batch", f"{work}/scans", "-o", f"{work}/out", "--jobs",
                str(jobs), "--threads", "1", "--force"
            ])

        kinds = {
            "alone": lambda: alone(0, 1),
            "alone 2": side_by_side,
            "batch 1": lambda: batch(1),
            "batch 2": lambda: batch(2),
        }
        taken = {kind: [] for kind in kinds}
        for number in range(options.rounds):
            for kind, job in kinds.items():
                taken[kind].append(seconds(job))
            print(f"round {number + 1}: " + ", ".join("{} {:.2f} s (processor {:.2f} s)".format(kind, *taken[kind][-1])
                                                      for kind in kinds), flush=True)

    def ratio(a, b):
        return statistics.median(x[0] / y[0] for x, y in zip(taken[a], taken[b]))

    def each(kind, clock):
        return 1000 * statistics.median(pair[clock] for pair in taken[kind]) / options.cases

    def extra(clock):
        return 1000 * statistics.median(b[clock] - a[clock]
                                        for a, b in zip(taken["alone"], taken["batch 1"])) / options.cases

    print(f"{options.cases} cases, {each('alone', 0):.0f} ms each alone, {each('alone', 1):.0f} ms of processor time")
    print(f"a batch adds {extra(0):.1f} ms a case, {extra(1):.1f} ms of processor time")
    print(f"two jobs against one: {ratio('batch 1', 'batch 2'):.2f} times the throughput; two loops without a batch: "
          f"{ratio('alone', 'alone 2'):.2f}")


if __name__ == "__main__":
    main()
