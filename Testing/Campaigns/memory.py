"""Each command with less memory than it needs, at every 5 % of it: right exit code, one line, nothing half written.

usage: memory.py VOXELCORE [--totals FILE] [--commands a,b] [--threads N]

The commands are those of faults.py. What a command needs is found first, as address space (`ulimit -v`), to 1 %. Where
not even the dynamic linker finds room, or the system's own start of the program, nothing was begun and nothing may be
there. Exit 1: something was found."""

import argparse
import os
import shutil
import sys
import tempfile

from campaign import Totals, run
from faults import COMMANDS, Faults, SPEAKING


class Limits(Faults):
    def __init__(self, program, folder, totals, threads):
        super().__init__(program, "", folder, totals, threads)

    def attempt(self, name, limit=None, *_):
        shutil.rmtree(self.o, ignore_errors=True)
        os.mkdir(self.o)
        arguments = [a.format(i=self.i, o=self.o) for a in COMMANDS[name].split()]
        quiet = ["--progress", "none"] if name not in SPEAKING else []
        threads = [] if name in ("info", "info-tif", "phantom", "measure") else ["--threads", self.threads]
        less = ["prlimit", f"--as={limit}"] if limit else []
        code, self.out, said, _ = run([*less, self.program, *arguments, *quiet, *threads],
                                      {"OMP_NUM_THREADS": self.threads})
        return code, said, 0, 0

    def need(self, name):
        """The least address space with which the command succeeds."""
        low, high = 1 << 20, 16 << 30
        while high > 1.01 * low:
            middle = (low + high) // 2 if high < 2 * low else int((low * high) ** 0.5)
            if self.attempt(name, middle)[0] == 0:
                high = middle
            else:
                low = middle
        return high


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--totals")
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    totals = Totals(options.totals, f"memory, {options.threads} threads")
    before = len(totals.of["found"])
    with tempfile.TemporaryDirectory(prefix="voxelcore-memory-") as folder:
        limits = Limits(os.path.abspath(options.program), folder, totals, options.threads)
        for name in options.commands.split(","):
            if totals.place(name) == "done":
                continue
            expected = limits.reference(name)
            need = limits.need(name)
            began = False
            for percent in range(5, 101, 5):
                code, said, _, _ = limits.attempt(name, need * percent // 100)
                totals.ran()
                totals.count(f"exit {code}")
                # Until main is reached, the linker and the system speak for themselves; from there on, we do.
                began = began or said.startswith("voxelcore: ") or code == 0
                if began:
                    trouble = limits.wrong(name, code, said, expected)
                else:
                    trouble = f"not begun, but {os.listdir(limits.o)}" if os.listdir(limits.o) else None
                    totals.count("not begun")
                if trouble:
                    totals.found(f"{name} with {percent} % of {need >> 20} MB: {trouble}"[:600])
            totals.place(name, "done")
            totals.save()
            print(f"{name}: {need >> 20} MB", flush=True)
    print(f"{totals.of['runs']} runs, {totals.of['counts']}, {len(totals.of['found'])} found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
