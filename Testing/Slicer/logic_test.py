"""The work of the Slicer module, without Slicer: every action on a scene of the stub, held against the program."""

import csv
import json
import os

import conftest
import numpy
import pytest
import slicer
import vtk
from conftest import (
    EVERYTHING,
    EXACT,
    OBLIQUE,
    body,
    compute,
    lpsPoints,
    phantom,
    pointsOf,
    rasIndex,
    roles,
    run,
    segmentationOf,
    writeLabels,
)
from VoxelCoreLib import Cancelled, Scene, Segments, Surfaces, Tables, Volumes, VoxelCoreError
from VoxelCoreLib.Computation import Computation
from VoxelCoreLib.Settings import PRESETS, Settings

# Refinement smooths in single precision, in tiles counted from the first voxel: within the box of a segment places
# come out by this much (mm) elsewhere than within the scan. Nothing else does.
REFINED = 2e-3


def test_surface_and_skeleton_are_the_programs_turned_to_ras(backend, tmp_path):
    voxels = body()
    node = segmentationOf(voxels)
    writeLabels(tmp_path / "labels.nrrd", voxels)
    found = roles(compute(node, Settings(), backend))
    for role, words in (("surface", ["core"]), ("skeleton", ["skeleton"])):
        path = tmp_path / f"{role}.vtp"
        run(*words, tmp_path / "labels.nrrd", "-o", path, "--quiet")
        expected, model = lpsPoints(path)
        shown = found[role][0].GetPolyData()
        near = REFINED if role == "surface" else 1e-9
        assert numpy.allclose(pointsOf(found[role][0]), expected * (-1, -1, 1), rtol=0, atol=near)
        assert [shown.GetNumberOfVerts(), shown.GetNumberOfLines(), shown.GetNumberOfPolys()] == [
            model.GetNumberOfVerts(), model.GetNumberOfLines(), model.GetNumberOfPolys()]
        assert shown.GetFieldData().GetAbstractArray("SPACE") is None
        index = rasIndex(pointsOf(found[role][0]), OBLIQUE)
        assert (voxels[index[2], index[1], index[0]] == 1).all(), role


def test_polygons_keep_their_side_of_a_turned_scan(package):
    """The normal of a polygon is that of the file, turned: x and y change sign together."""
    node = segmentationOf(body())
    surface = roles(compute(node, Settings(skeleton=False), package))["surface"][0].GetPolyData()
    corners = vtk.vtkIdList()
    surface.GetPolys().InitTraversal()
    surface.GetPolys().GetNextCell(corners)
    places = [numpy.array(surface.GetPoint(corners.GetId(at))) for at in range(3)]
    inRas = numpy.cross(places[1] - places[0], places[2] - places[0])
    flat = [place * (-1, -1, 1) for place in places]
    inLps = numpy.cross(flat[1] - flat[0], flat[2] - flat[0])
    assert numpy.allclose(inRas, inLps * (-1, -1, 1))


def test_map_is_the_programs_and_lies_on_the_segment(backend, tmp_path):
    voxels = body()
    node = segmentationOf(voxels)
    writeLabels(tmp_path / "labels.nrrd", voxels)
    run("thickness", tmp_path / "labels.nrrd", "-o", tmp_path / "map.nrrd", "--refine", "off", "--quiet")
    expected = Volumes.readMap(str(tmp_path / "map.nrrd"))
    volume = roles(compute(node, EXACT, backend))["thickness"][0]
    map = slicer.util.arrayFromVolume(volume)
    matrix = vtk.vtkMatrix4x4()
    volume.GetIJKToRASMatrix(matrix)
    k, j, i = numpy.nonzero(map)
    places = (Segments.matrixOf(matrix) @ numpy.vstack([i, j, k, numpy.ones(len(i))]))[:3].T
    index = rasIndex(places, OBLIQUE)
    assert len(i) == (voxels == 1).sum()
    assert (voxels[index[2], index[1], index[0]] == 1).all()
    assert (map[k, j, i] == expected[index[2], index[1], index[0]]).all()


