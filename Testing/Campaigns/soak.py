"""One batch for hours over generated and real scans, while cases are killed and calls fail: its memory, descriptors and
processes are watched; what is left over is done by a second batch, and every result is that of an undisturbed one.

usage: soak.py VOXELCORE LAYER.so [--scans FOLDER] [--minutes M] [--cases N] [--totals FILE] [--seed S]

LAYER.so is FaultLayer.c, built as a library. --scans: small real scans that go in among the phantoms. --cases: as many
as --minutes take by what the first cases took, unless said. Exit 1: something was found."""

import argparse
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from campaign import Totals, checked, digests, run

JOBS = 2
# Times are in reports and records; the pages and tables are of all cases.
TIMED = ("_report.json", "_case.json", "_thumbnail.png")
# Of each further case the batch may keep its record: kB. What a leak of a buffer a case would take is far more.
KB_A_CASE = 8


def inputs(program, folder, scans):
    """Names of whole scans in a folder, one of each kind."""
    for number, words in enumerate(("torus --size 24", "ellipsoid --size 20", "root --size 40", "gyroid --size 16",
                                    "porous --size 16", "root --size 32 --spacing 1,1,2")):
        checked([program, "phantom", *words.split(), "-o", f"{folder}/p{number}.nrrd", "-q"])
    for path in sorted(glob.glob(f"{scans}/*.n*")) if scans else []:
        # The endings of compressed scans are two.
        name = os.path.basename(path)
        shutil.copy(path, f"{folder}/r{len(os.listdir(folder))}{name[name.index('.'):]}")
    return sorted(os.listdir(folder))


def state(process):
    """Memory in kB and open descriptors of a process, and its children; None where it has ended."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as file:
            memory = [int(line.split()[1]) for line in file if line.startswith("VmRSS")]
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="utf-8") as file:
            children = [int(word) for word in file.read().split()]
        return (memory[0], len(os.listdir(f"/proc/{process.pid}/fd")), children) if memory else None
    except (FileNotFoundError, ProcessLookupError):
        return None


def of_cases(folder):
    """case -> digests of its files that hold no times."""
    found = {}
    for name, value in digests(folder).items():
        if name.startswith("sub-") and not name.endswith(TIMED):
            case, file = name.split("/", 1)
            found.setdefault(case[4:], {})[file.replace(case, "")] = value
    return found


def processes_of(session):
    """Processes of a session that are alive."""
    alive = []
    for place in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(place, encoding="utf-8") as file:
                words = file.read().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):
            continue
        if int(words[3]) == session and words[0] != "Z":
            alive.append(int(place.split("/")[2]))
    return alive


def watch(process, draw, totals):
    """Watches a batch to its end, and kills a case every few seconds. [(seconds, memory, descriptors)]."""
    seen, began, following = [], time.monotonic(), 5
    while process.poll() is None:
        time.sleep(0.2)
        now = state(process)
        if now is None:
            continue
        seen.append((time.monotonic() - began, *now[:2]))
        if len(now[2]) > JOBS:
            totals.found(f"{len(now[2])} cases at a time, {JOBS} are asked for")
        if seen[-1][0] > following and now[2]:
            following = seen[-1][0] + draw.expovariate(1 / 5)
            try:
                os.kill(draw.choice(now[2]), draw.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGSEGV)))
                totals.count("cases killed")
            except ProcessLookupError:
                pass
    return seen


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("layer")
    parser.add_argument("--scans")
    parser.add_argument("--minutes", type=float, default=360)
    parser.add_argument("--cases", type=int)
    parser.add_argument("--totals")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 30))
    options = parser.parse_args()
    program, layer = os.path.abspath(options.program), os.path.abspath(options.layer)
    totals = Totals(options.totals, "soak")
    before = len(totals.of["found"])
    draw = random.Random(options.seed)
    print("seed", options.seed, flush=True)
    with tempfile.TemporaryDirectory(prefix="voxelcore-soak-") as folder:
        i, cases, o, counter = (os.path.join(folder, name) for name in ("in", "cases", "out", "counter"))
        os.mkdir(i)
        kinds = inputs(program, i, options.scans)
        words = ["--jobs", str(JOBS), "--progress", "none"]
        began = time.monotonic()
        checked([program, "batch", i, "-o", o, *words], limit=3600)
        expected = of_cases(o)
        count = options.cases or int(60 * options.minutes * len(kinds) / (time.monotonic() - began))
        shutil.rmtree(o)
        os.mkdir(cases)
        for number in range(count):
            kind = kinds[number % len(kinds)]
            os.symlink(f"{i}/{kind}", f"{cases}/{number:06d}{kind}")
        with open(counter, "wb") as file:
            file.write(bytes(16))
        call = draw.choice(("read", "write", "open", "rename"))
        faults = {"LD_PRELOAD": layer, "FAULT_CALL": call, "FAULT_AT": str(draw.randrange(1, 40 * count)),
                  "FAULT_PATHS": o, "FAULT_ERROR": "5", "FAULT_COUNTER": counter}
        batch = [program, "batch", cases, "-o", f"{o}/b", *words]
        os.mkdir(o)
        nothing = subprocess.DEVNULL
        process = subprocess.Popen(batch, stdin=nothing, stdout=nothing, stderr=nothing,
                                   env={**os.environ, **faults}, start_new_session=True)
        seen = watch(process, draw, totals)
        time.sleep(0.5)
        # The first minute fills what is filled once.
        settled = [entry for entry in seen if entry[0] > min(60, seen[-1][0] / 4)]
        memory, descriptors = [entry[1] for entry in settled], [entry[2] for entry in settled]
        tenth = max(1, len(settled) // 10)
        grown = sum(memory[-tenth:]) / tenth - sum(memory[:tenth]) / tenth
        if grown > KB_A_CASE * count + 4096:
            totals.found(f"seed {options.seed}: memory grows by {grown:.0f} kB over {count} cases")
        first, last = max(descriptors[:tenth]), max(descriptors[-tenth:])
        if last > first + 2:
            totals.found(f"seed {options.seed}: {first} descriptors, then {last}")
        if processes_of(process.pid):
            totals.found(f"seed {options.seed}: processes are left: {processes_of(process.pid)}")
        if process.returncode not in (0, 1, 3):
            totals.found(f"seed {options.seed}: the batch ends with {process.returncode}")
        totals.count("minutes", seen[-1][0] / 60)
        totals.count("cases", count)
        code, _, said, _ = run(batch, limit=36000)
        results = of_cases(f"{o}/b")
        left = [name for name in digests(o) if ".part-" in name or name.endswith(".lock")]
        wrong = [case for case, files in results.items() if files != expected[case[6:]]]
        if code != 0 or left or wrong or len(results) != count:
            totals.found(f"seed {options.seed}: then again: exit {code}, {len(results)} of {count} cases, "
                         f"{wrong[:5]} differ, {left[:5]} left: {said}"[:600])
        totals.ran()
        totals.save()
        print(f"{count} cases, {seen[-1][0] / 60:.1f} minutes, memory {memory[0] / 1024:.1f} to "
              f"{memory[-1] / 1024:.1f} MB, at most {first}, then {last} descriptors, one {call} failed; "
              f"{totals.of['counts']}")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
