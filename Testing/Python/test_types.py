"""The stubs say what the module has, and programs that use it by them pass mypy's strict rules."""

import os
import pathlib
import subprocess
import sys

import pytest
import voxelcore

PACKAGE = pathlib.Path(voxelcore.__file__).parent

PROGRAM = """
from typing import Any, Dict, List
import numpy
from numpy.typing import NDArray
import voxelcore

array = numpy.ones((9, 9, 3), numpy.uint8)
one: voxelcore.Core = voxelcore.core(array, spacing=(1, 1, 2), lambda_="1.5vox")
several: List[voxelcore.Core] = voxelcore.core(array, lambda_=[0, 1])
pruned: voxelcore.Core = one.prune(tolerance="1diag")
curve: voxelcore.Skeleton = one.skeleton(prune_branches=None)
table: Dict[str, NDArray[Any]] = curve.measure()
radii: NDArray[numpy.float64] = one.radius
curve.to_swc("out.swc", overwrite=True)
"""


def check(tmp_path, *arguments):
    settings = ["[mypy]", "ignore_missing_imports = True"]
    for private in PACKAGE.glob("_[a-z]*.py"):
        settings += [f"[mypy-voxelcore.{private.stem}]", "ignore_errors = True"]
    (tmp_path / "mypy.ini").write_text("\n".join(settings))
    environment = dict(os.environ, MYPYPATH=str(PACKAGE.parent), MYPY_CACHE_DIR=str(tmp_path / "cache"))
    return subprocess.run([sys.executable, "-m", *arguments], cwd=tmp_path, env=environment, capture_output=True,
                          text=True)  # fmt: skip


def test_the_stubs_fit_the_module(tmp_path):
    done = check(tmp_path, "mypy.stubtest", "voxelcore", "--mypy-config-file", "mypy.ini", "--ignore-missing-stub")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("wrong", ["", "\ncurve.to_swc(3)\n", "\nbad: int = one.radius\n"])
def test_programs_are_checked_by_the_stubs(tmp_path, wrong):
    (tmp_path / "program.py").write_text(PROGRAM + wrong)
    done = check(tmp_path, "mypy", "--config-file", "mypy.ini", "--strict", "program.py")
    assert (done.returncode == 0) == (wrong == ""), done.stdout + done.stderr