def test_box_may_begin_anywhere_and_places_stay(package):
    voxels = body()
    whole = segmentationOf(voxels)
    cut = segmentationOf(voxels[5:, 2:, 3:], start=(3, 2, 5), scanSize=(34, 30, 26), name="cut")
    first, second = (pointsOf(roles(compute(node, Settings(skeleton=False), package))["surface"][0])
                     for node in (whole, cut))
    assert first.shape == second.shape and numpy.allclose(first, second, rtol=0, atol=1e-9)


def test_margin_is_background_but_for_where_the_scan_ends(backend, tmp_path):
    """Voxels whose ball touches the border of the scan are those the program finds in the whole scan."""
    voxels = numpy.zeros((20, 24, 40), numpy.uint8)
    voxels[6:14, 7:17, 0:30] = 1  # cut off at i = 0
    node = segmentationOf(voxels)
    writeLabels(tmp_path / "labels.nrrd", voxels)
    run("thickness", tmp_path / "labels.nrrd", "-o", tmp_path / "m.nrrd", "--table", tmp_path / "m.csv", "--refine",
        "off", "--quiet")
    expected = next(csv.DictReader(open(tmp_path / "m.csv")))
    volume = Segments.readSegment(node, "Segment_1")
    assert volume.voxels.shape == (8 + 4, 10 + 4, 30 + 2)
    computation = Computation(node, ["Segment_1"], EXACT, backend, slicer.app.temporaryPath)
    computation.wait(slicer.mrmlScene)
    assert int(computation.results[0].thickness["border_voxels"]) == int(expected["border_voxels"]) > 0


def test_overlapping_segments_are_measured_each_by_itself(backend):
    voxels = body()
    node = segmentationOf(voxels)
    second = voxels.copy()
    second[8:18, 4:14, 20:30] = 0
    segmentation = node.GetSegmentation()
    segmentation.AddEmptySegment("over", "over")
    segmentation.GetSegment("over").image = conftest.orientedImage(second, OBLIQUE)
    nodes = roles(compute(node, Settings(surface=False, skeleton=False, thickness=True), backend))["thickness"]
    counts = [int((slicer.util.arrayFromVolume(map) > 0).sum()) for map in nodes]
    assert counts == [int((voxels > 0).sum()), int((second > 0).sum())]


def test_results_stay_under_the_transform_of_the_segmentation(package):
    transform = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLLinearTransformNode", "moved")
    node = segmentationOf(body())
    node.SetAndObserveTransformNodeID(transform.GetID())
    for role, found in roles(compute(node, EVERYTHING, package)).items():
        for result in found:
            if isinstance(result, slicer.vtkMRMLTransformableNode):
                assert result.GetTransformNodeID() == transform.GetID(), role


def test_slider_shows_what_the_program_prunes_to(tmp_path, backend):
    """Of a whole core the cells at a greater tolerance are those that the program leaves."""
    voxels = body()
    node = segmentationOf(voxels)
    writeLabels(tmp_path / "labels.nrrd", voxels)
    surface = roles(compute(node, Settings(skeleton=False, tolerance="0", refine=False), backend))["surface"][0]
    before = surface.GetPolyData()
    low, high = Surfaces.toleranceRange(Scene.wholeOf(surface).GetPolyData())
    assert low < high
    for value in ("1.2", "1.5", "2"):
        run("core", tmp_path / "labels.nrrd", "-o", tmp_path / "p.vtp", "--tolerance", value + "mm", "--refine", "off",
            "--force", "--quiet")
        points, expected = lpsPoints(tmp_path / "p.vtp")
        Scene.setTolerance(surface, float(value))
        shown = surface.GetPolyData()
        assert shown.GetNumberOfPolys() == expected.GetNumberOfPolys() > 0
        used = numpy.unique(Surfaces.numpy_support.vtk_to_numpy(shown.GetPolys().GetConnectivityArray()))
        of = numpy.unique(Surfaces.numpy_support.vtk_to_numpy(expected.GetPolys().GetConnectivityArray()))
        sort = lambda places: places[numpy.lexsort(places.T.round(6))]  # noqa: E731
        assert numpy.allclose(sort(Surfaces.numpyPoints(shown)[used]), sort(points[of] * (-1, -1, 1)), atol=1e-9)
        for index in range(shown.GetCellData().GetNumberOfArrays()):
            assert shown.GetCellData().GetArray(index).GetNumberOfTuples() == shown.GetNumberOfCells()
    Scene.setTolerance(surface, low)
    assert surface.GetPolyData().GetNumberOfCells() == before.GetNumberOfCells()


