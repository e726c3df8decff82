"""lambda_ and tolerance in Python mean what --lambda and --tolerance mean to the command line: each combination has its
bits."""

import itertools
import json

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd
from test_results import arrays, polydata

SPACING = (0.5, 0.5, 1)
LAMBDAS = [None, 0, "1vox", "1.5vox", 0.6, "4%"]
TOLERANCES = [None, 0, "1.2diag", "1.5vox", 0.4]


def words(given):
    """Options of the command line."""
    return [word for name, value in given.items() if value is not None for word in (f"--{name}", str(value))]


def labels_of(report):
    for pruned in report["labels"][0]["pruned"]:
        pruned.pop("output", None)
        for name in ("boundary_gap_mm", "boundary_gap_share", "mean_radius_margin_mm", "max_radius_margin_mm",
                     "hairs_removed"):
            pruned.pop(name, None)  # not in files
    report["labels"][0]["certificate"].pop("covered", None)
    return report["labels"]


def same(result, path, tmp_path):
    """Whether a result saves as the command line's file: every array, and what is said of it."""
    result.save(tmp_path / "python.vtp", overwrite=True)
    kept = result.report
    if isinstance(result, voxelcore.Core):
        assert labels_of(voxelcore.read(path).report) == labels_of(kept)
    return arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(path))


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    volume = numpy.kron(blobs(31, shape=(14, 13, 12)), numpy.ones((2, 2, 2), numpy.uint8))
    path = tmp_path_factory.mktemp("scan") / "scan.nrrd"
    write_nrrd(path, volume, SPACING)
    return volume, path


@pytest.mark.parametrize("lambda_, tolerance", itertools.product(LAMBDAS, TOLERANCES))
def test_a_core_is_pruned_as_by_the_command_line(tmp_path, scan, lambda_, tolerance):
    volume, path = scan
    done = run("core", path, "-o", tmp_path / "cli.vtp", *words({"lambda": lambda_, "tolerance": tolerance}))
    assert done.returncode == 0, done.stderr
    assert same(voxelcore.core(volume, spacing=SPACING, lambda_=lambda_, tolerance=tolerance), tmp_path / "cli.vtp",
                tmp_path)


def test_the_floor_beside_a_tolerance_changes_the_result(scan):
    faces = [
        len(voxelcore.core(scan[0], tolerance="0.5diag", lambda_=floor).face_offsets) for floor in ("1.5vox", 0, None)
    ]
    assert 100 < faces[0] < faces[1] == faces[2]


@pytest.mark.parametrize("lambda_, tolerance", itertools.product([None, 0, "1.5vox"], TOLERANCES))
def test_a_skeleton_is_of_the_core_the_command_line_takes(tmp_path, scan, lambda_, tolerance):
    volume, path = scan
    done = run("skeleton", path, "-o", tmp_path / "cli.vtp", *words({"lambda": lambda_, "tolerance": tolerance}))
    assert done.returncode == 0, done.stderr
    skeleton = voxelcore.skeleton(volume, spacing=SPACING, lambda_=lambda_, tolerance=tolerance)
    assert same(skeleton, tmp_path / "cli.vtp", tmp_path)
    told = json.loads(polydata(tmp_path / "cli.vtp").GetFieldData().GetAbstractArray("Provenance").GetValue(0))
    ours = json.loads(polydata(tmp_path / "python.vtp").GetFieldData().GetAbstractArray("Provenance").GetValue(0))
    assert told["skeleton"] == ours["skeleton"]
    assert told["parameters"]["lambda"] == ours["parameters"]["lambda"]
    if tolerance != 0:  # of a core that holds every height the step that made it is skipped
        assert told["labels"][0]["pruned"] == ours["labels"][0]["pruned"]


