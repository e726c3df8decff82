"""compare() tells of arrays, paths and results what the program tells of files."""

import json

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd

SPACING = (0.5, 0.7, 1)


def told_by_program(tmp_path, a, b, *options):
    done = run("compare", a, b, "--report", tmp_path / "report.json", "--force", *options)
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "report.json").read_text())
    return {key: value for key, value in report.items() if key not in ("voxelcore", "a", "b")}


@pytest.fixture
def pair(tmp_path):
    a, b = blobs(5, labels=2), blobs(6, labels=2)
    write_nrrd(tmp_path / "a.nrrd", a, SPACING)
    write_nrrd(tmp_path / "b.nrrd", b, SPACING)
    return a, b


def test_arrays_are_compared_as_the_program_compares_files(tmp_path, pair):
    paths = tmp_path / "a.nrrd", tmp_path / "b.nrrd"
    found = voxelcore.compare(*pair, spacing=SPACING)
    assert found == told_by_program(tmp_path, *paths)
    assert found["kind"] == "masks" and [row["label"] for row in found["labels"]] == [1, 2]
    a, b = pair[0] == 1, pair[1] == 1
    assert found["labels"][0]["dice"] == pytest.approx(2 * (a & b).sum() / (a.sum() + b.sum()), abs=1e-15)
    assert voxelcore.compare(*map(str, paths), label=2)["labels"] == voxelcore.compare(
        *pair, spacing=SPACING, label=2)["labels"]  # fmt: skip
    turned = voxelcore.compare(pair[0].T, pair[1].T, axes="kji", spacing=SPACING)
    assert turned == found
    fast = voxelcore.compare(*pair, spacing=SPACING, no_skeletons=True)
    assert fast["labels"][0]["cl_dice"] is None and fast["labels"][0]["dice"] == found["labels"][0]["dice"]


def test_results_are_compared_as_their_files_are(tmp_path):
    rod = numpy.zeros((40, 9, 9), bool)
    rod[2:38, 2:7, 2:7] = True
    for make, kind in ((voxelcore.skeleton, "skeletons"), (voxelcore.core, "cores")):
        a, b = make(rod, spacing=SPACING), make(rod[:, 1:], spacing=SPACING)
        for name, one in (("a.vtp", a), ("b.vtp", b)):
            one.save(tmp_path / name, overwrite=True)
        found = voxelcore.compare(a, b, near="2mm")
        assert found == told_by_program(tmp_path, tmp_path / "a.vtp", tmp_path / "b.vtp", "--near", "2mm")
        assert found["kind"] == kind and found["unit"] == "mm"
        assert found["labels"][0]["hausdorff"] == pytest.approx(0.7, abs=1e-9)  # moved by a voxel along j
        assert voxelcore.compare(str(tmp_path / "a.vtp"), b, near="2mm") == found


def test_a_mask_is_compared_with_a_skeleton_by_its_own(tmp_path):
    rod = numpy.zeros((40, 9, 9), bool)
    rod[2:38, 2:7, 2:7] = True
    found = voxelcore.compare(rod, voxelcore.skeleton(rod, spacing=SPACING, prune_branches=None), spacing=SPACING)
    assert found["kind"] == "skeletons"
    assert found["labels"][0]["branches_detected"] == 1


def test_what_cannot_be_compared_is_refused(tmp_path, pair):
    write_nrrd(tmp_path / "half.nrrd", pair[1], SPACING, (0.25, 0, 0))
    with pytest.raises(ValueError, match="does not have the grid"):
        voxelcore.compare(str(tmp_path / "a.nrrd"), str(tmp_path / "half.nrrd"))
    with pytest.raises(ValueError, match="has such a label"):
        voxelcore.compare(*pair, label=7)
    with pytest.raises(ValueError, match="looks like a grey scan"):
        voxelcore.compare(pair[0], numpy.random.default_rng(1).integers(1, 30000, pair[1].shape))
    with pytest.raises(ValueError, match="nothing but background|only background"):
        voxelcore.compare(pair[0], 0 * pair[1])
    with pytest.raises(TypeError, match="unexpected keyword argument 'nearr'; did you mean 'near'"):
        voxelcore.compare(*pair, nearr=1)
    with pytest.raises(ValueError, match="medial surface"):
        voxelcore.compare(pair[0], voxelcore.core(pair[0] == 1))
