"""Ctrl-C ends every call soon, whatever the call does, and leaves nothing half done."""

import os
import random
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest
import voxelcore

SOON = 1.0  # seconds, for which the machine may be busy with other things, too

PREPARE = """
import os, signal, sys, time, numpy, voxelcore
side = 110
needs_core = ("skeleton", "prune", "save", "read", "verify")
array = numpy.random.default_rng(1).random((side, side, side)) < 0.7
core = voxelcore.core(array[:70, :70, :70], lambda_=0) if sys.argv[1] in needs_core else None
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
    "thickness": lambda: voxelcore.thickness(array),
    "sheets": lambda: voxelcore.sheets(array),
    "verify": lambda: core.verify(array[:70, :70, :70]),
}[sys.argv[1]]
print("go", flush=True)
try:
    while True:
        work()
except KeyboardInterrupt:
    print("stopped", time.clock_gettime(time.CLOCK_MONOTONIC), flush=True)
    print(sorted(os.listdir(".")), flush=True)
"""


WORKS = ["core", "tolerance", "skeleton", "prune", "save", "read", "of array", "thickness", "sheets", "verify"]


@pytest.mark.parametrize("work", WORKS)
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


def test_other_threads_run_while_a_call_works():
    array = numpy.random.default_rng(1).random((44, 44, 44)) < 0.7
    for work in (voxelcore.core, voxelcore.skeleton, voxelcore.thickness):
        turns, done = [], threading.Event()
        thread = threading.Thread(target=lambda: (work(array), done.set()))
        thread.start()
        while not done.wait(0.01):
            turns.append(time.monotonic())
        thread.join()
        # Had the lock been held for the work, there would be one long gap.
        assert len(turns) > 10 and max(numpy.diff(turns)) < 0.5 * (turns[-1] - turns[0])


@pytest.mark.parametrize("work", ["core", "skeleton", "thickness", "sheets", "verify", "prune"])
def test_progress_rises_to_one_and_names_its_stages(work):
    array = numpy.random.default_rng(1).random((44, 44, 44)) < 0.7
    core = voxelcore.core(array, lambda_=0)
    told = []
    arguments = dict(progress=lambda stage, done: told.append((stage, done)))
    if work == "verify":
        assert voxelcore.verify(core, array, **arguments).passed
    elif work == "prune":
        voxelcore.prune(core, "2vox", **arguments)
    else:
        getattr(voxelcore, work)(array, **arguments)
    assert all(isinstance(stage, str) and isinstance(done, float) for stage, done in told)
    fractions = [done for _, done in told]
    assert fractions == sorted(fractions) and fractions[-1] == 1 and fractions.count(1) == 1
