"""Python gives what the command line gives, bit for bit; results are views that live as long as somebody holds them."""

import gc
import json
import os
import pickle
import threading
import time

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

TURNED = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
PLACES = [
    dict(spacing=(1, 1, 1)),
    dict(spacing=(0.5, 0.5, 2), origin=(-3, 7.25, 100)),
    dict(spacing=(1, 2, 3), direction=TURNED),
    dict(spacing=(1, 1, 1), direction=numpy.diag([-1, 1, 1])),
]


def polydata(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    """Everything in a vtkPolyData but its Provenance, as bytes by name."""
    found = {"points": vtk_to_numpy(data.GetPoints().GetData()).tobytes()}
    for name in ("Verts", "Lines", "Polys"):
        cells = getattr(data, "Get" + name)()
        for part in ("Offsets", "Connectivity"):
            values = vtk_to_numpy(getattr(cells, f"Get{part}Array")()).astype(numpy.int64)
            found[name + part] = values.tobytes() if cells.GetNumberOfCells() else b""
    for kind in ("Point", "Cell"):
        attributes = getattr(data, f"Get{kind}Data")()
        for index in range(attributes.GetNumberOfArrays()):
            found[kind + attributes.GetArrayName(index)] = vtk_to_numpy(attributes.GetArray(index)).tobytes()
    return found


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("lambda_", [0, "1.5vox", "2mm", "3%"])
def test_a_core_has_the_bits_of_the_command_line(tmp_path, place, lambda_):
    volume = blobs(11)
    write_nrrd(tmp_path / "scan.nrrd", volume, **place)
    done = run("core", tmp_path / "scan.nrrd", "--lambda", lambda_, "--keep-edges", "-o", tmp_path / "cli.vtp", "-q")
    assert done.returncode == 0, done.stderr
    core = voxelcore.core(volume, lambda_=lambda_, **place)
    assert arrays(core.to_polydata()) == {
        name: value for name, value in arrays(polydata(tmp_path / "cli.vtp")).items() if name not in ("CellComponent",)
    }
    core.save(tmp_path / "python.vtp", keep_edges=True)
    assert arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(tmp_path / "cli.vtp"))
    ours = json.loads(voxelcore.read(tmp_path / "python.vtp")._data.report)
    theirs = json.loads(voxelcore.read(tmp_path / "cli.vtp")._data.report)
    for label in (ours["labels"][0], theirs["labels"][0]):
        label.pop("output", None)
    assert ours["labels"] == theirs["labels"]
    verified = run("verify", tmp_path / "scan.nrrd", tmp_path / "python.vtp")
    assert verified.returncode == 0, verified.stderr


def test_tolerances_have_the_bits_of_the_command_line(tmp_path):
    volume = blobs(12)
    write_nrrd(tmp_path / "scan.nrrd", volume)
    assert run("core", tmp_path / "scan.nrrd", "--tolerance", "1.2diag", "-o", tmp_path / "cli.vtp").returncode == 0
    core = voxelcore.core(volume, tolerance="1.2diag")
    assert len(core.tolerance_vertices) == len(core.vertices)
    core.save(tmp_path / "python.vtp")
    assert arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(tmp_path / "cli.vtp"))


