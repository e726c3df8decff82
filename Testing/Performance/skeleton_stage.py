#!/usr/bin/python3
"""The skeleton stage beside the core stage of both engines, on a root phantom.

usage: skeleton_stage.py VOXELCORE [--size N] [--repetitions N] [--threads N]

What is asked: the skeleton stage takes at most the time of the TetGen engine's core stage (cells and core), with twice
the lattice engine's as the aim, and the whole run at most twice the memory of `core`. The runs of a repetition follow
each other directly; the medians of all count. For a machine with nothing else to do.
"""
import argparse
import json
import os
import statistics
import subprocess
import tempfile


def run(program, folder, words):
    report = os.path.join(folder, "report.json")
    subprocess.run([program, *words, "--report", report, "--force", "--quiet"], check=True)
    with open(report, encoding="utf-8") as file:
        return json.load(file)


def core_stage(report):
    return report["seconds"]["delaunay"] + report["seconds"]["core"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scan = os.path.join(folder, "root.nrrd")
        subprocess.run([options.program, "phantom", "root", "--size",
                        str(options.size), "-o", scan, "--quiet"],
                       check=True)
        common = ["--threads", str(options.threads), "-o", os.path.join(folder, "out.vtp")]
        rows = []
        for _ in range(options.repetitions):
            tetgen = run(options.program, folder, ["core", scan, "--lambda", "0", "--engine", "tetgen", *common])
            lattice = run(options.program, folder, ["core", scan, "--lambda", "0", "--engine", "lattice", *common])
            skeleton = run(options.program, folder, ["skeleton", scan, *common])
            rows.append((skeleton["seconds"]["skeleton"], core_stage(tetgen), core_stage(lattice),
                         skeleton["peak_memory_mb"], lattice["peak_memory_mb"]))
        stage, tetgen, lattice, memory, core_memory = (statistics.median(column) for column in zip(*rows))
        print(f"root {options.size}, medians of {options.repetitions}")
        print(f"skeleton stage           {stage:9.3f} s")
        print(f"core stage, tetgen       {tetgen:9.3f} s   skeleton over it {stage / tetgen:5.2f}  (asked: 1)"
              f"{'' if stage <= tetgen else '  TOO SLOW'}")
        print(f"core stage, lattice      {lattice:9.3f} s   skeleton over it {stage / lattice:5.2f}  (aim: 2)"
              f"{'' if stage <= 2 * lattice else '  MISSED'}")
        print(
            f"memory, skeleton, core   {memory:9.1f} MB {core_memory:9.1f} MB   "
            f"ratio {memory / core_memory:5.2f}  (asked: 2)"
            f"{'' if memory <= 2 * core_memory else '  TOO MUCH'}")


if __name__ == "__main__":
    main()
