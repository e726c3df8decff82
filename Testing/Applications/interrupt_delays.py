"""Sends Ctrl-C at random moments of long runs and prints how long each command took to end.

    interrupt_delays.py PROGRAM [SENDS [SEED]]

Fails where a run took a second or more, ended with another code than 130, or left anything behind.
"""

import os
import random
import signal
import subprocess
import sys
import tempfile
import time

WORST = 1.0  # seconds


def force(words):
    """Commands that write may write again."""
    return ["--force"] if "-o" in words else []


def prepare(program, folder):
    """Inputs, and each command's words."""
    def make(*words):
        subprocess.run([program, *words, "--quiet"], cwd=folder, check=True)

    make("phantom", "gyroid", "--size", "160", "-o", "g.nrrd")
    make("phantom", "root", "--size", "160", "-o", "r.nrrd")
    make("core", "g.nrrd", "--lambda", "0", "--keep-edges", "-o", "whole.vtp")
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    with open(os.path.join(folder, "mesh.off"), "w", encoding="ascii") as file:
        file.write("OFF\n8 12 0\n" + "".join("%d %d %d\n" % corner for corner in corners))
        file.writelines(f"3 {a} {b} {c}\n3 {a} {c} {d}\n" for a, b, c, d in sides)
    inputs = set(os.listdir(folder))
    return inputs, {
        "core": ["core", "g.nrrd", "-o", "out.vtp"],
        "core --tolerance": ["core", "g.nrrd", "--tolerance", "1.2diag", "-o", "out.vtp"],
        "core --refine": ["core", "g.nrrd", "--refine", "labels", "-o", "out.vtp"],
        "core --html": ["core", "r.nrrd", "--html", "out.html", "-o", "out.vtp"],
        "prune": ["prune", "whole.vtp", "--lambda", "1.5vox,2vox", "-o", "out.vtp"],
        "skeleton": ["skeleton", "g.nrrd", "-o", "out.vtp", "--also", "csv,swc"],
        "verify": ["verify", "g.nrrd", "whole.vtp"],
        "voxelize": ["voxelize", "mesh.off", "--resolution", "500", "-o", "out.mhd"],
        "info": ["info", "g.nrrd"],
        "phantom": ["phantom", "gyroid", "--size", "320", "-o", "out.mhd"],
    }


def main():
    program = os.path.abspath(sys.argv[1])
    sends = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.SystemRandom().randrange(1 << 32)
    chance = random.Random(seed)
    print(f"seed {seed}; a row a command: length of the run, worst and mean delay in s, runs that were interrupted")
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        inputs, commands = prepare(program, folder)
        for name, words in commands.items():
            began = time.monotonic()
            done = subprocess.run([program, *words, *force(words), "--quiet"],
                                  cwd=folder,
                                  capture_output=True,
                                  text=True)
            length = time.monotonic() - began
            if done.returncode not in (0, 4):
                failures.append(f"{name}: {done.stderr.strip()}")
            delays = []
            for _ in range(sends):
                for left in set(os.listdir(folder)) - inputs:
                    os.remove(os.path.join(folder, left))
                process = subprocess.Popen([program, *words, "--quiet"], cwd=folder, stderr=subprocess.PIPE, text=True)
                time.sleep(0.1 + chance.random() * length)
                running = process.poll() is None
                process.send_signal(signal.SIGINT)
                sent = time.monotonic()
                _, error = process.communicate()
                if running and process.returncode == 130:
                    delays.append(time.monotonic() - sent)
                    left = set(os.listdir(folder)) - inputs
                    if left and "complete" not in error:
                        failures.append(f"{name}: left {sorted(left)}")
                elif process.returncode not in (0, 4):
                    failures.append(f"{name}: exit code {process.returncode}: {error.strip()}")
            worst, mean = (max(delays), sum(delays) / len(delays)) if delays else (0, 0)
            print(f"{name:15} {length:7.2f} {worst:7.3f} {mean:7.3f} {len(delays):4}", flush=True)
            if worst >= WORST:
                failures.append(f"{name}: {worst:.2f} s after Ctrl-C")
    print("\n".join(failures) or "all within a second")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
