#!/usr/bin/env python3
"""Runs the tests that the default run leaves out in turn, and says what was last run when, on which commit.

usage: heavy_status.py BUILD_DIR [table]            what was last run when, the stalest first, as a table
       heavy_status.py BUILD_DIR next [--count N]   runs the N stalest (1), at idle priority, and records them
       heavy_status.py BUILD_DIR run NAME...        runs these, and records them
       heavy_status.py BUILD_DIR check              whether each test that CTest knows is on the list

heavy_status.tsv holds the list: a line for each suite, test or family of tests with a label that the default run leaves
out. Run one a day, or one for each change, and commit the list with it; the table goes into the change log of a
release. The stalest is what was never run, then what failed, then what has seen most commits since. A test that says
it cannot run here counts as skipped: where a machine can, it is run there. Exit code 1: one failed, or is not on the
list.
"""
import argparse
import collections
import datetime
import json
import os
import re
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
LIST = f"{HERE}/heavy_status.tsv"
LABELS = {"heavy", "sanitizer", "analysis", "portable", "browser", "package", "cluster", "fuzz", "web"}
COLUMNS = ["name", "run", "commit", "result", "tests", "minutes"]
Row = collections.namedtuple("Row", COLUMNS)
NEVER = ["-"] * (len(COLUMNS) - 1)


def name_of(test):
    """A suite of GoogleTest whose name starts with Heavy, as one; of others their first two words."""
    words = test.split("  #")[0].split(".")
    if words[0].split("/")[-1].startswith("Heavy"):
        return words[0].split("/")[-1]
    return words[0].split("/")[0] if "/" in words[0] else ".".join(words[:2])


def known(build):
    """name -> tests that CTest knows by it"""
    listed = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True,
                                       stdout=subprocess.PIPE, text=True).stdout)
    tests = collections.defaultdict(list)
    for test in listed["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        labels = set(properties.get("LABELS", []))
        if labels & LABELS:
            tests[name_of(test["name"])].append(test["name"])
    return tests


def read():
    with open(LIST, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if line.strip() and not line.startswith("#")]
    return {line[0]: Row(*line) for line in lines}


def write(rows):
    with open(LIST, "w", encoding="utf-8") as file:
        file.write("# " + "\t".join(COLUMNS) + "\n")
        for name in sorted(rows):
            file.write("\t".join(rows[name]) + "\n")


def git(*command):
    done = subprocess.run(["git", "-C", HERE, *command], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def commits_since(row):
    """None for what was never run; a commit that is not of this branch counts as its day."""
    if row.run == "-":
        return None
    count = git("rev-list", "--count", f"{row.commit.rstrip('+')}..HEAD")
    return int(count or git("rev-list", "--count", f"--since={row.run}", "HEAD") or 0)


def by_staleness(rows):
    def key(row):
        since = commits_since(row)
        return (since is not None, row.result != "failed", -(since or 0), row.name)

    return sorted(rows.values(), key=key)


def run(build, name, tests):
    """The row of a run of these tests."""
    chosen = "|".join(re.escape(test.split("  #")[0]) for test in tests)
    start = time.monotonic()
    log = f"{build}/heavy-{name.replace('/', '_')}.log"
    with open(log, "w", encoding="utf-8") as file:
        subprocess.run(["nice", "-n", "19", "ctest", "--test-dir", build, "-R", f"^({chosen})([ ]|$)",
                        "--output-on-failure", "--no-tests=error"], stdin=subprocess.DEVNULL, stdout=file,
                       stderr=subprocess.STDOUT, check=False)
    minutes = (time.monotonic() - start) / 60
    with open(log, encoding="utf-8", errors="replace") as file:
        text = file.read()
    ended = re.findall(r"^ *\d+/\d+ Test +#\d+: .*?(Passed|\*\*\*\S+)", text, re.M)
    result = "failed" if not ended or any(one not in ("Passed", "***Skipped") for one in ended) else \
        "passed" if "Passed" in ended else "skipped"
    commit = (git("rev-parse", "--short=12", "HEAD") or "unknown") + \
        ("+" if git("status", "--porcelain", "--untracked-files=no", "--", ":!Testing/heavy_status.tsv") else "")
    print(f"{name}: {result}, {len(ended)} tests in {minutes:.1f} min; see {log}", flush=True)
    return Row(name, datetime.date.today().isoformat(), commit, result, str(len(ended)), f"{minutes:.1f}")


def check(tests, rows):
    """Test programs that are not built have no names yet, and are passed over."""
    missing = sorted(name for name in set(tests) - set(rows) if not name.endswith("_NOT_BUILT"))
    for name in missing:
        print(f"{name} is not in Testing/heavy_status.tsv: nobody would notice when it no longer runs", file=sys.stderr)
    print(f"{len(tests)} of {len(rows)} on the list are known here" if not missing else "add a line for each")
    return 1 if missing else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("what", nargs="?", default="table", choices=["table", "next", "run", "check"])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--count", type=int, default=1)
    options = parser.parse_args()
    build = os.path.realpath(options.build)
    tests, rows = known(build), read()
    if options.what == "check":
        return check(tests, rows)
    if options.what == "table":
        print("| tests | last run | on | changes since | result | minutes |\n| --- | --- | --- | --- | --- | --- |")
        for row in by_staleness(rows):
            since = commits_since(row)
            print(f"| {row.name} | {row.run} | {row.commit} | {'-' if since is None else since} | {row.result} | "
                  f"{row.minutes} |")
        return 0
    names = options.names if options.what == "run" else \
        [row.name for row in by_staleness(rows) if row.name in tests][:options.count]
    unknown = [name for name in names if name not in tests]
    if unknown or not names:
        sys.exit(f"heavy_status.py: CTest does not know {', '.join(unknown) or 'any of them'} in {build}")
    failed = False
    for name in names:
        rows = {**read(), name: run(build, name, tests[name])}
        write(rows)
        failed = failed or rows[name].result == "failed"
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
