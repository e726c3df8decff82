#!/usr/bin/env python3
"""Says how much of the modules below Imaging the default tests reach: lines and branches, a module a row.

usage: coverage.py BUILD_DIR [--jobs 2] [--missed FILE]

Builds these modules and their tests with gcov's counters in BUILD_DIR, runs the default tests and sums up with gcovr
(Debian's). Branches that only an exception takes out of a call are left out: the compiler makes them after nearly every
call, and no source names them. --missed writes path:line of what no test reaches. A line that cannot be reached, say
the refusal of a shape too large for any machine here, bears a comment with the reason and the words 'no coverage'.
Exit code 1: under 95 % of lines or 85 % of branches in all.
"""
import argparse
import collections
import json
import os
import subprocess
import sys

SOURCE = os.path.realpath(f"{os.path.dirname(os.path.abspath(__file__))}/../..")
MODULES = ["Lattice", "Shape", "Complex", "Delaunay", "Blocks", "VoxelCore", "Refinement", "Skeleton", "Thickness",
           "Voxelization", "Phantom", "Verification", "Certified", "Formats", "ItkReader"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--missed")
    options = parser.parse_args()
    build = os.path.realpath(options.build)
    # Imaging is only built: the tests of formats read scans through it.
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DBUILD_TESTING=ON",
                    "-DCMAKE_BUILD_TYPE=Coverage", "-DVOXELCORE_MODULES=" + ";".join(MODULES + ["Imaging"]),
                    "-DCMAKE_CXX_FLAGS=-O1 -g1 --coverage -fprofile-update=atomic"], check=True,
                   stdout=subprocess.DEVNULL)
    targets = [f"Testing/{module}/all" for module in MODULES]
    subprocess.run(["ninja", "-C", build, f"-j{options.jobs}"] + targets, check=True, stdout=subprocess.DEVNULL)
    for folder, _, names in os.walk(build):
        for name in names:
            if name.endswith(".gcda"):
                os.remove(f"{folder}/{name}")
    tests = subprocess.run(["ctest", "--test-dir", build, "-LE", "heavy|sanitizer|browser|package|cluster|fuzz", "-L",
                            f"^({'|'.join(MODULES)})$", f"-j{options.jobs}", "--output-on-failure", "--no-tests=error",
                            "--timeout", "3600"], check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                           text=True)
    with open(f"{build}/tests.log", "w", encoding="utf-8") as file:
        file.write(tests.stdout)
    if tests.returncode:
        print(f"tests fail: {build}/tests.log")
    found = json.loads(subprocess.run(
        ["gcovr", "-r", SOURCE, build, "-f", f"{SOURCE}/Modules/", "--exclude-throw-branches",
         "--exclude-unreachable-branches", "--exclude-lines-by-pattern", ".*no coverage.*", "--json", "-j",
         str(options.jobs)], check=True, stdout=subprocess.PIPE, text=True).stdout)

    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    missed = []
    for file in found["files"]:
        module = file["file"].split("/")[1]
        if module not in MODULES:
            continue
        for line in file["lines"]:
            if line.get("gcovr/noncode") or line.get("gcovr/excluded"):
                continue
            taken = [branch["count"] > 0 for branch in line["branches"]]
            for name in (module, "all"):
                for place, number in enumerate((line["count"] > 0, 1, sum(taken), len(taken))):
                    sums[name][place] += number
            if line["count"] == 0:
                missed.append(f"{file['file']}:{line['line_number']}: line")
            elif not all(taken):
                missed.append(f"{file['file']}:{line['line_number']}: {taken.count(False)} of {len(taken)} branches")
    if options.missed:
        with open(options.missed, "w", encoding="utf-8") as file:
            file.write("\n".join(missed) + "\n")
    print("| module | lines | reached | branches | taken |\n| --- | --- | --- | --- | --- |")
    for module in MODULES + ["all"]:
        lines, all_lines, branches, all_branches = sums[module]
        print(f"| {module} | {all_lines} | {100 * lines / max(all_lines, 1):.1f} % | {all_branches} | "
              f"{100 * branches / max(all_branches, 1):.1f} % |")
    lines, all_lines, branches, all_branches = sums["all"]
    return 0 if lines >= .95 * all_lines and branches >= .85 * all_branches else 1


if __name__ == "__main__":
    sys.exit(main())
