"""The Slicer module on real scans and with every preset; minutes, so that the default run leaves it out."""

import time

import numpy
import pytest
import slicer
from conftest import (
    EVERYTHING,
    EXACT,
    compute,
    data,
    lpsPoints,
    phantom,
    pointsOf,
    readLabels,
    roles,
    run,
    segmentationOf,
)
from VoxelCoreLib import Volumes
from VoxelCoreLib.Computation import Computation
from VoxelCoreLib.Settings import PRESETS


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_run_on_what_they_are_for(preset, backend, tmp_path):
    kind = {"Root": "root", "Vessel": "root", "Bone": "gyroid", "Brain": "tanglecube"}.get(preset, "torus")
    voxels, matrix = phantom(tmp_path, kind, 40)
    settings = PRESETS[preset][1]
    nodes = roles(compute(segmentationOf(voxels, matrix), settings, backend))
    assert ("surface" in nodes, "skeleton" in nodes, "thickness" in nodes) == (
        settings.surface, settings.skeleton, settings.thickness)
    row = nodes["summary"][0].GetTable().GetRow(0)
    assert row.GetValue(0).ToString() == "part 1" and row.GetValue(1).ToInt() >= (voxels > 0).sum()


def test_cancel_is_quick(backend, tmp_path):
    voxels, matrix = phantom(tmp_path, "gyroid", 128)
    computation = Computation(
        segmentationOf(voxels, matrix), ["Segment_1"], EVERYTHING, backend, slicer.app.temporaryPath
    )
    while computation.fraction < 0.01:
        assert not computation.poll()
        time.sleep(0.02)
    start = time.monotonic()
    computation.cancel()
    assert time.monotonic() - start < 2.5


SCANS = [
    ("AIM-Harvard+pyradiomics", "brain1_label.nrrd"),
    ("AIM-Harvard+pyradiomics", "lung2_label.nrrd"),
    ("QIICR+dcmqi", "liver_seg.nrrd"),
]


@pytest.mark.parametrize("names", SCANS, ids=[names[1] for names in SCANS])
def test_real_scans_come_out_as_from_the_program(names, backend, tmp_path):
    path = data(*names)
    voxels, matrix = readLabels(path)
    node = segmentationOf(voxels, matrix)
    value = int(numpy.unique(voxels[voxels > 0])[0])
    found = roles(compute(node, EXACT, backend, [f"Segment_{value}"]))
    run("core", path, "--labels", value, "-o", tmp_path / "c.vtp", "--refine", "off", "--quiet")
    expected, model = lpsPoints(tmp_path / "c.vtp")
    shown = found["surface"][0]
    assert shown.GetPolyData().GetNumberOfPolys() == model.GetNumberOfPolys()
    assert numpy.allclose(pointsOf(shown), expected * (-1, -1, 1), atol=1e-6)
    run("skeleton", path, "--labels", value, "-o", tmp_path / "s.vtp", "--quiet")
    expected, _ = lpsPoints(tmp_path / "s.vtp")
    # Ties between equal places are settled by rounding, which the place in the scan changes.
    off = numpy.linalg.norm(pointsOf(found["skeleton"][0]) - expected * (-1, -1, 1), axis=1)
    assert (off > 1e-6).mean() < 0.005 and off.max() < 0.5
    run("thickness", path, "--labels", value, "-o", tmp_path / "m.nrrd", "--refine", "off", "--quiet")
    map = Volumes.readMap(str(tmp_path / "m.nrrd"))
    own = slicer.util.arrayFromVolume(found["thickness"][0])
    assert numpy.allclose(numpy.sort(own[own > 0]), numpy.sort(map[map > 0]), rtol=1e-5)
