"""One batch for hours over generated and real scans, while cases are killed and calls fail: its memory, descriptors and
processes are watched; what is left over is done by a second batch, and every result is that of an undisturbed one.

usage: soak.py VOXELCORE LAYER.so [--folder DIR] [--scans FOLDER] [--minutes M] [--cases N] [--totals FILE] [--seed S]

LAYER.so is FaultLayer.c, built as a library. --folder: where inputs and results are kept, so that a run that ends after
its --minutes, or by SIGTERM, goes on there; what is done by then is looked at. --scans: small real scans that go in
among the phantoms. --cases: as many as --minutes take by what the first cases took, unless said. Exit 1: something was
found."""

import argparse
import contextlib
import glob
import json
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
# One case of so many is killed; by the clock, a slow machine would kill nearly all of them.
KILLED = 13
# Times are in reports and records; the pages and tables are of all cases.
TIMED = ("_report.json", "_case.json", "_thumbnail.png")
# Of each further case the batch may keep its record: kB. What a leak of a buffer a case would take is far more.
KB_A_CASE = 8
WORDS = ["--jobs", str(JOBS), "--progress", "none"]


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


class Watch:
    """Follows a batch to its end or to an instant, and kills cases at random instants of their lives.
    seen: [(seconds, memory, descriptors)]."""

    def __init__(self, process, draw, totals):
        self.process, self.draw, self.totals = process, draw, totals
        self.seen, self.lives, self.born, self.doomed = [], [0.5], {}, {}

    def follow(self, until):
        began = saved = time.monotonic()
        while self.process.poll() is None and time.monotonic() < until:
            time.sleep(0.05)
            now, of = time.monotonic(), state(self.process)
            if of is None:
                continue
            self.seen.append((now - began, *of[:2]))
            if len(of[2]) > JOBS:
                self.totals.found(f"{len(of[2])} cases at a time, {JOBS} are asked for")
            self.cases(set(of[2]), now)
            if now > saved + 60:
                self.totals.count("minutes", (now - saved) / 60)
                saved = now
                self.totals.save()
        self.totals.count("minutes", (time.monotonic() - saved) / 60)

    def cases(self, alive, now):
        for pid in alive - set(self.born):
            self.born[pid] = now
            self.totals.count("cases begun")
            if self.draw.randrange(KILLED) == 0:
                mean = sum(self.lives[-100:]) / len(self.lives[-100:])
                self.doomed[pid] = now + self.draw.uniform(0, mean)
        for pid in set(self.born) - alive:
            self.lives.append(now - self.born.pop(pid))
            self.doomed.pop(pid, None)
        for pid in [pid for pid, instant in self.doomed.items() if instant <= now]:
            del self.doomed[pid]
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, self.draw.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGSEGV)))
                self.totals.count("cases killed")