def test_slider_of_a_surface_that_lost_its_whole_says_so(package):
    node = segmentationOf(body())
    surface = roles(compute(node, Settings(skeleton=False), package))["surface"][0]
    slicer.mrmlScene.RemoveNode(Scene.wholeOf(surface))
    with pytest.raises(VoxelCoreError, match="compute it again"):
        Scene.setTolerance(surface, 2.0)


def test_colours_run_over_the_array_chosen(package):
    node = segmentationOf(body())
    surface = roles(compute(node, Settings(skeleton=False, thickness=True), package))["surface"][0]
    assert Scene.arraysOf(surface)[:2] == ["Thickness", "Radius"]
    display = surface.GetDisplayNode()
    assert display.GetActiveScalarName() == "Thickness" and display.GetColorNode() is not None
    for name in Scene.arraysOf(surface):
        Scene.colorBy(surface, name)
        low, high = display.GetScalarRange()
        values = Surfaces.array(surface.GetPolyData().GetPointData(), name)
        assert display.GetActiveScalarName() == name and display.GetScalarVisibility()
        assert values.min() <= low < high <= values.max() + 1e-6
    Scene.colorBy(surface, "")
    assert not display.GetScalarVisibility()


def test_thickness_on_the_surface_is_that_of_the_map_beside_it(package):
    node = segmentationOf(body())
    found = roles(compute(node, Settings(skeleton=False, thickness=True), package))
    surface, volume = found["surface"][0].GetPolyData(), found["thickness"][0]
    matrix = vtk.vtkMatrix4x4()
    volume.GetIJKToRASMatrix(matrix)
    map = slicer.util.arrayFromVolume(volume)
    index = rasIndex(Surfaces.numpyPoints(surface), Segments.matrixOf(matrix))
    values = Surfaces.array(surface.GetPointData(), "Thickness")
    assert (values == map[index[2], index[1], index[0]]).all() and (values > 0).mean() > 0.95


def column(table, name):
    found = table.GetTable().GetColumnByName(name)
    return [found.GetValue(row) for row in range(found.GetNumberOfValues())]


def test_tables_have_the_programs_numbers_names_and_units(backend, tmp_path):
    voxels = body(2)
    node = segmentationOf(voxels, names={1: "stem", 2: "plate"})
    writeLabels(tmp_path / "labels.nrrd", voxels)
    off = "--refine", "off", "--quiet"
    run("core", tmp_path / "labels.nrrd", "-o", tmp_path / "c.vtp", "--report", tmp_path / "c.json", *off)
    run("skeleton", tmp_path / "labels.nrrd", "-o", tmp_path / "s.vtp", "--table", tmp_path / "s.csv", "--quiet")
    run("thickness", tmp_path / "labels.nrrd", "-o", tmp_path / "m.nrrd", "--table", tmp_path / "m.csv", *off)
    found = roles(compute(node, EXACT, backend))
    summary = found["summary"][0]
    labels = json.load(open(tmp_path / "c.json"))["labels"]
    maps = list(csv.DictReader(open(tmp_path / "m.csv")))
    assert column(summary, "segment") == ["stem", "plate"]
    assert column(summary, "voxels") == [label["voxels"] for label in labels]
    assert column(summary, "components") == [label["shape"]["betti"][0] for label in labels]
    assert numpy.allclose(column(summary, "volume"), [label["volume_mm3"] for label in labels])
    areas = [label["pruned"][0]["area_mm2"] for label in labels]
    assert numpy.allclose(column(summary, "surface_area"), areas, rtol=1e-6)
    assert numpy.allclose(column(summary, "thickness_mean"), [float(row["mean"]) for row in maps], rtol=1e-5)
    assert summary.GetColumnUnitLabel("surface_area") == "mm2" and summary.GetColumnUnitLabel("voxels") == ""
    rows = list(csv.DictReader(open(tmp_path / "s.csv")))
    for table, label in zip(found["branches"], ("1", "2")):
        own = [row for row in rows if row["label"] == label]
        assert numpy.allclose(column(table, "branch_distance"), [float(row["branch_distance"]) for row in own])
        assert set(column(table, "name")) <= {"stem", "plate"}
        assert table.GetColumnUnitLabel("branch_distance") == "mm" and table.GetLocked()


