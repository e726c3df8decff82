"""Paths in the place of arrays, names of labels, and what read() gives back of files."""

import csv
import json
import pathlib
import struct

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd

SPACING = (0.5, 0.5, 1.0)
PLACE = {"origin": (5, -6, 7), "direction": [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}


@pytest.fixture
def scan(tmp_path):
    """Two rods, named by a list beside the file."""
    volume = numpy.zeros((30, 16, 12), numpy.uint8)
    volume[2:28, 2:7, 2:7] = 3
    volume[2:20, 9:14, 3:9] = 8
    path = tmp_path / "bones.nrrd"
    write_nrrd(path, volume, SPACING, **PLACE)
    (tmp_path / "bones.txt").write_text("3\tFemur left\n8\tTibia\n")
    return path, volume


def test_a_path_stands_for_the_array_and_its_place(scan):
    path, volume = scan
    for given in (path, str(path), voxelcore.read(path)):
        found = voxelcore.core(given, label=3)
        wanted = voxelcore.core(volume, label=3, spacing=SPACING, **PLACE)
        assert numpy.array_equal(found.vertices, wanted.vertices) and found.unit == "mm"
    curve = voxelcore.skeleton(str(path), label=8)
    assert numpy.array_equal(curve.points, voxelcore.skeleton(volume, label=8, spacing=SPACING, **PLACE).points)
    assert voxelcore.verify(found, path).passed
    thick = voxelcore.thickness(path, label="all")
    assert thick.map.shape == volume.shape and set(thick.numbers) == {3, 8}
    assert numpy.array_equal(thick.map, voxelcore.thickness(volume, label="all", spacing=SPACING).map)
    with pytest.raises(ValueError, match="no-such.nrrd"):
        voxelcore.skeleton("no-such.nrrd")


def test_labels_of_a_file_have_names(scan):
    path, volume = scan
    assert voxelcore.core(path, label="femur LEFT").label == 3
    assert set(voxelcore.core(path, label=["Tibia", 3])) == {3, 8}
    with pytest.raises(ValueError, match="no label of this name; the names are 'Femur left', 'Tibia'; did you"):
        voxelcore.core(path, label="Tibula")
    with pytest.raises(ValueError, match="names are for files"):
        voxelcore.core(volume, label="Tibia")
    with pytest.raises(TypeError, match="did you mean 'label'"):
        voxelcore.skeleton(volume, labels=3)


def test_read_gives_what_was_written(scan, tmp_path):
    path, volume = scan
    assert run("core", path, "-o", tmp_path / "core.vtp").returncode == 0
    cores = voxelcore.read(tmp_path / "core.vtp")
    assert set(cores) == {3, 8} and cores[8].verify(path).passed
    assert run("skeleton", path, "-o", tmp_path / "lines.vtp", "--also", "csv").returncode == 0
    curves = voxelcore.read(tmp_path / "lines.vtp")
    assert set(curves) == {3, 8}
    for label, curve in curves.items():
        made = voxelcore.skeleton(path, label=label)
        assert isinstance(curve, voxelcore.Skeleton) and curve.numbers == made.numbers
        assert numpy.array_equal(curve.points, made.points) and curve.topology == made.topology
        assert curve.names == {label: {3: "Femur left", 8: "Tibia"}[label]}
    table = voxelcore.read(tmp_path / "lines_branches.csv")
    assert table["label"].tolist() == [3, 8] and table["name"].tolist() == ["Femur left", "Tibia"]
    one = curves[8]
    one.save(tmp_path / "one.vtp")
    assert numpy.array_equal(voxelcore.read(tmp_path / "one.vtp").points, one.points)
    with pytest.raises(ValueError, match="no medial surface"):
        one.save(tmp_path / "two.vtp", also="ma")
    volume_again = voxelcore.read(path)
    assert numpy.array_equal(volume_again.array, volume) and volume_again.spacing == SPACING
    assert volume_again.names == {3: "Femur left", 8: "Tibia"}
    one.save(tmp_path / "one.npz")
    arrays = voxelcore.read(tmp_path / "one.npz")
    assert numpy.array_equal(arrays["points"], one.points) and json.loads(str(arrays["report"]))["labels"]
    with pytest.raises(OSError, match="overwrite=True"):
        one.save(tmp_path / "one.npz")
    with pytest.raises(ValueError, match="it is no VTK file|cannot read"):
        (tmp_path / "bad.vtp").write_text("nothing")
        voxelcore.read(tmp_path / "bad.vtp")


def test_frames_have_the_columns_and_values_of_the_table(scan, tmp_path):
    pandas = pytest.importorskip("pandas")
    path, _ = scan
    assert run("skeleton", path, "--labels", "8", "-o", tmp_path / "a.vtp", "--also", "csv").returncode == 0
    frame = voxelcore.skeleton(path, label=8).to_pandas()
    table = pandas.read_csv(tmp_path / "a_branches.csv")
    assert list(frame.columns) == list(table.columns)
    for name in table.columns:
        ours, theirs = frame[name], table[name]
        if theirs.dtype == object or theirs.isna().all():
            continue
        assert numpy.allclose(ours.astype(float), theirs, rtol=1e-6), name


def read_skeleton(folder, segment):
    """A precomputed skeleton, by the specification."""
    info = json.loads((folder / "info").read_text())
    assert info["@type"] == "neuroglancer_skeletons"
    data = (folder / str(segment)).read_bytes()
    points, edges = struct.unpack_from("<II", data)
    at = 8
    vertices = numpy.frombuffer(data, "<f4", 3 * points, at).reshape(-1, 3)
    at += 12 * points
    pairs = numpy.frombuffer(data, "<u4", 2 * edges, at).reshape(-1, 2)
    at += 8 * edges
    attributes = {}
    for attribute in info["vertex_attributes"]:
        count = points * attribute["num_components"]
        attributes[attribute["id"]] = numpy.frombuffer(data, attribute["data_type"], count, at)
        at += attributes[attribute["id"]].nbytes
    assert at == len(data)
    return vertices, pairs, attributes


def test_precomputed_skeletons_are_those_of_the_specification(scan, tmp_path):
    path, _ = scan
    curves = {label: voxelcore.skeleton(path, label=label) for label in (3, 8)}
    voxelcore.precomputed(curves, tmp_path / "all")
    assert run("skeleton", path, "-o", tmp_path / "b.vtp", "--also", "precomputed").returncode == 0
    for folder in (tmp_path / "all", tmp_path / "b_precomputed"):
        names = json.loads((folder / "names/info").read_text())["inline"]
        told = dict(zip(names["ids"], names["properties"][0]["values"]))
        # The program knows the names beside the file; to Python its voxels are an array.
        assert told == ({"3": "Femur left", "8": "Tibia"} if folder.name.startswith("b") else
                        {"3": "label-3", "8": "label-8"})
        for label, curve in curves.items():
            vertices, pairs, attributes = read_skeleton(folder, label)
            order = numpy.lexsort(vertices.T)
            used = numpy.unique(curve.branch_points)
            wanted = (curve.points[used] * 1e6).astype("f4")
            assert numpy.array_equal(vertices[order], wanted[numpy.lexsort(wanted.T)])
            radii = (curve.radius[used] * 1e6).astype("f4")
            assert numpy.allclose(attributes["radius"][order], radii[numpy.lexsort(wanted.T)], rtol=1e-6)
            length = numpy.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1).sum()
            assert abs(length / 1e6 - curve.numbers["total_length"]) < 1e-4 * length
    with pytest.raises(OSError, match="overwrite=True"):
        curves[3].to_precomputed(tmp_path / "all")
    with pytest.raises(ValueError, match="no voxel size"):
        voxelcore.skeleton(numpy.ones((5, 5, 20), "u1")).to_precomputed(tmp_path / "none")


