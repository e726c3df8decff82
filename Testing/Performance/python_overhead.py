#!/usr/bin/env python3
"""What Python adds to the command line: the core of one large scan, computed and written, by both in turn.

usage: python_overhead.py PROGRAM FOLDER_OF_THE_PYTHON_PACKAGE [--kind root] [--size 512] [--rounds 3] [--threads 1]

Seconds, on a machine that does nothing else: of the program from start to end, and of core() and save() on an array
that is in memory; medians over the rounds, and the median of their quotients. Processor time, of both, is what other
work disturbs less.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("package")
    parser.add_argument("--kind", default="root")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    sys.path.insert(0, options.package)
    import voxelcore

    with tempfile.TemporaryDirectory() as work:
        scan = f"{work}/scan.nrrd"
        subprocess.run([program, "phantom", options.kind, "--size", str(options.size), "-o", scan, "-q"], check=True)
        with open(scan, "rb") as file:
            header, data = file.read().split(b"\n\n", 1)
        if b"encoding: raw" not in header:
            import gzip

            data = gzip.decompress(data)
        array = numpy.frombuffer(data, numpy.uint8).reshape((options.size,) * 3, order="F")

        def by_program():
            subprocess.run([
                program, "core", scan, "-o", f"{work}/program.vtp", "--threads",
                str(options.threads), "--force", "-q"
            ],
                           check=True)

        def by_python():
            core = voxelcore.core(array, spacing=(1, 1, 1), threads=options.threads)
            core.save(f"{work}/python.vtp", overwrite=True)

        taken = {by_program: [], by_python: []}
        for _ in range(options.rounds):
            for work_of, times in taken.items():
                start, before = time.monotonic(), sum(os.times()[:4])
                work_of()
                times.append((time.monotonic() - start, sum(os.times()[:4]) - before))
            print(", ".join("{} {:.2f} s (processor {:.2f} s)".format(work_of.__name__, *times[-1])
                            for work_of, times in taken.items()), flush=True)
        sizes = {os.path.getsize(f"{work}/{name}.vtp") for name in ("program", "python")}
    for clock, name in enumerate(("wall-clock", "processor time")):
        program, python = ([times[clock] for times in taken[work_of]] for work_of in (by_program, by_python))
        quotient = statistics.median(y / x for x, y in zip(program, python))
        print(f"{options.kind} {options.size}^3, {name}: program {statistics.median(program):.2f} s, Python "
              f"{statistics.median(python):.2f} s, {100 * (quotient - 1):+.1f} %")
    print(f"bytes written {sorted(sizes)}")


if __name__ == "__main__":
    main()
