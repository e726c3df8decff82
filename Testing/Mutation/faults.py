#!/usr/bin/env python3
"""Seeds small faults into the rooms of mathematics and the promise, and says which of them no test notices.

usage: faults.py BUILD_DIR [--count 200] [--seed S] [--jobs 2] [--modules A,B..] [--results FILE.json]
       faults.py BUILD_DIR --again FILE.json [--jobs 2] [--results FILE.json]

A fault is a sign, a comparison, a constant, an index or a bound changed, or a check dropped, on one line of
the rooms of SEEDED. All faults of a run are built into one copy of
the tree in BUILD_DIR, each behind a switch (switch.h); lines that do not compile so are left out. A first run of the
default tests of the modules and of the program's recorded runs (Testing/Results) tells which come past which fault;
then, for each fault, these run with it, the quick ones first, until one fails, crashes or takes ten times the
processor time. With the same seed and sources the faults are the same.
What is known to change no result stands in explained.txt: path, the line, what it became, and why. --again runs those
that an earlier run left unnoticed, and keeps what it found of the others. Exit code 1: over 3 % went unnoticed and are
not explained there; those explained are counted apart, not as noticed.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

SOURCE = os.path.realpath(f"{os.path.dirname(os.path.abspath(__file__))}/../..")
SEEDED = ["Base", "Lattice", "Shape", "Complex", "Delaunay", "VoxelCore", "Skeleton", "Certified", "Labels", "Masks",
          "Roots"]
TESTED = SEEDED + ["Blocks", "Refinement", "Thickness", "Sheets", "Phantom", "Verification", "Jobs", "RootsJob",
                   "ThicknessJob", "SheetsJob"]
LEFT_OUT = re.compile("heavy|sanitizer|browser|package|cluster|fuzz|web")

# What becomes what, by kind; each is tried at each place of an expression where it fits.
CHANGES = [
    ("sign", r" \+ ", " - "), ("sign", r" - ", " + "), ("sign", r" \+= ", " -= "), ("sign", r" -= ", " += "),
    ("sign", r"(?<=[(,=] )-(?=\w)", ""), ("product", r" \* ", " + "), ("bound", r" < ", " <= "),
    ("bound", r" <= ", " < "), ("bound", r" > ", " >= "), ("bound", r" >= ", " > "), ("comparison", r" == ", " != "),
    ("comparison", r" != ", " == "), ("comparison", r" < ", " > "), ("comparison", r" > ", " < "),
    ("logic", r" && ", " || "), ("logic", r" \|\| ", " && "), ("logic", r"!(?=[\w(])", ""),
    ("extreme", r"\bstd::min\b", "std::max"), ("extreme", r"\bstd::max\b", "std::min"), ("bits", r" & (?=\w)", " | "),
    ("bits", r" \| ", " & "), ("bits", r" >> ", " << "), ("index", r"\[0\]", "[1]"), ("index", r"\[1\]", "[2]"),
    ("index", r"\[2\]", "[0]"), ("index", r"\[i\]", "[j]"), ("index", r"\[j\]", "[i]"), ("off by one", r" \+ 1\b", ""),
    ("off by one", r" - 1\b", ""), ("constant", r"\b0\b(?![.\]])", "1"), ("constant", r"\b1\b(?![.\]])", "2"),
    ("constant", r"\b2\b(?![.\]])", "3"), ("constant", r"\btrue\b", "false"), ("constant", r"\bfalse\b", "true"),
]
Fault = collections.namedtuple("Fault", "path line kind before after text")


def matching(text, at):
    """Where the bracket opened at `at` closes, or -1."""
    depth = 0
    for place in range(at, len(text)):
        depth += {"(": 1, ")": -1}.get(text[place], 0)
        if depth == 0:
            return place
    return -1


def expression(line):
    """(start, end) of the whole expression on a line that may be changed, or None."""
    condition = re.match(r"\s*(\} else )?(else )?(if|while) \(", line)
    if condition:
        end = matching(line, condition.end() - 1)
        return (condition.end(), end) if end > 0 and line[end + 1:].strip() in ("", "{") and ";" not in line else None
    loop = re.match(r"\s*for \([^;:]*; ([^;]*); [^;]*\)\s*\{?$", line)
    if loop:
        return loop.span(1)
    result = re.match(r"\s*return (.+);$", line)
    if result:
        return result.span(1) if not result[1].startswith("{") else None
    assignment = re.match(r"\s*(?:[\w:<>,.*&\[\]()>-]+ )*?[\w.\[\]()>-]+ [-+*/|&^]?= (.+);$", line)
    return assignment.span(1) if assignment else None


def balanced(text):
    """Whether brackets of an expression close, and it is one that may stand in brackets itself."""
    return all(text.count(a) == text.count(b) for a, b in ("()", "[]", "{}")) and "{" not in text and "\"" not in text


def candidates(modules):
    """All faults there are, in the order of the sources."""
    found = []
    for module in modules:
        for folder, _, names in sorted(place for group in os.listdir(f"{SOURCE}/Modules")
                                       for place in os.walk(f"{SOURCE}/Modules/{group}/{module}")):
            for name in sorted(names):
                if not name.endswith((".cxx", ".h")):
                    continue
                path = os.path.relpath(f"{folder}/{name}", SOURCE)
                with open(f"{SOURCE}/{path}", encoding="utf-8") as file:
                    lines = file.read().split("\n")
                for number, line in enumerate(lines):
                    found += faults_of(path, number, line, lines)
    return found


def faults_of(path, number, line, lines):
    if re.search(r"constexpr|static_assert|template|operator|#|//|\bcase\b|\bauto &|noexcept", line):
        return []
    span = expression(line)
    if span is None or not balanced(line[span[0]:span[1]]):
        return []
    before, found = line[span[0]:span[1]], []
    for kind, pattern, becomes in CHANGES:
        for match in re.finditer(pattern, before):
            after = before[:match.start()] + becomes + before[match.end():]
            if after.strip() and balanced(after):
                found.append((kind, after))
    following = " ".join(lines[number + 1:number + 3])
    if line.strip().startswith("if (") and re.search(r"\b(throw|return|continue)\b", following):
        found.append(("dropped check", f"false && ({before})"))
    return [Fault(path, number, kind, before, after, line.strip()) for kind, after in found]


def spread(faults, count, generator):
    """At most one fault a line, the modules' shares after their lines that can be changed."""
    generator.shuffle(faults)
    taken, lines = [], set()
    for fault in faults:
        if (fault.path, fault.line) not in lines:
            lines.add((fault.path, fault.line))
            taken.append(fault)
    return taken[:count]


