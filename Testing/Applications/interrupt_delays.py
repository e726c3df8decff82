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


def prepare(program, folder):
    """Inputs, and each command's words."""
    def make(*words):
        subprocess.run([program, *words, "--quiet"], cwd=folder, check=True)

    make("phantom", "gyroid", "--size", "160", "-o", "g.nrrd")
    make("phantom", "root", "--size", "160", "-o", "r.nrrd")
    make("core", "g.nrrd", "--lambda", "0", "--keep-edges", "-o", "whole.vtp")
    make("core", "g.nrrd", "--triangles", "-o", "mesh.stl")
    inputs = set(os.listdir(folder))
    return inputs, {
        "core": ["core", "g.nrrd", "-o", "out.vtp"],
        "core --bumps": ["core", "g.nrrd", "--bumps", "1.2diag", "-o", "out.vtp"],
        "core --refine": ["core", "g.nrrd", "--refine", "labels", "-o", "out.vtp"],
        "core --html": ["core", "r.nrrd", "--html", "out.html", "-o", "out.vtp"],
        "prune": ["prune", "whole.vtp", "--lambda", "1.5vox,2vox", "-o", "out.vtp"],
        "skeleton": ["skeleton", "g.nrrd", "-o", "out.vtp", "--also", "csv,swc"],
        "verify": ["verify", "g.nrrd", "whole.vtp"],
        "voxelize": ["voxelize", "mesh.stl", "--resolution", "400", "-o", "out.mhd"],
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
            done = subprocess.run([program, *words, "--force", "--quiet"], cwd=folder, capture_output=True, text=True)
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
