"""Ctrl-C ends every call soon, whatever the call does, and leaves nothing half done."""

import os
import random
import signal
import subprocess
import sys
import time

import pytest

SOON = 1.0  # seconds, for which the machine may be busy with other things, too

PREPARE = """
import os, signal, sys, time, numpy, voxelcore
side = 110
array = numpy.random.default_rng(1).random((side, side, side)) < 0.7
core = voxelcore.core(array[:70, :70, :70], lambda_=0) if sys.argv[1] in ("skeleton", "prune", "save", "read") else None
os.chdir(sys.argv[2])
if sys.argv[1] == "read":
    core.save("core.vtp", keep_edges=True)
work = {
    "core": lambda: voxelcore.core(array),
    "tolerance": lambda: voxelcore.core(array, tolerance="1diag"),
    "skeleton": lambda: core.skeleton(),
    "prune": lambda: core.prune([1, 1.5, 2, 2.5, 3, 3.5]),
    "save": lambda: core.save("out.vtp", keep_edges=True, overwrite=True),
    "read": lambda: voxelcore.read("core.vtp"),
    "of array": lambda: voxelcore.skeleton(array),
}[sys.argv[1]]
print("go", flush=True)
try:
    while True:
        work()
except KeyboardInterrupt:
    print("stopped", time.clock_gettime(time.CLOCK_MONOTONIC), flush=True)
    print(sorted(os.listdir(".")), flush=True)
"""


@pytest.mark.parametrize("work", ["core", "tolerance", "skeleton", "prune", "save", "read", "of array"])
def test_ctrl_c_at_any_moment_stops_a_call_soon(tmp_path, work):
    seed = random.SystemRandom().randrange(1 << 32)
    wait = random.Random(seed).uniform(0.05, 2)
    print(f"seed {seed}: after {wait:.3f} s")
    words = [sys.executable, "-B", "-c", PREPARE, work, str(tmp_path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "go\n"
        time.sleep(wait)
        child.send_signal(signal.SIGINT)
        sent = time.clock_gettime(time.CLOCK_MONOTONIC)
        output, errors = child.communicate(timeout=60)
    assert child.returncode == 0, errors
    lines = output.splitlines()
    print(f"delay {float(lines[0].split()[1]) - sent:.3f} s")
    assert lines[0].startswith("stopped ") and float(lines[0].split()[1]) - sent < SOON
    left = set(os.listdir(tmp_path))
    assert left <= {"core.vtp", "out.vtp"
                    }, "what was not finished when the call ended is gone when the process has ended"


# The listener blocks the thread that waits, not the work; an error in it is as good as Ctrl-C.
LEFT_BEHIND = """
import numpy, os, sys, voxelcore
array = numpy.random.default_rng(1).random((60, 60, 60)) < 0.7
def refuse(stage, done):
    raise KeyError("enough")
for _ in range(3):
    try:
        voxelcore.core(array, progress=refuse)
    except KeyError:
        print("refused", flush=True)
copy = array.copy()
del array
assert len(voxelcore.core(copy).vertices) > 0
print("done", flush=True)
"""


def test_work_that_was_stopped_disturbs_nothing_that_comes_later():
    done = subprocess.run([sys.executable, "-B", "-c", LEFT_BEHIND], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (0, "refused\n" * 3 + "done\n"), done.stderr