def test_a_skeleton_has_the_bits_of_the_command_line(tmp_path):
    volume = blobs(13, shape=(60, 30, 30))
    place = PLACES[1]
    write_nrrd(tmp_path / "scan.nrrd", volume, **place)
    options = ["--root", "top", "--also", "csv"]
    done = run("skeleton", tmp_path / "scan.nrrd", "-o", tmp_path / "cli.vtp", *options)
    assert done.returncode == 0, done.stderr
    skeleton = voxelcore.skeleton(volume, root="top", **place)
    skeleton.save(tmp_path / "python.vtp", also=["csv"])
    assert arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(tmp_path / "cli.vtp"))
    for table in ("branches", "summary"):
        assert (tmp_path / f"python_{table}.csv").read_text() == (tmp_path / f"cli_{table}.csv").read_text()
    drawn = arrays(skeleton.to_polydata())
    written = arrays(polydata(tmp_path / "cli.vtp"))
    assert len(skeleton.branch_nodes) > 0 and all(drawn[name] == written[name] for name in drawn)
    # The table in Python is the file's, unrounded.
    table = voxelcore.measure(skeleton)
    lines = [line.split(",") for line in (tmp_path / "cli_branches.csv").read_text().splitlines()]
    for name in ("branch_distance", "mean_radius", "strahler", "branch_type"):
        file = [float(line[lines[0].index(name)]) for line in lines[1:]]
        assert numpy.allclose(table[name], file, rtol=1e-6, atol=0), name
    assert skeleton.report["labels"][0]["certificate"]["stand_out"] is True
    assert set(table) <= set(voxelcore.columns())
    assert skeleton.numbers["branches"] == len(table["branch_distance"]) == len(skeleton.branch_nodes)


def test_skeletons_and_sheets_join_pieces_that_touch_as_the_command_line_does(tmp_path):
    line = numpy.zeros((14, 14, 14), numpy.uint8)
    line[tuple([range(2, 12)] * 3)] = 1
    write_nrrd(tmp_path / "scan.nrrd", line, **PLACES[1])

    def pieces(made):
        return made.report["labels"][0]["shape"]["betti"][0]

    for given in (dict(), dict(connectivity=6), dict(connectivity="26"), dict(tree=True)):
        options = []
        for name, value in given.items():
            options += [f"--{name}"] if value is True else [f"--{name}", str(value)]
        done = run("skeleton", tmp_path / "scan.nrrd", "--force", "-o", tmp_path / "cli.vtp", *options)
        assert done.returncode == 0, done.stderr
        skeleton = voxelcore.skeleton(line, **given, **PLACES[1])
        assert pieces(skeleton) == (10 if given == dict(connectivity=6) else 1)
        skeleton.save(tmp_path / "python.vtp", overwrite=True)
        assert arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(tmp_path / "cli.vtp"))
    assert pieces(voxelcore.core(line)) == pieces(voxelcore.sheets(line, connectivity=6)["core"]) == 10
    assert pieces(voxelcore.sheets(line)["core"]) == 1
    with pytest.raises(ValueError, match="connectivity: a core has that of its shape"):
        voxelcore.skeleton(voxelcore.core(line), connectivity=26)


def test_pruning_a_core_equals_making_it_pruned(volume):
    whole = voxelcore.core(volume, lambda_=0)
    once = voxelcore.core(volume, lambda_="2vox")
    for pruned in (whole.prune("2vox"), whole.prune("1vox").prune(2)):
        assert arrays(pruned.to_polydata()) == arrays(once.to_polydata())
        assert pruned.topology == whole.topology
    with pytest.raises(ValueError, match="pruned at 2vox already"):
        once.prune("1vox")


def test_arrays_of_simpleitk_are_turned_by_axes(volume):
    place = dict(spacing=(1, 2, 3), origin=(5, 6, 7), direction=TURNED.ravel())
    ours = voxelcore.core(volume, **place)
    theirs = voxelcore.core(numpy.ascontiguousarray(volume.T), axes="kji", **place)
    assert arrays(ours.to_polydata()) == arrays(theirs.to_polydata())


def test_the_topology_is_that_of_the_voxels():
    ring = numpy.ones((12, 12, 4), bool)
    ring[4:8, 4:8] = False
    core = voxelcore.core(ring)
    assert core.topology == core.shape_topology == {"euler": 0, "betti": (1, 1, 0)}
    shell = numpy.ones((9, 9, 9), bool)
    shell[4, 4, 4] = False
    assert voxelcore.core(shell).topology == {"euler": 2, "betti": (1, 0, 1)}
    assert voxelcore.skeleton(ring).numbers["cycles"] == 1


