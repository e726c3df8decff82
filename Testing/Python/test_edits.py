"""skeleton(edits=...) does what --edits does, from each form that edits can have, and says what was left out."""

import pickle

import numpy
import pytest
import voxelcore
from conftest import run, write_nrrd

SPACING = (0.5, 0.5, 0.5)
EDITS = [
    {"x": 15, "y": 12, "z": 6, "edit": "remove", "name": ""},
    {"x": 30, "y": 18, "z": 6, "edit": "cut"},
    {"x": 2, "y": 6, "z": 6, "edit": "root", "name": None},
    {"x": 40, "y": 6, "z": 6, "edit": "path 42 12 6; 43 20 6 radius 1", "name": "artery"},
    {"x": 1e6, "y": 0, "z": 0, "edit": "remove"},
    {"x": numpy.nan, "y": 0, "z": 0, "edit": numpy.nan, "name": ""},
]


@pytest.fixture(scope="module")
def tree():
    """A trunk along x with two branches along y, as [i, j, k]."""
    x, y, z = numpy.indices((90, 60, 24))
    trunk = (numpy.hypot(y - 12, z - 12) < 4.5) & (x >= 4) & (x < 86)
    first = (numpy.hypot(x - 30, z - 12) < 3.5) & (y >= 12) & (y < 44)
    second = (numpy.hypot(x - 60, z - 12) < 3.5) & (y >= 12) & (y < 50)
    return (trunk | first | second).astype(numpy.uint8)


@pytest.fixture(scope="module")
def program(tmp_path_factory, tree):
    """The program's skeleton, and what it says of edits that were left out."""
    folder = tmp_path_factory.mktemp("edits")
    write_nrrd(folder / "tree.nrrd", tree, SPACING)
    lines = [f"{one['x']},{one['y']},{one['z']},{one['edit']},{one.get('name') or ''}\n" for one in EDITS[:-1]]
    (folder / "edits.csv").write_text("branch,x,y,z,edit,name\n" + "".join("," + line for line in lines))
    done = run("skeleton", folder / "tree.nrrd", "--edits", folder / "edits.csv", "-o", folder / "cli.vtp")
    assert done.returncode == 0, done.stderr
    left_out = [line.split("is left out: ")[1] for line in done.stderr.splitlines() if "is left out: " in line]
    return folder / "edits.csv", voxelcore.read(folder / "cli.vtp"), left_out


def forms(path):
    pandas = pytest.importorskip("pandas")
    tables = {"a table": pandas.read_csv(path), "a table of dicts": pandas.DataFrame(EDITS)}
    return {"dicts": EDITS, "a path": path, **tables}


@pytest.mark.parametrize("form", ["dicts", "a path", "a table", "a table of dicts"])
def test_edits_do_what_the_program_does(tree, program, form):
    path, expected, left_out = program
    edited = voxelcore.skeleton(tree, spacing=SPACING, edits=forms(path)[form])
    assert edited.topology["betti"] == (2, 0, 0)
    assert numpy.array_equal(edited.points, expected.points) and numpy.array_equal(edited.radius, expected.radius)
    assert numpy.array_equal(edited.branch_points, expected.branch_points)
    assert edited.branch_names == expected.branch_names and edited.branch_names.count("artery") == 1
    assert [one["left_out"] for one in edited.edits if one["left_out"]] == left_out == ["no branch passes there"]
    assert len(edited.edits) == 5 and edited.report["parameters"]["change_voxels"]


def test_what_is_told_is_kept_and_can_be_given_again(tree):
    edited = voxelcore.skeleton(tree, spacing=SPACING, edits=EDITS, cut_loops=True)
    again = pickle.loads(pickle.dumps(edited))
    assert again.edits == edited.edits and again.branch_names == edited.branch_names
    assert numpy.array_equal(voxelcore.skeleton(tree, spacing=SPACING, edits=edited.edits).points, edited.points)


def test_an_edit_is_of_its_label(tree):
    both = tree.copy()
    both[:, :, 0] = 7
    cut = {"x": 30, "y": 18, "z": 6, "edit": "cut"}
    for label, pieces, told in ((1, 2, 1), (7, 1, 0)):
        edited = voxelcore.skeleton(both, spacing=SPACING, label=1, edits=[dict(cut, label=label)])
        assert edited.topology["betti"][0] == pieces and len(edited.edits) == told


def test_without_edits_to_do_the_skeleton_is_the_usual_one(tree):
    edited = voxelcore.skeleton(tree, spacing=SPACING, edits=[])
    usual = voxelcore.skeleton(tree, spacing=SPACING)
    assert edited.edits == usual.edits == [] and numpy.array_equal(edited.points, usual.points)


@pytest.mark.parametrize("edits, named", [
    ([{"x": 1, "y": 2, "z": 3, "edit": "jump"}], "edits: row 0: 'jump' is no edit"),
    ([{"x": 1, "y": 2, "edit": "cut"}], "edits: row 0: x, y, z: expected three numbers"),
    ([(1, 2, 3)], "edits: row 0: expected a dict"),
    ("/none/edits.csv", "/none/edits.csv: cannot read"),
])
def test_edits_without_sense_are_refused(tree, edits, named):
    with pytest.raises(ValueError) as refusal:
        voxelcore.skeleton(tree, spacing=SPACING, edits=edits)
    assert str(refusal.value).startswith(named)


def test_edits_are_of_one_body_of_an_array(tree):
    core = voxelcore.core(tree, spacing=SPACING)
    for source, more in ((core, {}), (tree, {"network": True}), (tree * 2, {"label": "all"})):
        if more.get("label"):
            source = source.copy()
            source[:4] = 1
        with pytest.raises(ValueError, match="edits"):
            voxelcore.skeleton(source, edits=EDITS[:1], **more)