def test_histogram_is_the_programs(tmp_path):
    voxels = body()
    writeLabels(tmp_path / "labels.nrrd", voxels)
    run("thickness", tmp_path / "labels.nrrd", "-o", tmp_path / "m.nrrd", "--table", tmp_path / "m.csv", "--quiet")
    spacing = Segments.readSegment(segmentationOf(voxels), "Segment_1").lpsGeometry()[0]
    middles, shares = Tables.histogram(Volumes.readMap(str(tmp_path / "m.nrrd")), spacing)
    rows = [row for row in csv.DictReader(open(tmp_path / "m_histogram.csv"))]
    counts = numpy.array([float(row["voxels"]) for row in rows])
    first = numpy.flatnonzero(shares)[0]
    lower = float(rows[0]["lower"]) if "lower" in rows[0] else 0.0
    at = int(round(lower / (middles[1] - middles[0])))
    assert numpy.allclose(shares[at:at + len(counts)], 100 * counts / counts.sum())
    assert first >= at and abs(shares.sum() - 100) < 1e-9


def test_plots_name_columns_that_are_there(package):
    node = segmentationOf(body())
    found = roles(compute(node, EVERYTHING, package))
    assert len(found["plot"]) == len(found["plotSeries"]) == 2
    for series in found["plotSeries"]:
        for name in (series.GetXColumnName(), series.GetYColumnName()):
            assert series.GetTableNode().GetTable().GetColumnByName(name) is not None


def test_nodes_stand_in_folders_by_segment_beside_the_segmentation(package):
    node = segmentationOf(body(2), names={1: "stem", 2: "plate"})
    hierarchy = slicer.mrmlScene.hierarchy
    study = hierarchy.CreateFolderItem(hierarchy.GetSceneItemID(), "study")
    hierarchy.SetItemParent(hierarchy.GetItemByDataNode(node), study)
    for result in compute(node, EVERYTHING, package):
        item = hierarchy.GetItemByDataNode(result)
        path = []
        while item:
            item = hierarchy.GetItemParent(item)
            path.append(hierarchy.GetItemName(item) if item else None)
        shared = [name for name in ("stem", "plate") if result.GetName().startswith(name)]
        assert path == [*shared, "scan VoxelCore", "study", "Scene", None], result.GetName()


def test_undo_takes_everything_back_and_knows_the_slider(package, scene):
    node = segmentationOf(body())
    ids = set(scene.nodes)
    surface = roles(compute(node, EVERYTHING, package))["surface"][0]
    assert set(scene.nodes) - ids
    before = surface.GetPolyData()
    cells = before.GetNumberOfCells()
    scene.SaveStateForUndo()
    Scene.setTolerance(surface, Surfaces.toleranceRange(before)[0] * 1.5)
    assert surface.GetPolyData().GetNumberOfCells() < cells
    scene.Undo()
    assert surface.GetPolyData() is before and before.GetNumberOfCells() == cells
    scene.Undo()
    assert set(scene.nodes) == ids


class Unchanged:
    """The scene is as it was, and so is the folder hierarchy."""

    def __init__(self):
        self.before = self.now()

    def now(self):
        scene = slicer.mrmlScene
        return set(scene.nodes), dict(scene.hierarchy._items)

    def check(self):
        assert self.now() == self.before


@pytest.mark.parametrize("at", [0.0, 0.3, 0.8])
def test_cancel_at_any_time_leaves_nothing(backend, tmp_path, at):
    voxels, matrix = phantom(tmp_path, "gyroid", 32)
    node = segmentationOf(voxels, matrix)
    unchanged = Unchanged()
    computation = Computation(node, ["Segment_1"], EVERYTHING, backend, slicer.app.temporaryPath)
    processes = []

    def watch(title, fraction):
        if computation.run._process is not None:
            processes.append(computation.run._process)
        return fraction < at

    with pytest.raises(Cancelled):
        computation.wait(slicer.mrmlScene, watch)
    unchanged.check()
    for process in processes:
        assert process.poll() is not None, "a process still runs"


