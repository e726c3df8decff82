"""Every option of the command line that arrays can have is an argument, and gives the same bits: edits, crop,
refinement, several labels, components."""

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd
from test_pruning import SPACING, same

OPTIONS = [
    dict(fill_cavities=True, min_voxels=30),
    dict(largest=1, smooth_shape=True),
    dict(mend_shape=True),
    dict(crop="2:30,:,4:28"),
    dict(crop="2:30,:,4:28", fill_cavities=True, lambda_="1vox", tolerance="1diag"),
    dict(refine="labels", largest=1),
    dict(cross_check=True),
    dict(engine="tetgen"),
]


def words(options):
    for keyword, value in options.items():
        yield "--" + keyword.strip("_").replace("_", "-")
        if value is not True:
            yield str(value)


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """Two labels, of several components each."""
    volume = numpy.kron(blobs(7, shape=(18, 16, 16)), numpy.ones((2, 2, 2), numpy.uint8))
    volume[18:] *= 3
    path = tmp_path_factory.mktemp("scan") / "scan.nrrd"
    write_nrrd(path, volume, SPACING)
    return volume, path


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_an_option_means_what_it_means_on_the_command_line(tmp_path, scan, options):
    volume, path = scan
    done = run("core", path, "--labels", "3", "-o", tmp_path / "cli.vtp", *words(options))
    assert done.returncode == 0, done.stderr
    core = voxelcore.core(volume, spacing=SPACING, label=3, **options)
    assert same(core, tmp_path / "cli.vtp", tmp_path)
    given = {keyword.strip("_"): value for keyword, value in options.items()}
    assert {name: core.report["parameters"][name] for name in ("mend_shape", "fill_cavities", "smooth_shape")} == {
        name: given.get(name, False) for name in ("mend_shape", "fill_cavities", "smooth_shape")
    }


def test_labels_and_components_come_by_their_names(tmp_path, scan):
    volume, path = scan
    done = run("core", path, "--split-components", "-o", f"{tmp_path}/parts/")
    assert done.returncode == 0, done.stderr
    parts = voxelcore.core(volume, spacing=SPACING, label="all", split_components=True)
    assert {label for label, _ in parts} == {1, 3} and len(parts) == len(list((tmp_path / "parts").glob("*.vtp")))
    for (label, component), core in parts.items():
        assert (core.label, core.component) == (label, component)
    whole = voxelcore.core(volume, spacing=SPACING, label=[1, 3], lambda_=[0, "2vox"])
    assert list(whole) == [1, 3] and all(len(cores) == 2 for cores in whole.values())
    assert sum(core.voxels for core in parts.values()) == sum(cores[0].voxels for cores in whole.values())


def test_what_arrays_cannot_have_is_refused(scan):
    volume, _ = scan
    with pytest.raises(ValueError, match="refine='grey': expected labels"):
        voxelcore.core(volume, label=3, refine="grey")
    with pytest.raises(ValueError, match="label='all'"):
        voxelcore.core(volume)
    with pytest.raises(ValueError, match="give one label"):
        voxelcore.skeleton(volume, label="all")