def write_faults(tree, faults):
    """The tree with all faults, each behind its switch; `faults` is number -> fault."""
    of_path = collections.defaultdict(list)
    for number, fault in faults.items():
        of_path[fault.path].append((number, fault))
    for path in {fault.path for fault in faults.values()} | set(write_faults.written):
        with open(f"{SOURCE}/{path}", encoding="utf-8") as file:
            lines = file.read().split("\n")
        for number, fault in of_path[path]:
            start, end = expression(lines[fault.line])
            line = lines[fault.line]
            lines[fault.line] = (f"{line[:start]}(voxelcore_faults::On({number}) ? ({fault.after}) : ({fault.before}))"
                                 f"{line[end:]}")
        text = "\n".join(lines)
        with open(f"{tree}/{path}", encoding="utf-8") as file:
            same = file.read() == text
        if not same:
            with open(f"{tree}/{path}", "w", encoding="utf-8") as file:
                file.write(text)
    write_faults.written = list({fault.path for fault in faults.values()})


write_faults.written = []


def build(tree, folder, faults, targets, jobs):
    """Builds with all faults that compile; those that do not are taken out of `faults`."""
    while True:
        write_faults(tree, faults)
        done = subprocess.run(["ninja", "-C", folder, "-k", "0", f"-j{jobs}"] + targets, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode == 0:
            return
        bad = []
        # What errors name; only where these name no fault, what notes name.
        for pattern in (r"^(\S+?\.(?:cxx|h)):(\d+):\d+: (?:fatal )?error",
                        r"^(?:.*from )?(\S+?\.(?:cxx|h)):(\d+)[:,]"):
            places = {(os.path.relpath(os.path.join(folder, path), tree), int(line) - 1)
                      for path, line in re.findall(pattern, done.stdout, re.M)}
            bad = bad or [number for number, fault in faults.items() if (fault.path, fault.line) in places]
        if not bad:
            sys.exit(f"faults.py: the build fails apart from the faults:\n{done.stdout[-4000:]}")
        for number in bad:
            del faults[number]


def tests_of(folder):
    """name -> (command, environment, working folder) of the default tests of the modules."""
    listed = json.loads(subprocess.run(["ctest", "--test-dir", folder, "--show-only=json-v1"], check=True,
                                       stdout=subprocess.PIPE, text=True).stdout)
    tests = {}
    for test in listed["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        labels = properties.get("LABELS", [])
        if "command" in test and set(labels) & set(TESTED) and not any(LEFT_OUT.search(label) for label in labels):
            environment = dict(entry.split("=", 1) for entry in properties.get("ENVIRONMENT", []))
            tests[test["name"]] = (test["command"], environment, properties.get("WORKING_DIRECTORY", folder))
    return tests


def recorded_runs(tree, folder):
    """As tests_of(): the program's runs whose every output is recorded, each with those whose outputs it reads."""
    with open(f"{tree}/Testing/Results/runs.txt", encoding="utf-8") as file:
        runs = dict(line.split(None, 1) for line in file if line.strip() and not line.startswith("#"))

    def needed(name):
        return {name}.union(*(needed(earlier) for earlier in re.findall(r"\{p\}/([\w-]+)/", runs[name])))

    script = f"{tree}/Testing/Results/same_results.py"
    return {f"run {name}": ([sys.executable, script, f"{folder}/bin/voxelcore", tree, "--only",
                             ",".join(sorted(needed(name)))], {}, folder) for name in runs}


def run(test, limits, **more):
    """(passed, processor seconds) of one test; over the limits of processor and other seconds it has not passed."""
    command, environment, folder = test
    with tempfile.TemporaryDirectory() as temporary:
        # A fault may ask for memory without end.
        child = subprocess.Popen(["prlimit", f"--cpu={math.ceil(limits[0])}", f"--as={8 << 30}", "--"] + command,
                                 cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, start_new_session=True,
                                 env={**os.environ, **environment, "OMP_WAIT_POLICY": "passive", "TMPDIR": temporary,
                                      **more})
        end = threading.Timer(limits[1], os.killpg, (child.pid, 9))
        end.start()
        _, status, used = os.wait4(child.pid, 0)
        end.cancel()
        child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode == 0, used.ru_utime + used.ru_stime


def explained():
    """(path, line's text, what it became) -> why no test can notice."""
    known = {}
    with open(f"{os.path.dirname(os.path.abspath(__file__))}/explained.txt", encoding="utf-8") as file:
        for entry in file.read().split("\n\n"):
            lines = [line for line in entry.split("\n") if line and not line.startswith("#")]
            if len(lines) >= 4:
                known[lines[0], lines[1].strip(), lines[2].strip()] = " ".join(lines[3:])
    return known


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 30))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--modules", default=",".join(SEEDED))
    parser.add_argument("--results")
    parser.add_argument("--again")
    options = parser.parse_args()
    os.makedirs(options.build, exist_ok=True)
    folder = os.path.realpath(options.build)
    tree, binary = f"{folder}/tree", f"{folder}/build"
    earlier = []
    if options.again:
        with open(options.again, encoding="utf-8") as file:
            content = json.load(file)
        options.seed, earlier = content["seed"], content["faults"]
    print(f"seed {options.seed}", flush=True)

    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(SOURCE, tree, ignore=shutil.ignore_patterns("build", ".git"), symlinks=True)
    generator = random.Random(options.seed)
    every = candidates(options.modules.split(","))
    # A third more than asked for: some do not compile.
    faults = dict(enumerate(spread(every, options.count * 4 // 3 + 10, generator)))
    records = [record for record in earlier if record["noticed_by"]]
    if options.again:
        open_ones = {(record["path"], record["text"], record["before"], record["after"]) for record in earlier
                     if not record["noticed_by"]}
        faults = dict(enumerate(fault for fault in every
                                if (fault.path, fault.text, fault.before, fault.after) in open_ones))
    subprocess.run(["cmake", "-S", tree, "-B", binary, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                    "-DBUILD_TESTING=ON",
                    f"-DCMAKE_CXX_FLAGS=-include {tree}/Testing/Mutation/switch.h"], check=True,
                   stdout=subprocess.DEVNULL)
    targets = [f"VoxelCore{module}Tests" for module in TESTED] + ["voxelcore"]
    build(tree, binary, faults, targets, options.jobs)
    chosen = dict(list(faults.items())[:options.count])
    print(f"{len(every)} places; {len(chosen)} faults built in", flush=True)

    tests = {**tests_of(binary), **recorded_runs(tree, binary)}
    seconds, passing = {}, collections.defaultdict(list)

    def first(name):
        with tempfile.NamedTemporaryFile("r") as file:
            passed, taken = run(tests[name], (1800, 7200), VOXELCORE_FAULTS_REACHED=file.name)
            return name, passed, taken, {int(line) for line in file}

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name, passed, taken, reached in pool.map(first, tests):
            if not passed:
                print(f"{name} fails without any fault; left out", flush=True)
                continue
            seconds[name] = taken
            for number in reached:
                passing[number].append(name)

    def notice(number):
        for name in sorted(passing[number], key=seconds.get):
            if not run(tests[name], (2 + 10 * seconds[name], 60 + 100 * seconds[name]), VOXELCORE_FAULT=str(number))[0]:
                return number, name
        return number, None

    known = explained()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, name in pool.map(notice, chosen):
            fault = chosen[number]
            why = known.get((fault.path, fault.text, fault.after))
            records.append({**fault._asdict(), "line": fault.line + 1, "noticed_by": name,
                            "tests": len(passing[number]), "explained": why})
            if name is None:
                print(f"unnoticed ({len(passing[number])} tests come past): {fault.path}:{fault.line + 1}\n"
                      f"  {fault.text}\n  {fault.after}\n  {why or 'NOT EXPLAINED'}", flush=True)
            if options.results:
                with open(options.results, "w", encoding="utf-8") as file:
                    json.dump({"seed": options.seed, "places": len(every), "faults": records}, file, indent=1)

    print("| module | faults | noticed | explained |\n| --- | --- | --- | --- |")
    for module in options.modules.split(",") + ["all"]:
        of = [record for record in records if module == "all" or record["path"].split("/")[2] == module]
        noticed = sum(record["noticed_by"] is not None for record in of)
        print(f"| {module} | {len(of)} | {noticed} | "
              f"{sum(record['noticed_by'] is None and record['explained'] is not None for record in of)} |")
    missed = sum(record["noticed_by"] is None and record["explained"] is None for record in records)
    return 1 if missed > .03 * len(records) else 0


if __name__ == "__main__":
    sys.exit(main())
