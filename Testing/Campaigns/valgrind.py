"""Every command once under valgrind's memcheck: no byte is read that nobody wrote, none outside of what was asked for.

usage: valgrind.py VOXELCORE [--commands a,b]      exit 1: something was found; 77: there is no valgrind

The commands are those of faults.py, by default without `roots` and `render`, in which VTK, FreeType and the linker read
what nobody wrote, and `batch`, whose calls to start a case valgrind does not know."""

import argparse
import os
import re
import shutil
import sys
import tempfile

from campaign import run
from faults import COMMANDS, inputs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    usual = [name for name in COMMANDS if name not in ("roots", "render", "batch")]
    parser.add_argument("--commands", default=",".join(usual))
    options = parser.parse_args()
    if shutil.which("valgrind") is None:
        sys.exit(77)
    found = 0
    with tempfile.TemporaryDirectory(prefix="voxelcore-valgrind-") as folder:
        program, log = os.path.abspath(options.program), os.path.join(folder, "log")
        i, o = os.path.join(folder, "in"), os.path.join(folder, "out")
        os.mkdir(i)
        inputs(program, i)
        for name in options.commands.split(","):
            shutil.rmtree(o, ignore_errors=True)
            os.mkdir(o)
            arguments = [a.format(i=i, o=o) for a in COMMANDS[name].split()]
            code, _, said, seconds = run(
                ["valgrind", "-q", "--num-callers=40", "--trace-children=yes", "--trace-children-skip=*Xvfb*,*/sh",
                 f"--log-file={log}-{name}-%p", program, *arguments], {"OMP_NUM_THREADS": "2"}, limit=3600)
            reports = []
            for path in sorted(os.listdir(folder)):
                if path.startswith(f"log-{name}-"):
                    with open(os.path.join(folder, path), encoding="utf-8", errors="replace") as file:
                        reports += re.split(r"\n==\d+== *\n", file.read())
            ours = [report for report in reports if "voxelcore::" in report or "in /" not in report and report.strip()]
            print(f"{name}: exit {code}, {seconds:.0f} s, {len(ours)} errors", flush=True)
            if ours or code != 0:
                found += 1
                print(said + "\n".join(ours[:5])[:6000], flush=True)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
