"""Every call of a run of each command fails once: is the exit code right, is there one clear line, is nothing left half
written?

usage: faults.py VOXELCORE LAYER.so [--totals FILE] [--minutes M] [--commands a,b] [--step N] [--most N] [--kind K]
       [--threads N] [--size S]

LAYER.so is FaultLayer.c, built as a library. --step N: only each N-th call, --most N: no more than N of a kind,
--kind K: only those (o-open, say: opening files of results), for a quick look. --threads N: which thread meets a fault
is then chance, and what may be there is the same. --size S: side of the scans (12); most loops share their work among
threads from sides of some 40 on. Exit 1: something was found."""

import argparse
import errno
import os
import shutil
import struct
import sys
import tempfile
import time
import zlib

from campaign import Totals, checked, digests, run

# Name, arguments; {i} is the folder of inputs, {o} that of results.
COMMANDS = {
    "core": "core {i}/scan.nrrd -o {o}/a.vtp --report {o}/a.json --table {o}/a.csv --with-skeleton",
    "core-folder": "core {i}/labels.nii.gz -o {o}/d/ --lambda 0,1vox --keep-edges",
    "core-refined": "core {i}/labels.nii.gz -o {o}/d/ --with-skeleton",
    "core-vtk": "core {i}/scan.mha -o {o}/a.vtk --lambda 0",
    "core-ply": "core {i}/scan.tif --spacing 1,1,1 -o {o}/a.ply --lambda 0",
    "core-mhd": "core {i}/scan.mhd -o {o}/a.vtp --lambda 0",
    "core-obj": "core {i}/scan.nrrd -o {o}/a.obj --lambda 0",
    "core-stl": "core {i}/scan.nrrd -o {o}/a.stl --lambda 0",
    "core-ma": "core {i}/scan.nrrd -o {o}/a.ma --lambda 0",
    "core-slices": "core {i}/slices --spacing 1,1,1 -o {o}/a.vtp",
    "core-mesh": "core {i}/mesh.off --resolution 10 -o {o}/a.vtp",
    "skeleton": "skeleton {i}/scan.nrrd -o {o}/s.vtp --also csv,swc,mrk.json,graphml,ma --report {o}/s.json",
    "skeleton-core": "skeleton {i}/core.vtp -o {o}/s.vtp",
    "measure": "measure {i}/core_skeleton.vtp -o {o}/m.csv",
    "prune": "prune {i}/core.vtp --lambda 1vox,2vox -o {o}/p.vtp",
    "verify": "verify {i}/scan.nrrd {i}/core.vtp",
    "info": "info {i}/scan.nrrd",
    "info-tif": "info {i}/scan.tif --spacing 1,1,1",
    "thickness": "thickness {i}/scan.nrrd -o {o}/t.nii.gz --table {o}/t.csv",
    "sheets": "sheets {i}/scan.nrrd -o {o}/s.vtp --table {o}/s.csv --graph {o}/s.graphml --voxels {o}/v.nrrd",
    "reconstruct": "reconstruct {i}/core.vtp -o {o}/r.mha --scan {i}/scan.nrrd --report {o}/r.json",
    "voxelize": "voxelize {i}/mesh.off --resolution 10 -o {o}/v.tif",
    "phantom": "phantom torus --size 12 -o {o}/p.mhd",
    "block": "core {i}/scan.nrrd --blocks 2 --block 1 -o {o}/parts/",
    "join": "core {i}/scan.nrrd --join {i}/parts -o {o}/j.vtp",
    "roots": "roots {i}/root.nrrd -o {o}/roots/",
    "render": "render {i}/core.vtp -o {o}/r.png --size 64x64",
    "html": "core {i}/scan.nrrd -o {o}/a.vtp --html {o}/a.html",
    "batch": "batch {i}/cases -o {o}/b --jobs 1",
}

# Their results are what they say.
SPEAKING = ("verify", "info", "info-tif")