def test_two_thousand_labels_fit_one_precomputed_folder(tmp_path):
    rods = numpy.zeros((40, 60, 100), numpy.uint16)
    labels = numpy.arange(1, 2001).reshape(10, 10, 20)
    rods.reshape(10, 4, 10, 6, 20, 5)[:, 0:3, :, 0:5, :, 0:3] = labels[:, None, :, None, :, None]
    write_nrrd(tmp_path / "many.nrrd", rods, (0.01, 0.01, 0.04))
    made = run("skeleton", tmp_path / "many.nrrd", "-o", tmp_path / "many.vtp", "--also", "precomputed")
    assert made.returncode == 0, made.stderr
    folder = tmp_path / "many_precomputed"
    for label in (1, 2, 999, 2000):
        vertices, _, _ = read_skeleton(folder, label)
        place = numpy.argwhere(rods == label) * (0.01, 0.01, 0.04) * 1e6
        half = numpy.array((0.01, 0.01, 0.04)) / 2 * 1e6 + 1  # branches run up to the scan's border
        assert (vertices >= place.min(0) - half).all() and (vertices <= place.max(0) + half).all() and len(vertices)
    assert len(list(folder.iterdir())) == 2002


def test_precomputed_meshes_are_those_of_the_specification(tmp_path):
    surface = voxelcore.core(blobs(5), spacing=(0.5, 0.5, 1), lambda_=0)
    surface.to_precomputed(tmp_path / "mesh")
    info = json.loads((tmp_path / "mesh/info").read_text())
    assert info["@type"] == "neuroglancer_legacy_mesh"
    fragments = json.loads((tmp_path / f"mesh/{surface.label}:0").read_text())["fragments"]
    data = (tmp_path / "mesh" / fragments[0]).read_bytes()
    (count,) = struct.unpack_from("<I", data)
    points = numpy.frombuffer(data, "<f4", 3 * count, 4).reshape(-1, 3)
    corners = numpy.frombuffer(data, "<u4", -1, 4 + 12 * count).reshape(-1, 3)
    assert numpy.array_equal(points, (surface.vertices * 1e6).astype("f4")) and corners.max() < count
    sides = points[corners]
    area = numpy.linalg.norm(numpy.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]), axis=1).sum() / 2e12
    assert abs(area - surface.report["labels"][0]["pruned"][0]["area_mm2"]) < 1e-4 * area


