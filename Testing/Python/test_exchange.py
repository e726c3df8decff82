"""Results in other libraries' forms hold what the result holds. Libraries that Debian lacks are stood in for by classes
with the arguments their documentation names."""

import sys
import types

import networkx
import numpy
import pandas
import pytest
import voxelcore
from conftest import run, write_nrrd
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

SPACING = (0.5, 0.5, 1)


@pytest.fixture(scope="module")
def volume():
    """A ring with a rod, and a plate."""
    i, j, k = numpy.indices((48, 48, 24))
    around = numpy.hypot(i - 20, j - 20)
    shape = (numpy.hypot(around - 12, k - 8) < 4) | (numpy.hypot(j - 20, k - 8) < 3) & (i > 30) & (i < 46)
    return (shape | (k >= 17) & (k < 20) & (i > 2) & (i < 40) & (j > 2) & (j < 40)).astype(numpy.uint8)


@pytest.fixture(scope="module")
def skeleton(volume):
    return voxelcore.skeleton(volume[:, :, :16], spacing=SPACING)


@pytest.fixture(scope="module")
def core(volume):
    return voxelcore.core(volume, spacing=SPACING)


def stand_in(monkeypatch, name, **members):
    module = types.ModuleType(name)
    for member, value in members.items():
        setattr(module, member, value)
    monkeypatch.setitem(sys.modules, name, module)


def test_a_graph_has_the_nodes_branches_and_topology(skeleton):
    ring = skeleton
    graph = ring.to_networkx()
    assert isinstance(graph, networkx.MultiGraph)
    pieces, loops = networkx.number_connected_components(graph), graph.number_of_edges() - graph.number_of_nodes()
    assert (pieces, loops + pieces) == ring.topology["betti"][:2] == (1, 1)
    table = ring.measure()
    for a, b, number, data in graph.edges(keys=True, data=True):
        assert data["branch_distance"] == table["branch_distance"][number]
        ends = data["points"][[0, -1]].tolist()
        places = [list(graph.nodes[a]["pos"]), list(graph.nodes[b]["pos"])]
        assert ends == places or ends == places[::-1]
        assert len(data["radii"]) == len(data["points"])
    assert sorted(data["kind"] for _, data in graph.nodes(data=True)).count("tip") == ring.numbers["tips"]
    assert networkx.node_link_data(networkx.Graph(networkx.create_empty_copy(graph)))


def test_a_frame_has_the_columns_of_the_table(skeleton):
    frame = skeleton.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == list(voxelcore.columns())
    for name, values in skeleton.measure().items():
        assert numpy.array_equal(frame[name], values, equal_nan=values.dtype.kind == "f"), name
    assert len(frame) == len(skeleton.branch_nodes)


def test_triangles_cover_the_polygons_as_vtks_do(core):
    faces, of_face = voxelcore._exchange.triangles(core.face_offsets, core.face_vertices)
    corners = core.vertices[faces]
    area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    triangulated = vtkTriangleFilter()
    triangulated.PassVertsOff()
    triangulated.PassLinesOff()
    triangulated.SetInputData(core.to_polydata())
    triangulated.Update()
    assert len(faces) == triangulated.GetOutput().GetNumberOfPolys() == len(of_face)
    recorded = core.report["labels"][0]["pruned"][0]["area_mm2"]
    assert area.sum() == pytest.approx(recorded, rel=1e-9)
    assert numpy.bincount(of_face).tolist() == (numpy.diff(core.face_offsets.astype(int)) - 2).tolist()


def test_a_trimesh_gets_vertices_faces_and_measures(monkeypatch, core):
    stand_in(monkeypatch, "trimesh", Trimesh=lambda **given: given)
    given = core.to_trimesh()
    assert given["process"] is False and numpy.array_equal(given["vertices"], core.vertices)
    assert given["faces"].max() < len(core.vertices) and given["faces"].shape[1] == 3
    assert len(given["vertex_attributes"]["radius"]) == len(core.vertices)
    assert len(given["face_attributes"]["lambda"]) == len(given["faces"])


def test_pyvista_wraps_the_polydata(monkeypatch, core, skeleton):
    stand_in(monkeypatch, "pyvista", wrap=lambda data: ("wrapped", data))
    for result in (core, skeleton):
        word, data = result.to_pyvista()
        assert word == "wrapped" and data.GetNumberOfPoints() == len(
            result.vertices if isinstance(result, voxelcore.Core) else result.points)


def test_napari_layers_are_in_numpys_order_of_axes(core, skeleton):
    (data, arguments, kind), *_ = core.to_napari()
    vertices, faces, values = data
    assert kind == "surface" and numpy.array_equal(vertices[:, ::-1], core.vertices)
    assert faces.dtype == numpy.int64 and len(values) == len(vertices) and "name" in arguments
    (paths, arguments, kind), (nodes, _, points) = skeleton.to_napari()
    assert (kind, points) == ("shapes", "points") and arguments["shape_type"] == "path"
    assert len(paths) == len(skeleton.branch_nodes) == len(arguments["features"]["branch_distance"])
    assert numpy.array_equal(paths[0][:, ::-1], skeleton.branch(0)) and len(nodes) == len(skeleton.node_points)


def test_an_osteoid_joins_the_points_along_branches(monkeypatch, skeleton):
    stand_in(monkeypatch, "osteoid", Skeleton=lambda **given: given)
    given = skeleton.to_osteoid(scale=1e6)
    assert given["vertices"].dtype == given["radii"].dtype == numpy.float32 and given["edges"].dtype == numpy.uint32
    expected = {
        tuple(pair)
        for number in range(len(skeleton.branch_nodes))
        for points in [skeleton.branch_points[slice(*skeleton.branch_offsets[number : number + 2])]]
        for pair in zip(points[:-1].tolist(), points[1:].tolist())
    }
    assert set(map(tuple, given["edges"].tolist())) == expected and given["segid"] == 1
    assert numpy.allclose(given["vertices"], skeleton.points * 1e6)


def test_an_swc_has_the_bytes_of_the_command_line(tmp_path, volume, skeleton):
    write_nrrd(tmp_path / "scan.nrrd", volume[:, :, :16], SPACING)
    done = run("skeleton", tmp_path / "scan.nrrd", "--also", "swc", "-o", tmp_path / "scan.vtp")
    assert done.returncode == 0, done.stderr
    skeleton.to_swc(tmp_path / "python.swc")
    assert (tmp_path / "python.swc").read_bytes() == (tmp_path / "scan.swc").read_bytes()
    with pytest.raises(OSError, match="exists"):
        skeleton.to_swc(tmp_path / "python.swc")
    with pytest.raises(ValueError, match="ends in .swc"):
        skeleton.to_swc(tmp_path / "python.txt")


def test_a_missing_library_is_named(monkeypatch, core):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match="needs the package trimesh"):
        core.to_trimesh()
