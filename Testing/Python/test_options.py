"""Every option of the command line that arrays can have is an argument, and gives the same bits: edits, crop,
refinement, several labels, components."""

import csv
import inspect

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd
from test_pruning import SPACING, same
from voxelcore import _arguments, _voxelcore

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


# Why an option has no argument. Whatever else the table has must be one.
PATHS = ("scan", "core", "output", "report", "table", "html", "html-triangles", "scene", "surface", "medial")
WITHOUT = {
    **dict.fromkeys(PATHS, "results are objects; save() and to_...() write and show them"),
    **dict.fromkeys(("voxels", "graph", "change-voxels"), "the same: sheet_of_face, junctions, a comparison of arrays"),
    **dict.fromkeys(("volume", "component", "level", "raw", "dataset", "nifti-form"), "choose how a file is read"),
    **dict.fromkeys(("resolution", "cap", "cover"), "of meshes"),
    **dict.fromkeys(("grey", "grey-range"), "name a second file"),
    **dict.fromkeys(("blocks", "block", "block-size", "join", "memory"), "parts of scans that do not fit into memory"),
    "with-skeleton": "Core.skeleton()",
    "quiet": "nothing is printed",
    "annotations": "a file that is filled in by hand; Skeleton has the branches",
    **dict.fromkeys(("probability", "thresholds", "persistence"), "probability() is a function of its own"),
    "units": "columns() gives units",
    "sections": "tables and contours that the program writes beside its skeleton",
    **dict.fromkeys(("branch-map", "order-map", "skeleton-map", "centerlines", "flow", "inlet", "soma"),
                    "files that the program writes beside its skeleton"),
    **dict.fromkeys(("separation", "within"), "measure the background as an array of its own"),
}
FUNCTIONS = {
    "core": (voxelcore.core, _arguments.OF_CORE, voxelcore.Core.save, voxelcore.Skeleton.save, _arguments.OF_SKELETON),
    "skeleton": (voxelcore.skeleton, _arguments.OF_CORE, _arguments.OF_SKELETON, voxelcore.core,
                 voxelcore.Skeleton.save),
    "prune": (voxelcore.prune, voxelcore.Core.save),
    "measure": (voxelcore.measure, _arguments.OF_MEASURE, voxelcore.Skeleton.save),
    "thickness": (voxelcore.thickness, _arguments.OF_THICKNESS),
    "sheets": (voxelcore.sheets, _arguments.OF_CORE, _arguments.OF_SHEETS, voxelcore.core),
    "verify": (voxelcore.verify,),
    "compare": (voxelcore.compare, _arguments.OF_COMPARE),
}  # fmt: skip
TABLE = [row for row in _voxelcore.option_table() if row["command"] in FUNCTIONS]
PROGRAM = ("sections", "branch_map", "order_map", "skeleton_map", "centerlines", "flow", "inlet", "soma")
SAVING = ("overwrite", "triangles", "keep_edges", "also")


@pytest.mark.parametrize("row", TABLE, ids=lambda row: f"{row['command']}-{row['name']}")
def test_every_option_of_the_table_is_an_argument_or_there_is_a_reason(row):
    if not row["flags"] or (row["name"] == "force" and row["command"] in ("thickness", "sheets", "compare")):
        return  # the scan itself; nothing is written
    keywords = set()
    for place in FUNCTIONS[row["command"]]:
        keywords |= set(place) if isinstance(place, dict) else set(inspect.signature(place).parameters)
    keyword = row["keyword"].partition("=")[0]
    assert (keyword in keywords) != (row["name"] in WITHOUT), "an argument, or a reason why there is none"
    if keyword in keywords and keyword not in SAVING:
        assert keyword.strip("_") == row["name"].replace("-", "_") or keyword == "label"


def test_no_reason_is_left_of_an_option_that_is_gone():
    assert set(WITHOUT) <= {row["name"] for row in TABLE}


@pytest.mark.parametrize("command", ["core", "skeleton", "thickness", "sheets", "measure"])
def test_a_value_without_sense_is_refused_by_every_option(command):
    function = FUNCTIONS[command][0]
    rod = numpy.ones((12, 5, 5), bool)
    source = voxelcore.skeleton(rod) if command == "measure" else rod
    refused = 0
    for row in TABLE:
        keyword = row["keyword"]
        ofSkeletons = command == "core" and row["group"] == "Skeleton"
        if row["command"] == command and keyword.isidentifier() and not ofSkeletons:
            if keyword not in (*SAVING, "progress", "separation", "within", *PROGRAM):
                with pytest.raises((ValueError, TypeError)) as refusal:
                    function(source, **{keyword: "never"})
                assert "unexpected keyword" not in str(refusal.value), keyword
                refused += 1
    assert refused > 4


