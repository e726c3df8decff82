"""An array of 512^3 voxels costs what the command line costs for the same scan, and one bit a voxel."""

import json
import os
import subprocess
import sys

import numpy
import pytest
from conftest import PROGRAM, write_nrrd

SIDE = 512
ONE_BIT_A_VOXEL = SIDE**3 / 8

# Prints by how many bytes the peak of memory rises while the core is computed; that of the array is there before.
COMPUTE = """
import sys, numpy, voxelcore
sys.path.insert(0, sys.argv[1])
from test_large import crossing_rods, peak
voxelcore.core(numpy.ones((9, 9, 3), bool))
array = crossing_rods(int(sys.argv[2]), sys.argv[3])
before = peak()
core = voxelcore.core(array, threads=1)
print(peak() - before, core.topology["betti"], len(core.vertices))
"""


def peak():
    """Bytes of this process's peak of memory so far. (What getrusage tells begins with the peak of the parent.)"""
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith("VmHWM:"))


def crossing_rods(side, order):
    """Rods that reach through the whole volume, so that no part of it can be left out; every page is touched."""
    array = numpy.empty((side, side, side), numpy.uint8, order=order)
    array[:] = 0
    width = 5 + numpy.arange(side) // 8 % 4
    for at in (side // 4, side // 2):
        for i in range(side):
            array[i, at : at + width[i], at : at + 6] = 1
            array[at : at + 6, i, at : at + width[i]] = 1
            array[at : at + width[i], at : at + 6, i] = 1
    return array


def peak_of_program(scan, out):
    """Bytes; of the process that computes the core of a scan."""
    report = out.with_suffix(".json")
    # Through a shell, which is small: see peak().
    words = [PROGRAM, "core", str(scan), "-o", str(out), "--threads", "1", "-q", "--report", str(report)]
    subprocess.run(["sh", "-c", '"$@"; exit $?', "sh", *words], check=True)
    return 1e6 * json.loads(report.read_text())["peak_memory_mb"]


@pytest.fixture(scope="module")
def program_needs(tmp_path_factory):
    """Bytes the command line needs for the scan beyond what it needs for a tiny one."""
    folder = tmp_path_factory.mktemp("scans")
    write_nrrd(folder / "tiny.nrrd", numpy.ones((9, 9, 3), numpy.uint8))
    write_nrrd(folder / "large.nrrd", crossing_rods(SIDE, "F"))
    needs = [peak_of_program(folder / f"{name}.nrrd", folder / f"{name}.vtp") for name in ("large", "tiny")]
    return needs[0] - needs[1]


@pytest.mark.parametrize("order", ["F", "C"])
def test_an_array_costs_one_bit_a_voxel_more_than_a_scan(program_needs, order):
    told = subprocess.run(
        [sys.executable, "-B", "-c", COMPUTE,
         os.path.dirname(__file__), str(SIDE), order],
        capture_output=True,
        text=True)
    assert told.returncode == 0, told.stderr
    print(f"order {order}: the command line {program_needs / 1e6:.1f} MB, Python {told.stdout.strip()}")
    assert 1e6 < float(told.stdout.split()[0]) <= program_needs + ONE_BIT_A_VOXEL
