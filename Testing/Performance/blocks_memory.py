#!/usr/bin/env python3
"""One volume in blocks, each in a process that may not have more than so much memory, and the join; beside the single
run.

usage: blocks_memory.py PROGRAM [--size 1024] [--blocks 8] [--limit 600] [--threads 1] [--folder FOLDER]

A root phantom. The limit, in MB, holds for what each block's process allocates (RLIMIT_DATA), so one that wants more
fails; the single run is tried under it too, and must fail. Peak memory is the resident set. The joined file must have
the single run's bits. With --folder, what is there is not made again.
"""
import argparse
import filecmp
import json
import os
import resource
import subprocess
import sys
import tempfile
import time


def run(words, limit=None):
    """Exit code, peak memory in MB, seconds, and what it said on stderr."""
    set_limit = (lambda: resource.setrlimit(resource.RLIMIT_DATA,
                                            (limit * 1000000, limit * 1000000))) if limit else None
    start = time.monotonic()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(words, preexec_fn=set_limit, stderr=said)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode(errors="replace").strip()
    return child.returncode, usage.ru_maxrss * 1.024e-3, time.monotonic() - start, text


def expect(condition, message):
    if not condition:
        sys.exit("blocks_memory.py: " + message)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--blocks", type=int, default=8)
    parser.add_argument("--limit", type=int, default=600)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--folder")
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    temporary = tempfile.TemporaryDirectory()
    folder = options.folder or temporary.name
    os.makedirs(folder, exist_ok=True)
    scan, parts = f"{folder}/root.nrrd", f"{folder}/parts/"
    common = ["--threads", str(options.threads), "--quiet", "--force"]
    if not os.path.exists(scan):
        subprocess.run([program, "phantom", "root", "--size", str(options.size), "-o", scan, "-q"], check=True)

    core = [program, "core", scan, "--refine", "off"]
    worst = 0
    for block in range(1, options.blocks + 1):
        code, peak, seconds, said = run(
            core + ["--blocks", str(options.blocks), "--block",
                    str(block), "-o", parts] + common, options.limit)
        expect(code == 0, f"block {block} fails under {options.limit} MB: {said}")
        worst = max(worst, peak)
        print(f"block {block}: {peak:.0f} MB, {seconds:.1f} s", flush=True)
    size = sum(entry.stat().st_size for entry in os.scandir(parts))

    code, peak, _, said = run(core + ["-o", f"{folder}/limited.vtp"] + common, options.limit)
    expect(code != 0 and not os.path.exists(f"{folder}/limited.vtp"),
           f"a single run does with {options.limit} MB: {peak:.0f}")
    print(f"single run under {options.limit} MB: exit code {code}, {said}", flush=True)
    code, single, seconds, said = run(core + ["-o", f"{folder}/single.vtp", "--report", f"{folder}/single.json"] +
                                      common)
    expect(code == 0, said)
    print(f"single run: {single:.0f} MB, {seconds:.1f} s", flush=True)
    code, join, seconds, said = run(core + ["--join", parts, "-o", f"{folder}/joined.vtp"] + common)
    expect(code == 0, said)
    with open(f"{folder}/single.json", encoding="utf-8") as file:
        vertices = sum(label["boundary_vertices"] for label in json.load(file)["labels"])
    print(f"join: {join:.0f} MB, {seconds:.1f} s")
    expect(filecmp.cmp(f"{folder}/single.vtp", f"{folder}/joined.vtp", shallow=False), "the joined file has other bits")
    print(
        f"root {options.size}^3, {vertices} boundary vertices: blocks at most {worst:.0f} MB, "
        f"single run {single:.0f} MB, join {join:.0f} MB = {1e6 * join / vertices:.0f} bytes a vertex; "
        f"parts {size / vertices:.0f} bytes a vertex; same bits"
    )


if __name__ == "__main__":
    main()
