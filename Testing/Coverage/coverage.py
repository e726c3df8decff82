#!/usr/bin/env python3
"""Says how much of the modules below Imaging the default tests reach: lines and branches, a module a row.

usage: coverage.py BUILD_DIR [--jobs 2] [--missed FILE] [--modules Formats ...] [--exclude REGEX]

Builds these modules and their tests with gcov's counters in BUILD_DIR, runs the default tests and sums up what gcov
says. After nearly every call the compiler makes two branches, one that goes on and one that an exception takes. No
source names them: both are left out. (Leaving out the second alone, each call that is reached would count as a branch
taken, and each call of a line that is not reached as one that is not.) Instances of a template are added up. --missed
writes path:line of what no test reaches. A line that cannot be reached, say the refusal of a shape too large for any
machine here, bears a comment with the reason and the words 'no coverage'. --modules builds and runs only the tests of
these, and says only of these what they reach: a row is then no more than in a run of all, as other modules' tests reach
much of a module, too. --exclude leaves out tests, by name. Exit code 1: under 95 % of lines or 85 % of branches in all.
"""
import argparse
import collections
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys

SOURCE = os.path.realpath(f"{os.path.dirname(os.path.abspath(__file__))}/../..")
MODULES = ["Base", "Lattice", "Complex", "Shape", "Delaunay", "VoxelCore", "Refinement", "Skeleton", "Verification",
           "Certified", "Labels", "Masks", "Formats", "ItkReader", "Blocks", "Meshes", "Phantom", "Thickness", "Sheets",
           "Roots"]


def decisions(branches):
    """Counts of the branches of a line that are no call's. They come in pairs or, of a switch, in greater groups."""
    kept = []
    at = 0
    while at < len(branches):
        pair = branches[at:at + 2]
        if len(pair) == 2 and pair[0]["throw"] != pair[1]["throw"]:
            at += 2
            continue
        step = 2 if pair[0]["fallthrough"] else 1
        kept += [branch["count"] for branch in branches[at:at + step] if not branch["throw"]]
        at += step
    return kept


def added(one, other):
    return [a + b for a, b in itertools.zip_longest(one, other, fillvalue=0)]


def counted_lines(counters):
    """By file and line: how often it ran, and how often each of its branches was taken."""
    found = collections.defaultdict(lambda: [0, []])
    for counter in counters:
        notes = f"{os.path.splitext(counter)[0]}.gcno"  # of the compiler, which lie beside the objects
        if not os.path.exists(notes):
            os.symlink(re.sub("^.*/reader-counters/[0-9]+", "", notes), notes)
        text = subprocess.run(["gcov", "--json-format", "--branch-probabilities", "--stdout", counter], check=True,
                              stdout=subprocess.PIPE, text=True, cwd=os.path.dirname(counter)).stdout
        for document in filter(None, text.splitlines()):
            for file in json.loads(document)["files"]:
                path = os.path.realpath(file["file"])
                if not path.startswith(f"{SOURCE}/Modules/"):
                    continue
                for line in file["lines"]:  # one and the same several times: of instances of a template
                    one = found[path, line["line_number"]]
                    one[0] += line["count"]
                    one[1] = added(one[1], decisions(line["branches"]))
    return found


def count_reader_apart(build):
    """Has the program that reads through ITK, which is killed when enough is known, and so in the midst of writing its
    counters, write them to files of its own: what it spoils there are no other program's."""
    program = f"{build}/libexec/voxelcore/voxelcore-itk-reader"
    if not os.path.exists(program):
        return
    with open(program, "rb") as file:
        if file.read(4) != b"\x7fELF":
            return  # the script below
    os.replace(program, program + ".counted")
    with open(program, "w", encoding="utf-8") as file:
        # Several sets: each holds nearly all that is ever run, should some be spoilt.
        file.write(f"#!/bin/sh\nGCOV_PREFIX={build}/reader-counters/$(($$ % 8)) exec {program}.counted \"$@\"\n")
    os.chmod(program, 0o755)


def read_lines(path):
    with open(path, encoding="utf-8") as file:
        return file.read().splitlines()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--missed")
    parser.add_argument("--modules", nargs="+", choices=MODULES, default=MODULES)
    parser.add_argument("--exclude", default="^$")
    options = parser.parse_args()
    build = os.path.realpath(options.build)
    # Imaging is only built: the tests of formats read scans through it. VOXELCORE_SANITIZED: of what is made twice, for
    # two kinds of processors, only one runs on any machine.
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DBUILD_TESTING=ON",
                    "-DCMAKE_BUILD_TYPE=Coverage", "-DVOXELCORE_MODULES=" + ";".join(MODULES + ["Imaging"]),
                    "-DCMAKE_CXX_FLAGS=-O1 -g1 --coverage -fprofile-update=atomic -DVOXELCORE_SANITIZED"], check=True,
                   stdout=subprocess.DEVNULL)
    targets = [f"Testing/{path.parent.parent.name}/{path.parent.name}/all" for module in options.modules
               for path in pathlib.Path(SOURCE, "Testing").glob(f"*/{module}/CMakeLists.txt")]
    subprocess.run(["ninja", "-C", build, f"-j{options.jobs}"] + targets, check=True, stdout=subprocess.DEVNULL)
    count_reader_apart(build)

    def counters():
        return [f"{folder}/{name}" for folder, _, names in os.walk(build) for name in names if name.endswith(".gcda")]

    for counter in counters():
        os.remove(counter)
    tests = subprocess.run(["ctest", "--test-dir", build,
                            "-LE", "heavy|sanitizer|browser|package|cluster|fuzz|web", "-L",
                            f"^({'|'.join(options.modules)})$", f"-j{options.jobs}", "--output-on-failure",
                            "--no-tests=error", "--timeout", "3600", "-E", options.exclude], check=False,
                           stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
    with open(f"{build}/tests.log", "w", encoding="utf-8") as file:
        file.write(tests.stdout)
    if tests.returncode:
        print(f"tests fail: {build}/tests.log")

    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    missed = []
    sources = {}
    for (path, number), (count, branches) in sorted(counted_lines(counters()).items()):
        name = os.path.relpath(path, SOURCE)
        module = name.split("/")[2]
        sources[path] = sources.get(path) or read_lines(path)
        line = sources[path][number - 1]
        # At a lone brace stands what the compiler makes of itself: destructors, say.
        if module not in options.modules or not line.strip(" {}();") or "no coverage" in line:
            continue
        taken = [times > 0 for times in branches]
        for row in (module, "all"):
            for place, value in enumerate((count > 0, 1, sum(taken), len(taken))):
                sums[row][place] += value
        if count == 0:
            missed.append(f"{name}:{number}: line")
        elif not all(taken):
            missed.append(f"{name}:{number}: {taken.count(False)} of {len(taken)} branches")
    if options.missed:
        with open(options.missed, "w", encoding="utf-8") as file:
            file.write("\n".join(missed) + "\n")
    print("| module | lines | reached | branches | taken |\n| --- | --- | --- | --- | --- |")
    for module in options.modules + ["all"]:
        lines, all_lines, branches, all_branches = sums[module]
        print(f"| {module} | {all_lines:,} | {100 * lines / max(all_lines, 1):.1f} % | {all_branches:,} | "
              f"{100 * branches / max(all_branches, 1):.1f} % |")
    lines, all_lines, branches, all_branches = sums["all"]
    return 0 if lines >= .95 * all_lines and branches >= .85 * all_branches else 1


if __name__ == "__main__":
    sys.exit(main())