def vessels():
    """A stem of label 2 and arms of labels 5 and 9, which meet in a fork."""
    volume = numpy.zeros((64, 60, 12), numpy.uint8)
    i, j, k = numpy.indices(volume.shape)
    for label, (a, b) in {9: ((32, 30), (58, 55)), 5: ((32, 30), (6, 55)), 2: ((32, 4), (32, 29))}.items():
        along = numpy.array([b[0] - a[0], b[1] - a[1]], float)
        part = numpy.clip(((i - a[0]) * along[0] + (j - a[1]) * along[1]) / (along @ along), 0, 1)
        away = (i - a[0] - part * along[0]) ** 2 + (j - a[1] - part * along[1]) ** 2 + (k - 5.5) ** 2
        volume[away <= 16] = label
    return volume


def test_a_network_has_the_bits_of_the_command_line(tmp_path):
    volume, place = vessels(), PLACES[1]
    write_nrrd(tmp_path / "scan.nrrd", volume, **place)
    done = run("skeleton", tmp_path / "scan.nrrd", "--network", "-o", tmp_path / "cli.vtp", "--also", "csv")
    assert done.returncode == 0, done.stderr
    network = voxelcore.skeleton(volume, network=True, **place)
    network.save(tmp_path / "python.vtp", also="csv")
    assert arrays(polydata(tmp_path / "python.vtp")) == arrays(polydata(tmp_path / "cli.vtp"))
    for table in ("branches", "summary", "contacts"):
        assert (tmp_path / f"python_{table}.csv").read_text() == (tmp_path / f"cli_{table}.csv").read_text()
    drawn, written = arrays(network.to_polydata()), arrays(polydata(tmp_path / "cli.vtp"))
    assert all(drawn[name] == written[name] for name in drawn)


def test_a_network_names_labels_and_contacts():
    network = voxelcore.skeleton(vessels(), network=True, spacing=(0.5, 0.5, 0.5))
    assert set(network.branch_labels) == set(network.point_labels) == {2, 5, 9}
    assert [contact["labels"] for contact in network.contacts] == [(2, 5), (2, 9), (5, 9)]
    for contact in network.contacts:
        (node,) = contact["nodes"]
        meeting = network.branch_labels[(network.branch_nodes == node).any(axis=1)]
        assert set(contact["labels"]) <= set(meeting) and contact["area"] == 0.25 * contact["faces"] > 0
    again = pickle.loads(pickle.dumps(network))
    assert numpy.array_equal(again.point_labels, network.point_labels) and again.contacts == network.contacts
    assert voxelcore.skeleton(vessels(), network=True, label=[2, 5]).numbers["branches"] == 2
    with pytest.raises(ValueError, match="several labels"):
        voxelcore.skeleton(vessels() > 0, network=True)
    with pytest.raises(ValueError, match="network: is for arrays"):
        voxelcore.skeleton(voxelcore.core(vessels() > 0), network=True)


def test_branches_are_counted_from_either_end():
    cross = numpy.zeros((40, 40, 9), bool)
    cross[2:38, 17:22, 2:7] = cross[17:22, 2:38, 2:7] = True
    skeleton = voxelcore.skeleton(cross)
    count = len(skeleton.branch_nodes)
    assert count > 2
    for number in range(count):
        assert numpy.array_equal(skeleton.branch(number), skeleton.branch(number - count))
        offsets = skeleton.branch_offsets[number : number + 2]
        assert len(skeleton.branch(number)) == offsets[1] - offsets[0] > 1
    assert numpy.array_equal(skeleton.branch(numpy.int16(-1)), skeleton.branch(count - 1))
    for number in (count, -count - 1):
        with pytest.raises(IndexError, match=f"branch {number}: there are {count} branches"):
            skeleton.branch(number)
    with pytest.raises(TypeError):
        skeleton.branch(0.0)


def test_arrays_are_views_that_outlive_their_core(volume):
    core = voxelcore.core(volume)
    vertices, again = core.vertices, core.vertices
    assert vertices.__array_interface__["data"] == again.__array_interface__["data"]
    assert not vertices.flags.owndata and not vertices.flags.writeable
    copy = vertices.copy()
    del core, again
    gc.collect()
    junk = [numpy.random.rand(*copy.shape) for _ in range(50)]
    assert numpy.array_equal(vertices, copy) and junk
    with pytest.raises(ValueError):
        vertices[0] = 0


