#!/usr/bin/python3
"""Whole jobs of voxelcore over `core --lambda 1.5vox` on the same scan: elapsed time and peak memory.

usage: whole_jobs.py VOXELCORE [SCAN ...] [--mark PROGRAM] [--jobs NAMES] [--with WORDS] [--labels all]
                     [--repetitions 5] [--threads 2]

Without scans phantoms are made: ellipsoid 256, gyroid 128, root 512. The jobs of a repetition follow each other
directly; medians of each are compared. For a machine with nothing else to do.
--mark: the program that the lambda job is of, so that a faster engine does not move what others are compared with.
--with: more words for all jobs, as "--threshold 300:inf" for a grey scan or "--resolution 384" for a mesh, for which
there are the jobs "refine grey" and "refine mesh".
--jobs: some of the jobs, as "skeleton; refine labels".
"""
import argparse
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

from memory_at_hand import have_memory_at_hand

PHANTOMS = [("ellipsoid", "256"), ("gyroid", "128"), ("root", "512")]
MARK = "lambda 1.5vox"
JOBS = {MARK: ["core", "--lambda", "1.5vox"],
        "tolerance": ["core", "--refine", "off"],
        "skeleton": ["skeleton"],
        "refine labels": ["core", "--lambda", "1.5vox", "--refine", "labels"],
        "the default": ["core"],
        "tolerance, refine, skeleton": ["core", "--refine", "labels", "--with-skeleton"]}
MORE_JOBS = {"refine grey": ["core", "--lambda", "1.5vox", "--refine", "grey"],
             "refine mesh": ["core", "--lambda", "1.5vox", "--refine", "mesh"]}


def cost(command):
    """Seconds and peak memory in MB."""
    have_memory_at_hand()
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"whole_jobs.py: exit {os.waitstatus_to_exitcode(status)} of {' '.join(command)}")
    return time.perf_counter() - start, usage.ru_maxrss / 1024


def compare(options, scan, folder):
    costs = {job: [] for job in options.chosen}
    more = shlex.split(options.more) + ([] if options.labels is None else ["--labels", options.labels])
    for _ in range(options.repetitions):
        for job, (command, *words) in options.chosen.items():
            program = options.mark if job == MARK else options.voxelcore
            costs[job].append(cost([program, command, str(scan), *words, *more, "--threads",
                                    str(options.threads), "-o", str(folder / "out.vtp"), "--force", "--quiet"]))
    medians = {job: [statistics.median(column) for column in zip(*rows)] for job, rows in costs.items()}
    seconds, memory = medians[MARK]
    cells = [f"{medians[job][0] / seconds:.2f} ({medians[job][1] / memory:.2f})" for job in costs if job != MARK]
    print(f"| {pathlib.Path(scan).name} | {seconds:.2f} s, {memory:.0f} MB | {' | '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("voxelcore")
    parser.add_argument("scans", nargs="*")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--labels")
    parser.add_argument("--mark")
    parser.add_argument("--jobs")
    parser.add_argument("--with", dest="more", default="")
    options = parser.parse_args()
    options.mark = options.mark or options.voxelcore
    names = list(JOBS) if options.jobs is None else [MARK, *options.jobs.split("; ")]
    if unknown := [name for name in names if name not in JOBS | MORE_JOBS]:
        parser.error(f"no such job: {', '.join(unknown)}; there are: {'; '.join(JOBS | MORE_JOBS)}")
    options.chosen = {name: (JOBS | MORE_JOBS)[name] for name in names}
    print("| scan | " + " | ".join(job + ("" if job == MARK else ", time (memory)") for job in names) + " |")
    print("|---" * (len(names) + 1) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scan in options.scans:
            compare(options, scan, folder)
        for kind, size in [] if options.scans else PHANTOMS:
            scan = folder / f"{kind}-{size}.nrrd"
            subprocess.run([options.voxelcore, "phantom", kind, "--size", size, "-o", scan, "--quiet"], check=True)
            compare(options, scan, folder)


if __name__ == "__main__":
    main()
