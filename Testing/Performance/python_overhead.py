#!/usr/bin/env python3
"""What Python adds to the command line: the core of one large scan, computed and written, by both in turn.

usage: python_overhead.py PROGRAM FOLDER_OF_THE_PYTHON_PACKAGE [--kind root] [--size 512] [--rounds 3] [--threads 1]
                          [--scan ATLAS.nii.gz]    all its labels, a file each, instead of a phantom (needs nibabel)

Seconds, on a machine that does nothing else: of the program from start to end, and of core() and save() on an array
that is in memory; medians over the rounds, and the median of their quotients. Processor time, of both, is what other
work disturbs less.
"""
import argparse
import os
import shutil
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
    parser.add_argument("--scan")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    sys.path.insert(0, options.package)
    import voxelcore

    with tempfile.TemporaryDirectory() as work:
        if options.scan:
            import nibabel

            scan, where = os.path.realpath(options.scan), "program/"
            image = nibabel.load(scan)
            image.get_fdata(dtype=numpy.float32)  # is in memory from here on
            os.mkdir(f"{work}/python")
        else:
            scan, where = f"{work}/scan.nrrd", "program.vtp"
            words = ["phantom", options.kind, "--size", str(options.size), "-o", scan, "-q"]
            subprocess.run([program, *words], check=True)
            with open(scan, "rb") as file:
                header, data = file.read().split(b"\n\n", 1)
            if b"encoding: raw" not in header:
                import gzip

                data = gzip.decompress(data)
            array = numpy.frombuffer(data, numpy.uint8).reshape((options.size,) * 3, order="F")

        def by_program():
            shutil.rmtree(f"{work}/program", ignore_errors=True)  # labels that are there are not computed again
            subprocess.run([
                program, "core", scan, "-o", f"{work}/{where}", "--threads",
                str(options.threads), "--force", "-q"
            ],
                           check=True)

        def by_python():
            if options.scan:
                for label, core in voxelcore.core(image, label="all", threads=options.threads).items():
                    core.save(f"{work}/python/{label}.vtp", overwrite=True)
                return
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
        sizes = {
            sum(os.path.getsize(os.path.join(folder, file)) for folder, _, files in os.walk(work) for file in files
                if file.endswith(".vtp") and name in os.path.join(folder, file))
            for name in ("program", "python")
        }  # fmt: skip
    for clock, name in enumerate(("wall-clock", "processor time")):
        program, python = ([times[clock] for times in taken[work_of]] for work_of in (by_program, by_python))
        quotient = statistics.median(y / x for x, y in zip(program, python))
        what = os.path.basename(options.scan) if options.scan else f"{options.kind} {options.size}^3"
        print(f"{what}, {name}: program {statistics.median(program):.2f} s, Python "
              f"{statistics.median(python):.2f} s, {100 * (quotient - 1):+.1f} %")
    print(f"bytes written {sorted(sizes)}")


if __name__ == "__main__":
    main()
