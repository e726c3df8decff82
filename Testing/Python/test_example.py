"""The example script draws a label of the JHU atlas."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

ATLAS = "/usr/share/mricron/templates/JHU-WhiteMatter-labels-2mm.nii.gz"
SCRIPT = pathlib.Path(__file__).parents[2] / "Applications/Python/examples/draw_core.py"


def test_the_script_draws_something(tmp_path):
    pytest.importorskip("nibabel")
    if not os.path.exists(ATLAS):
        pytest.skip("package mricron-data is not installed")
    if not (os.environ.get("DISPLAY") or shutil.which("xvfb-run")):
        pytest.skip("neither a display nor xvfb-run")
    display = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a"]
    picture = tmp_path / "label.png"
    done = subprocess.run(
        [*display, sys.executable, str(SCRIPT), ATLAS, "4", str(picture)], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert "voxelcore.Core of label 4" in done.stdout
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(str(picture))
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    drawn = (pixels != 255).any(axis=1).mean()
    assert 0.02 < drawn < 0.9
    if os.environ.get("VOXELCORE_KEEP_PICTURE"):
        shutil.copy(picture, os.environ["VOXELCORE_KEEP_PICTURE"])