# Where, kind of call, error; exit: a library ends the program in that call, with that code.
KINDS = [("o", "open", errno.EACCES), ("o", "write", errno.ENOSPC), ("o", "write", errno.EIO), ("o", "write", 0),
         ("o", "close", errno.EIO), ("o", "rename", errno.EACCES), ("o", "mkdir", errno.EACCES),
         ("o", "read", errno.EIO), ("o", "sync", errno.EIO), ("o", "map", errno.ENOMEM),
         ("i", "open", errno.EACCES), ("i", "read", errno.EIO), ("i", "read", 0), ("i", "map", errno.ENOMEM),
         ("-", "memory", errno.ENOMEM), ("o", "exit", 2), ("o", "exit", 0)]


def make_png(path, rows):
    """8 bits grey."""
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" 
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))) + chunk(b"IEND", b""))


def inputs(program, folder, size=12):
    def make(*arguments):
        checked([program, *arguments, "-q"])

    path = lambda name: os.path.join(folder, name)
    for name in ("scan.nrrd", "scan.mha", "scan.mhd", "scan.tif", "labels.nii.gz"):
        make("phantom", "torus", "--size", str(size), "-o", path(name))
    make("phantom", "root", "--size", str(2 * size), "-o", path("root.nrrd"))
    make("core", path("scan.nrrd"), "--lambda", "0", "--keep-edges", "-o", path("core.vtp"), "--with-skeleton")
    with open(path("mesh.off"), "w") as file:
        file.write("OFF\n8 6 0\n" + "".join(f"{x} {y} {z}\n" for z in (0, 3) for y in (0, 4) for x in (0, 5))
                   + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n")
    os.mkdir(path("slices"))
    for k in range(6):
        make_png(path(f"slices/s{k}.png"), [[255 if 0 < k < 5 and 1 <= x < 5 and 1 <= y < 5 else 0 for x in range(6)]
                                            for y in range(6)])
    os.mkdir(path("cases"))
    make("phantom", "ellipsoid", "--size", "8", "-o", path("cases/a.nrrd"))
    make("phantom", "torus", "--size", "10", "-o", path("cases/b.nrrd"))
    for block in ("1", "2"):
        make("core", path("scan.nrrd"), "--blocks", "2", "--block", block, "-o", path("parts/"))


class Faults:
    def __init__(self, program, layer, folder, totals, threads=1, size=12):
        self.program, self.layer, self.totals, self.threads = program, layer, totals, str(threads)
        self.i, self.o = os.path.join(folder, "in"), os.path.join(folder, "out")
        self.counter = os.path.join(folder, "counter")
        self.out = ""
        os.mkdir(self.i)
        inputs(program, self.i, size)

    def attempt(self, name, where="o", kind="none", error=0, at=0):
        shutil.rmtree(self.o, ignore_errors=True)
        os.mkdir(self.o)
        with open(self.counter, "wb") as file:
            file.write(bytes(16))
        arguments = [a.format(i=self.i, o=self.o) for a in COMMANDS[name].split()]
        quiet = ["--progress", "none"] if name not in SPEAKING else []
        environment = {"LD_PRELOAD": self.layer, "FAULT_CALL": kind, "FAULT_AT": str(at), "FAULT_ERROR": str(error),
                       "FAULT_PATHS": {"i": self.i, "o": self.o}.get(where, "/nowhere"), "FAULT_COUNTER": self.counter,
                       "FAULT_SIZE": "65536" if kind == "memory" else "1000000000000",
                       "OMP_NUM_THREADS": self.threads}
        threads = [] if name in ("info", "info-tif", "phantom", "measure") else ["--threads", self.threads]
        code, self.out, said, _ = run([self.program, *arguments, *quiet, *threads], environment)
        with open(self.counter, "rb") as file:
            calls, failed = struct.unpack("<QQ", file.read(16))
        return code, said, calls, failed

    def reference(self, name):
        """What the command writes, and which of that is always the same. What `verify` and `info` say counts as a
        file, too."""
        results = []
        for _ in range(2):
            code, said, _, _ = self.attempt(name)
            if code != 0:
                raise SystemExit(f"{name}: exit {code}: {said}")
            results.append(self.results(name))
        return {key: value if results[1].get(key) == value and not self.holds_times(key) else None
                for key, value in results[0].items()}

    def holds_times(self, name):
        """Whether a result is a report: two of them may say the same times by chance."""
        if not name.endswith(".json"):
            return False
        with open(os.path.join(self.o, name), encoding="utf-8") as file:
            return '"seconds"' in file.read()

    def results(self, name):
        return {**digests(self.o), **({"stdout": self.out} if name in SPEAKING and self.out else {})}

    def wrong(self, name, code, said, expected):
        """What is wrong with what a run left; None: nothing."""
        left = self.results(name)
        lines = [line for line in said.split("\n") if line]
        if code is None:
            return "it hangs"
        if code < 0:
            return f"signal {-code}"
        if any(".part-" in key for key in left) or any(".part-" in d for w, ds, _ in os.walk(self.o) for d in ds):
            return f"a temporary file is left: {sorted(key for key in left if '.part-' in key)}"
        if code == 0:
            missing = [key for key in expected if key not in left]
            differs = [key for key, value in expected.items() if value and left.get(key, value) != value]
            return f"exit 0, but {missing} are missing and {differs} differ" if missing or differs else None
        if code not in (1, 3):
            return f"exit {code}: {said!r}"
        if name == "batch":
            # Cases that were done are whole; what a broken one left is none of its results.
            bad = [key for key, value in left.items() if key in expected and expected[key] and value != expected[key]
                   and key.endswith((".vtp", ".vtk"))]
            return f"exit {code}, but {bad} differ" if bad else None if lines else "it says nothing"
        if len(lines) != 1 or not lines[0].startswith("voxelcore: "):
            return f"exit {code}, but not one line: {said!r}"
        if "terminate" in said or "std::" in said or "basic_" in said:
            return f"exit {code}, but no user understands {said!r}"
        # Into folders, each result that is there is whole and stays: the same command goes on from there.
        left.pop("stdout", None)
        stay = name in ("core-folder", "core-refined", "block")
        bad = [key for key, value in left.items()
               if not (stay and (key.endswith("_finished.jsonl") or expected.get(key) == value))]
        return f"exit {code}, but there is {sorted(bad)}" if bad else None

    @staticmethod
    def chosen(calls, step):
        """Which calls fail. Of more than 200 (writes into a buffer, mostly, which the system sees by the megabyte) the
        first 100, the last 20, and others spread evenly."""
        if calls <= 200:
            return range(1, calls + 1, step)
        return sorted({*range(1, 101), *range(calls - 19, calls + 1), *range(101, calls - 19, (calls - 120) // 80 + 1)}
                      )[::step]

    def go(self, names, kinds, step, most, until):
        for name in names:
            expected = self.reference(name)
            for where, kind, error in kinds:
                key = f"{name} {where} {kind} {error}"
                if self.totals.place(key) == "done":
                    continue
                _, _, calls, _ = self.attempt(name, where, kind, error)
                for at in list(self.chosen(calls, step))[:most]:
                    if at <= self.totals.place(key):
                        continue
                    if time.monotonic() > until:
                        self.totals.save()
                        return False
                    code, said, _, failed = self.attempt(name, where, kind, error, at)
                    self.totals.ran()
                    self.totals.count("faults that struck", failed)
                    self.totals.count(f"exit {code}")
                    trouble = self.wrong(name, code, said, expected)
                    if trouble:
                        self.totals.found(f"{key} at {at}: {trouble}")
                    self.totals.place(key, at)
                self.totals.place(key, "done")
                self.totals.save()
        return True


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("layer")
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--step", type=int, default=1)
    parser.add_argument("--most", type=int, default=10**9)
    parser.add_argument("--kind")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--size", type=int, default=12)
    options = parser.parse_args()
    of = "" if (options.threads, options.size) == (1, 12) else f", {options.threads} threads, side {options.size}"
    totals = Totals(options.totals, "faults" + of)
    before = len(totals.of["found"])
    with tempfile.TemporaryDirectory(prefix="voxelcore-faults-") as folder:
        kinds = [kind for kind in KINDS if options.kind in (None, f"{kind[0]}-{kind[1]}")]
        faults = Faults(os.path.abspath(options.program), os.path.abspath(options.layer), folder, totals,
                        options.threads, options.size)
        ended = faults.go(options.commands.split(","), kinds, options.step, options.most,
                          time.monotonic() + 60 * options.minutes)
    totals.save()
    print(f"{totals.of['runs']} runs, {totals.of['counts']}, {len(totals.of['found'])} found"
          + ("" if ended else "; not at the end"))
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