def test_no_memory_is_lost(volume):
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    for _ in range(20):
        voxelcore.core(volume).vertices
    before = resident()
    for _ in range(100):
        core = voxelcore.core(volume)
        (core.vertices, core.edges, core.to_polydata())
        with pytest.raises(ValueError):
            voxelcore.core(volume, lambda_="x")
    assert resident() - before < 8 << 20


def test_what_is_written_is_whole_or_not_there(tmp_path, volume):
    core = voxelcore.core(volume, lambda_="1.5vox")
    with pytest.raises(ValueError, match="unknown extension"):
        core.save(tmp_path / "core.doc")
    with pytest.raises(OSError, match="nowhere"):
        core.save(tmp_path / "nowhere" / "core.vtp")
    core.save(tmp_path / "core.vtp")
    with pytest.raises(OSError, match="exists"):
        core.save(tmp_path / "core.vtp")
    core.save(tmp_path / "core.vtp", overwrite=True)
    assert sorted(os.listdir(tmp_path)) == ["core.vtp"]
    for name in ("core.ply", "core.stl", "core.obj", "core.vtk", "core.ma"):
        core.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 100
    with pytest.raises(ValueError, match="missing"):
        voxelcore.read(tmp_path / "missing.vtp")


@pytest.mark.parametrize("work", [voxelcore.core, voxelcore.skeleton])
def test_progress_never_falls_and_ends_at_one(volume, work):
    told = []
    work(numpy.kron(volume, numpy.ones((3, 3, 3), numpy.uint8)), progress=lambda *now: told.append(now))
    assert told and all(isinstance(stage, str) for stage, _ in told)
    shares = [done for _, done in told]
    assert shares == sorted(shares) and 0 <= shares[0] and told[-1] == ("done", 1)
    assert shares.count(1) == 1
    told.clear()
    voxelcore.core(volume, lambda_=0).prune(2, progress=lambda *now: told.append(now))
    assert told[-1] == ("done", 1)


def test_errors_of_a_listener_arrive(volume):

    def refuse(stage, done):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        voxelcore.core(volume, progress=refuse)


def test_other_threads_run_meanwhile_and_compute_at_once(volume):
    big = numpy.kron(volume, numpy.ones((3, 3, 3), numpy.uint8))
    expected = arrays(voxelcore.core(big, threads=1).to_polydata())
    ticks, results = [], {}

    def work(name):
        results[name] = arrays(voxelcore.core(big, threads=2).to_polydata())

    workers = [threading.Thread(target=work, args=(name,)) for name in range(2)]
    for worker in workers:
        worker.start()
    while any(worker.is_alive() for worker in workers):
        ticks.append(time.monotonic())
        time.sleep(0.005)
    assert len(ticks) > 5, "the interpreter was locked"
    assert results == {0: expected, 1: expected}


def test_without_a_spacing_lengths_are_in_voxels_and_called_so(tmp_path):
    volume = blobs(11)
    core = voxelcore.core(volume, lambda_=2)
    same = voxelcore.core(volume, lambda_=2, spacing=(1, 1, 1))
    assert (core.unit, same.unit) == ("voxel", "mm")
    assert numpy.array_equal(core.vertices, same.vertices)
    assert "2 vox" in repr(core) and "2 mm" in repr(same)
    assert "lambda_vox" in core.report["labels"][0]["pruned"][0]
    curve = core.skeleton(prune_branches=1)
    assert curve.unit == "voxel" and voxelcore.skeleton(volume, spacing=(1, 1, 1)).unit == "mm"
    for result in (core, curve):
        units = result.to_polydata().GetFieldData().GetAbstractArray("Units")
        assert units.GetValue(0) == "voxel"
        result.save(tmp_path / "saved.vtp", overwrite=True)
        assert polydata(tmp_path / "saved.vtp").GetFieldData().GetAbstractArray("Units").GetValue(0) == "voxel"
    core.save(tmp_path / "core.vtp", keep_edges=True)
    assert voxelcore.read(tmp_path / "core.vtp").unit == "voxel"
    for act in (
        lambda: voxelcore.core(volume, lambda_="2mm"),
        lambda: voxelcore.core(volume, tolerance="1mm"),
        lambda: voxelcore.core(volume, lambda_=0).prune("2mm"),
        lambda: core.skeleton(prune_branches="1mm"),
    ):
        with pytest.raises(ValueError, match="spacing"):
            act()