@pytest.mark.parametrize(
    "made, wanted",
    [
        (dict(lambda_=0), dict(lambda_="1.5vox")),
        (dict(lambda_="1vox"), dict(lambda_=0.8)),
        (dict(tolerance=0), dict(tolerance="1.2diag")),
        (dict(tolerance=0), dict(lambda_="1.5vox")),
        (dict(tolerance=0, lambda_="1vox"), dict(tolerance="1.5vox")),
        (dict(tolerance=0, lambda_="1vox"), dict(lambda_="2vox")),
        (dict(tolerance="1vox", refine="off"), dict(tolerance="1.5vox")),
        (dict(tolerance="1vox"), dict(tolerance="1.5vox")),
        (dict(lambda_="1vox", refine="labels"), dict(lambda_="1.5vox")),
        (dict(tolerance="1vox", refine="labels"), dict(tolerance="1.5vox")),
    ],
)
def test_a_core_is_pruned_further_as_by_the_command_line(tmp_path, scan, made, wanted):
    volume, path = scan
    options = words({name.strip("_"): value for name, value in made.items()})
    further = words({name.strip("_"): value for name, value in wanted.items()})
    assert run("core", path, "-o", tmp_path / "made.vtp", "--keep-edges", *options).returncode == 0
    done = run("prune", tmp_path / "made.vtp", "-o", tmp_path / "cli.vtp", *further)
    assert done.returncode == 0, done.stderr
    core = voxelcore.core(volume, spacing=SPACING, **made)
    assert same(core.prune(**wanted), tmp_path / "cli.vtp", tmp_path)
    assert same(voxelcore.read(tmp_path / "made.vtp").prune(**wanted), tmp_path / "cli.vtp", tmp_path)
    exact = made.get("refine") == "off" or made.get("tolerance") == 0 or set(made) == {"lambda_"}
    if exact and set(made) - {"refine"} == set(wanted):
        assert same(voxelcore.core(volume, spacing=SPACING, refine="off", **wanted), tmp_path / "cli.vtp", tmp_path)


@pytest.mark.parametrize(
    "made, wanted, words",
    [
        (dict(), dict(), "give either lambda_ or tolerance, such as lambda_='1.5mm' or tolerance='1.2diag'"),
        (dict(), dict(lambda_=2, tolerance=2), "give either lambda_ or tolerance"),
        (dict(lambda_=0), dict(tolerance=1), "make it with tolerance=0"),
        (dict(), dict(lambda_=2), "pruned by tolerance 1.2diag already"),
        (dict(tolerance=1), dict(lambda_=2), "pruned by tolerance 1vox already"),
        (dict(tolerance=1), dict(tolerance=0.5), "pruned at tolerance 1vox already"),
        (dict(lambda_=2), dict(lambda_=1), "pruned at 2vox already"),
    ],
)
def test_what_cannot_be_pruned_so_is_refused(scan, made, wanted, words):
    with pytest.raises(ValueError, match=words):
        voxelcore.core(scan[0], **made).prune(**wanted)


@pytest.mark.parametrize("name, given", [("lambda_", [0, "1.5vox", 0.8]), ("tolerance", ("1.2diag", 0, 0.5))])
def test_a_list_gives_a_result_for_each(tmp_path, scan, name, given):
    volume, path = scan
    option = name.strip("_")
    done = run("core", path, "-o", tmp_path / "cli.vtp", f"--{option}", ",".join(map(str, given)))
    assert done.returncode == 0, done.stderr
    files = {path.name: path for path in tmp_path.glob("cli_*.vtp")}
    assert len(files) == 3
    whole = voxelcore.core(volume, spacing=SPACING, **{name: 0})
    results = voxelcore.core(volume, spacing=SPACING, **{name: given})
    further = whole.prune(**{name: given})
    assert len(results) == len(further) == 3
    for value, result, pruned in zip(given, results, further):
        text = next(name for name in files
                    if name[4:].split("-", 1)[1].removesuffix(".vtp") in (str(value), f"{value}mm"))
        assert same(result, files[text], tmp_path) and same(pruned, files[text], tmp_path)
    assert [len(voxelcore.core(volume, spacing=SPACING, **{name: [given[0]]}))] == [1]