@pytest.mark.parametrize("given, named", [
    ({"crop": (1, 2)}, "crop=(1, 2)"),
    ({"close": [1, 2]}, "close=[1, 2]"),
    ({"lambda_": numpy.ones((2, 2))}, "lambda=array"),
    ({"tolerance": "1,2"}, "tolerance='1,2'"),
])
def test_the_argument_is_named_that_has_a_value_of_the_wrong_kind(given, named):
    with pytest.raises(ValueError) as refusal:
        voxelcore.core(numpy.ones((12, 5, 5), bool), **given)
    assert str(refusal.value).startswith(named)


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
    with pytest.raises(ValueError, match=r"refine='grey': expected threshold=\(LO, HI\)"):
        voxelcore.core(volume, label=3, refine="grey")
    with pytest.raises(ValueError, match="refine='mesh': expected labels or grey"):
        voxelcore.core(volume, label=3, refine="mesh")
    with pytest.raises(ValueError, match="label='all'"):
        voxelcore.core(volume)
    with pytest.raises(ValueError, match="give one label"):
        voxelcore.skeleton(volume, label="all")


@pytest.fixture(scope="module")
def grey():
    """A bent tube with a wall, blurred: values of int16, its shape where they are at least 500."""
    i, j, k = numpy.indices((36, 34, 22)) * numpy.reshape(SPACING, (3, 1, 1, 1))
    middle = numpy.array(SPACING) * (36, 34, 22) / 2
    away = numpy.hypot(i - middle[0] - 0.2 * (k - middle[2]), j - middle[1])
    return (1000 * numpy.clip(0.5 + (1.6 - abs(away - 0.3 * middle.min() - 2)) / 1.1, 0, 1)).astype(numpy.int16)


@pytest.mark.parametrize("turn", [
    lambda array: array,
    lambda array: array.astype(">f4"),
    lambda array: numpy.asfortranarray(array.astype(numpy.float64)),
    lambda array: numpy.repeat(array.astype(numpy.int32), 2, axis=1)[:, ::2],
    lambda array: array[::-1, :, ::-1].copy()[::-1, :, ::-1].astype(numpy.uint16),
], ids=["int16", "swapped", "fortran", "strided", "uint16"])  # fmt: skip
def test_grey_values_of_an_array_refine_as_those_of_a_file_do(tmp_path, grey, turn):
    write_nrrd(tmp_path / "grey.nrrd", grey, SPACING)
    given = dict(spacing=SPACING, threshold=(500, numpy.inf), refine="grey")
    words = "--threshold", "500:inf", "--refine", "grey"
    assert run("core", tmp_path / "grey.nrrd", "-o", tmp_path / "cli.vtp", *words).returncode == 0
    array = turn(grey)
    core = voxelcore.core(array, **given)
    assert same(core, tmp_path / "cli.vtp", tmp_path)
    labels = voxelcore.core(array, **dict(given, refine="labels"))
    assert not numpy.array_equal(core.radius, labels.radius)


def test_what_was_refined_from_grey_values_is_measured_and_verified(tmp_path, grey):
    write_nrrd(tmp_path / "grey.nrrd", grey, SPACING)
    given = dict(spacing=SPACING, threshold=(500, numpy.inf), refine="grey", crop="2:34,:,:")
    words = "--threshold", "500:inf", "--refine", "grey", "--crop", "2:34,:,:"
    core = voxelcore.core(grey, **given)
    verified = core.verify(grey)
    assert verified.passed and not any("not made again" in note for note in verified.notes), verified
    other = grey.copy()
    other[grey > 500] += (30 * numpy.random.default_rng(1).random((grey > 500).sum())).astype(numpy.int16)
    assert not core.verify(other).passed, "the same voxels of other grey values"
    outputs = "-o", tmp_path / "map.nrrd", "--table", tmp_path / "table.csv"
    done = run("thickness", tmp_path / "grey.nrrd", *outputs, *words)
    assert done.returncode == 0, done.stderr
    (told,) = csv.DictReader((tmp_path / "table.csv").open())
    assert voxelcore.thickness(grey, **given).numbers[1]["mean"] == pytest.approx(float(told["mean"]), rel=1e-6)
    core.save(tmp_path / "python.vtp")
    again = run("verify", tmp_path / "grey.nrrd", tmp_path / "python.vtp")
    assert again.returncode == 0, again.stdout + again.stderr


def test_grey_values_that_are_missing_are_refused(grey):
    given = dict(spacing=SPACING, threshold=(500, 2000), refine="grey")
    holed = grey.astype(numpy.float32)
    holed[holed == 0] = numpy.nan
    with pytest.raises(ValueError, match="no finite number"):
        voxelcore.core(holed, **given)
    with pytest.raises(ValueError, match="masked voxels have no grey values"):
        voxelcore.core(numpy.ma.masked_less(grey, 10), **given)