def test_obj_holds_a_line_a_branch(scan, tmp_path):
    path, _ = scan
    curve = voxelcore.skeleton(path, label=8)
    curve.save(tmp_path / "a.vtp", also=["obj"])
    lines = (tmp_path / "a.obj").read_text().splitlines()
    points = numpy.array([line.split()[1:] for line in lines if line.startswith("v ")], float)
    runs = [list(map(int, line.split()[1:])) for line in lines if line.startswith("l ")]
    assert len(runs) == len(curve.branch_nodes)
    for number, run_ in enumerate(runs):
        assert numpy.allclose(points[numpy.array(run_) - 1], curve.branch(number), atol=1e-6)


def test_results_are_drawn(scan):
    pytest.importorskip("matplotlib").use("Agg")
    path, _ = scan
    curve, surface = voxelcore.skeleton(path, label=8), voxelcore.core(path, label=8)
    for result in (curve, surface):
        axes = result.plot()
        assert len(axes.collections) >= 1 and "LPS, mm" in axes.get_xlabel()
        page = result._repr_html_()
        assert "data:image/png;base64," in page and "8 label-8" in page and "<table>" in page


def test_tables_read_as_columns(tmp_path):
    path = pathlib.Path(tmp_path / "a.csv")
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([["n", "x", "name"], [1, "", "a,b"], [2, 0.5, "c"]])
    table = voxelcore.read(path)
    assert table["n"].tolist() == [1, 2] and numpy.isnan(table["x"][0]) and table["name"].tolist() == ["a,b", "c"]