def steady(watch, name, totals):
    """Says whether memory and descriptors of a batch stay what they are once the first minute has filled what is
    filled once."""
    seen = watch.seen
    if len(watch.lives) < 300:  # few cases say nothing of growth
        return
    settled = [entry for entry in seen if entry[0] > min(60, seen[-1][0] / 4)]
    memory, descriptors = [entry[1] for entry in settled], [entry[2] for entry in settled]
    tenth = max(1, len(settled) // 10)
    grown = sum(memory[-tenth:]) / tenth - sum(memory[:tenth]) / tenth
    if grown > KB_A_CASE * len(watch.lives) + 4096:
        totals.found(f"{name}: memory grows by {grown:.0f} kB over {len(watch.lives)} cases")
    first, last = max(descriptors[:tenth]), max(descriptors[-tenth:])
    if last > first + 2:
        totals.found(f"{name}: {first} descriptors, then {last}")
    print(f"{seen[-1][0] / 60:.1f} minutes, {len(watch.lives)} cases begun, memory {memory[0] / 1024:.1f} to "
          f"{memory[-1] / 1024:.1f} MB, at most {first}, then {last} descriptors", flush=True)


def prepared(program, folder, options):
    """Makes scans and links to them, unless they are there; the plan of the run."""
    place = f"{folder}/soak.json"
    if os.path.exists(place):
        with open(place, encoding="utf-8") as file:
            return json.load(file)
    for name in ("in", "cases", "first", "out"):
        shutil.rmtree(f"{folder}/{name}", ignore_errors=True)
        os.mkdir(f"{folder}/{name}")
    kinds = inputs(program, f"{folder}/in", options.scans)
    began = time.monotonic()
    checked([program, "batch", f"{folder}/in", "-o", f"{folder}/first", *WORDS], limit=3600)
    count = options.cases or int(60 * options.minutes * len(kinds) / (time.monotonic() - began))
    for number in range(count):
        kind = kinds[number % len(kinds)]
        os.symlink(f"{folder}/in/{kind}", f"{folder}/cases/{number:06d}{kind}")
    plan = {"count": count, "expected": of_cases(f"{folder}/first")}
    with open(place, "w", encoding="utf-8") as file:
        json.dump(plan, file)
    return plan


def wrong_results(folder, plan):
    """Cases that are done by their record and are not what an undisturbed batch makes; how many are done."""
    wrong, done = [], 0
    for case, files in of_cases(f"{folder}/out/b").items():
        with contextlib.suppress(FileNotFoundError):
            with open(f"{folder}/out/b/sub-{case}/sub-{case}_case.json", encoding="utf-8") as file:
                if json.load(file)["status"] == "done":
                    done += 1
                    if files != plan["expected"][case[6:]]:
                        wrong.append(case)
    return wrong, done


def watched(batch, environment, folder, plan, until, name, draw, totals):
    """A batch whose cases are killed, to its end or until then. Whether it has ended by itself."""
    nothing = subprocess.DEVNULL
    process = subprocess.Popen(batch, stdin=nothing, stdout=nothing, stderr=nothing,
                               env={**os.environ, **environment}, start_new_session=True)
    watch = Watch(process, draw, totals)
    try:
        watch.follow(until)
    finally:
        ended = process.poll() is not None
        if not ended:
            process.terminate()
            process.wait(60)
        time.sleep(0.5)
        if processes_of(process.pid):
            totals.found(f"{name}: processes are left: {processes_of(process.pid)}")
        if process.returncode not in ((0, 1, 3) if ended else (130,)):
            totals.found(f"{name}: the batch ends with {process.returncode}")
        steady(watch, name, totals)
        wrong, done = wrong_results(folder, plan)
        if wrong:
            totals.found(f"{name}: {wrong[:5]} differ")
        totals.save()
        print(f"{done} of {plan['count']} cases are done; {totals.of['counts']}", flush=True)
    return ended


def soak(program, layer, folder, options, totals):
    name = f"seed {options.seed}"
    draw = random.Random(options.seed)
    until = time.monotonic() + 60 * options.minutes if options.folder else float("inf")
    plan = prepared(program, folder, options)
    with open(f"{folder}/counter", "wb") as file:
        file.write(bytes(16))
    faults = {"LD_PRELOAD": layer, "FAULT_CALL": draw.choice(("read", "write", "open", "rename")),
              "FAULT_AT": str(draw.randrange(1, 40 * plan["count"])), "FAULT_PATHS": f"{folder}/out",
              "FAULT_ERROR": "5", "FAULT_COUNTER": f"{folder}/counter"}
    batch = [program, "batch", f"{folder}/cases", "-o", f"{folder}/out/b", *WORDS]
    # A record that cannot be written ends the first batch.
    for environment in (faults, {}):
        if not watched(batch, environment, folder, plan, until, name, draw, totals):
            return
    code, _, said, _ = run(batch, limit=36000)
    wrong, done = wrong_results(folder, plan)
    left = [file for file in digests(f"{folder}/out") if ".part-" in file or file.endswith(".lock")]
    if code != 0 or left or wrong or done != plan["count"]:
        totals.found(f"{name}: then again: exit {code}, {done} of {plan['count']} cases, {wrong[:5]} differ, "
                     f"{left[:5]} left: {said}"[:600])
    totals.count("cases", plan["count"])
    totals.ran()
    totals.save()
    os.remove(f"{folder}/soak.json")
    print(f"all cases done again: {totals.of['counts']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("layer")
    parser.add_argument("--folder")
    parser.add_argument("--scans")
    parser.add_argument("--minutes", type=float, default=360)
    parser.add_argument("--cases", type=int)
    parser.add_argument("--totals")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 30))
    options = parser.parse_args()
    if not os.path.exists(options.layer):  # the loader would pass over it
        parser.error(f"{options.layer} is not there")
    totals = Totals(options.totals, "soak")
    before = len(totals.of["found"])
    print("seed", options.seed, flush=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with contextlib.ExitStack() as stack:
        folder = options.folder or stack.enter_context(tempfile.TemporaryDirectory(prefix="voxelcore-soak-"))
        os.makedirs(folder, exist_ok=True)
        soak(os.path.abspath(options.program), os.path.abspath(options.layer), os.path.abspath(folder), options,
             totals)
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