def failing(backend, line, node, ids, settings):
    unchanged = Unchanged()
    with pytest.raises(VoxelCoreError, match=line) as caught:
        compute(node, settings, backend, ids)
    assert "\n" not in str(caught.value) and len(str(caught.value)) > 10
    unchanged.check()


def test_errors_are_one_line_and_leave_nothing(backend):
    node = segmentationOf(body())
    failing(backend, "^segment 'part 1': .*banana", node, None, Settings(tolerance="banana"))
    failing(backend, "5bananas", node, None, Settings(pruneBranches="5bananas"))
    failing(backend, "has no segment 'none'", node, ["none"], Settings())
    failing(backend, "at least one output", node, None, Settings(surface=False, skeleton=False))
    node.GetSegmentation().AddEmptySegment("empty", "nothing in it")
    failing(backend, "'nothing in it': it is empty", node, ["empty"], Settings())
    node.GetSegmentation().AddEmptySegment("background", "all 0")
    node.GetSegmentation().GetSegment("background").image = conftest.orientedImage(0 * body(), OBLIQUE)
    failing(backend, "'all 0': it is empty", node, ["background"], Settings())
    skewed = OBLIQUE.copy()
    skewed[:3, 1] += 0.1 * skewed[:3, 0]
    failing(backend, "degrees from right angles", segmentationOf(body(), skewed), None, Settings())
    failing(backend, "^segment 'part 1': nothing is left", node, ["Segment_1"], Settings(minVoxels=10**6))
    node.convertible = False
    failing(backend, "cannot be made a label map", node, ["Segment_1"], Settings())
    with pytest.raises(VoxelCoreError, match="choose a segmentation"):
        Computation(None, ["x"], Settings(), backend)
    with pytest.raises(VoxelCoreError, match="at least one segment"):
        Computation(node, [], Settings(), backend)


def test_segmentation_that_was_removed_meanwhile_gets_nothing(backend):
    node = segmentationOf(body())
    computation = Computation(node, ["Segment_1"], Settings(), backend, slicer.app.temporaryPath)
    computation.poll()
    slicer.mrmlScene.RemoveNode(node)
    unchanged = Unchanged()
    with pytest.raises(VoxelCoreError, match="was removed meanwhile"):
        computation.wait(slicer.mrmlScene)
    unchanged.check()


@pytest.mark.parametrize("className", ["vtkMRMLModelDisplayNode", "vtkMRMLScalarVolumeNode", "vtkMRMLPlotChartNode"])
def test_scene_that_refuses_a_node_keeps_none(package, scene, monkeypatch, className):
    node = segmentationOf(body())
    monkeypatch.delitem(scene.classes, className)
    unchanged = Unchanged()
    with pytest.raises(Exception):
        compute(node, EVERYTHING, package)
    unchanged.check()


def test_results_that_are_damaged_leave_nothing(package):
    node = segmentationOf(body())
    computation = Computation(node, ["Segment_1"], EVERYTHING, package, slicer.app.temporaryPath)
    computation.run.wait()
    map = next(step.output for step in computation.run.steps if step.command == "thickness")
    os.truncate(map, os.path.getsize(map) - 7)
    unchanged = Unchanged()
    with pytest.raises(Exception):
        computation.finish(slicer.mrmlScene)
    unchanged.check()


def test_progress_rises_to_the_end(backend):
    seen = []
    node = segmentationOf(body(2))
    compute(node, EVERYTHING, backend, onProgress=lambda title, fraction: seen.append((title, fraction)))
    fractions = [fraction for _, fraction in seen]
    assert fractions == sorted(fractions) and fractions[-1] > 0.6
    assert {title for title, _ in seen if title} >= {"part 1: core", "part 2: thickness"}


def test_settings_come_back_from_the_parameter_node():
    for _, settings in PRESETS.values():
        assert Settings.fromText(settings.text()) == settings
    assert Settings.fromText("") == Settings.fromText("{}") == Settings.fromText("no json") == Settings()
    assert Settings.fromText('{"surface": "yes", "unknown": 3, "threads": 2}') == Settings(threads=2)