def test_verify_finds_what_the_command_line_finds(tmp_path):
    volume = blobs(17)
    place = PLACES[1]
    write_nrrd(tmp_path / "scan.nrrd", volume, **place)
    for options in (dict(lambda_=0), dict(), dict(tolerance="1diag", refine="off", fill_cavities=True)):
        core = voxelcore.core(volume, **place, **options)
        core.save(tmp_path / "core.vtp", overwrite=True)
        done = run("verify", tmp_path / "scan.nrrd", tmp_path / "core.vtp")
        assert done.returncode == 0, done.stderr
        for one in (core, voxelcore.read(tmp_path / "core.vtp")):
            found = voxelcore.verify(one, volume)
            assert found.passed and not found.failed and not found.notes and all(found.checks.values()), found
            passed = [line.split(None, 1)[1] for line in done.stdout.splitlines() if "passed  " in line]
            assert list(found.checks) == passed
            assert (found.gap is None) == ("tolerance" not in core.report["labels"][0]["pruned"][0])
        turned = numpy.ascontiguousarray(volume.transpose())
        assert core.verify(turned, axes="kji").passed
        other = volume.copy()
        other[:14] = 0
        wrong = voxelcore.verify(core, other)
        assert not wrong.passed and wrong.failed and all(wrong.failed.values())
        assert [name for name, passed in wrong.checks.items() if not passed] == list(wrong.failed)
    with pytest.raises(ValueError, match="the array"):
        voxelcore.verify(core, volume[:5, :5, :5] * 0)


def test_a_skeleton_is_measured_again_as_by_the_command_line(tmp_path):
    volume = numpy.zeros((60, 40, 20), bool)
    volume[4:56, 16:24, 6:14] = volume[20:28, 24:36, 7:13] = volume[38:44, 24:30, 7:12] = True
    skeleton = voxelcore.skeleton(volume, prune_branches=None, spacing=(0.5, 0.5, 0.5))
    skeleton.save(tmp_path / "skeleton.vtp")
    before = skeleton.measure()
    options = ["--prune-branches", "10vox", "--cut-loops", "--root", "top"]
    done = run("measure", tmp_path / "skeleton.vtp", "-o", tmp_path / "cli.csv", *options)
    assert done.returncode == 0, done.stderr
    table = skeleton.measure(prune_branches="10vox", cut_loops=True, root="top")
    lines = [line.split(",") for line in (tmp_path / "cli_branches.csv").read_text().splitlines()]
    assert 0 < len(lines) - 1 == len(table["branch_distance"]) < len(before["branch_distance"])
    for name in ("branch_distance", "mean_radius", "strahler", "level", "branch_type"):
        file = [float(line[lines[0].index(name)]) for line in lines[1:]]
        assert numpy.allclose(table[name], file, rtol=1e-6, atol=0), name
    after = skeleton.measure()
    assert all(numpy.array_equal(before[name], after[name], equal_nan=True) for name in before)
    with pytest.raises(TypeError, match="spacing"):
        skeleton.measure(spacing=(1, 1, 1))


def test_sheets_of_an_array_are_those_of_its_core(volume):
    core = voxelcore.core(volume)
    ours, theirs = voxelcore.sheets(volume, connectivity=6), voxelcore.sheets(core)  # as core() has it
    assert numpy.array_equal(ours["sheet_of_face"], theirs["sheet_of_face"]) and ours["sheets"] == theirs["sheets"]
    assert len(ours["core"].vertices) == len(core.vertices) and theirs["core"] is core
    with pytest.raises(ValueError, match="was made already"):
        voxelcore.sheets(core, label=1)
