"""The panel of the Slicer module on PyQt5, off screen, with PythonQt's rules: what a user does, and what is shown."""

import os
import re
import sys
import textwrap
import time

import numpy
import pytest
import slicer
from conftest import MODULE, PROGRAM, ROOT, body, run, segmentationOf, writeLabels

pytest.importorskip("PyQt5.QtWidgets", reason="python3-pyqt5 is not here")
import panel  # noqa: E402
from VoxelCoreLib import Scene, Surfaces  # noqa: E402
from VoxelCoreLib.Settings import PRESETS, Settings  # noqa: E402

import VoxelCore  # noqa: E402


@pytest.fixture
def widget(scene):
    made = VoxelCore.VoxelCoreWidget(panel.Parent())
    made.setup()
    yield made
    made.cleanup()


def click(button):
    button.__dict__["object"].click()


def choose(combo, text):
    """As a user does it: the signal activated comes."""
    box = combo.__dict__["object"]
    index = box.findText(text)
    assert index >= 0, f"{text!r} is not offered"
    box.setCurrentIndex(index)
    box.activated[int].emit(index)


def untilDone(widget, seconds=60):
    end = time.monotonic() + seconds
    while widget.logic.isRunning():
        assert time.monotonic() < end
        panel.application.processEvents()
        time.sleep(0.01)


def shown(widget, name):
    """Whether it would be seen in a window."""
    return not getattr(widget.ui, name).__dict__["object"].isHidden()


def test_first_minutes_of_a_user(widget, scene, tmp_path):
    """Choose, press Apply, look, move the slider, colour: and the results are those of the program."""
    assert not widget.ui.applyButton.enabled
    node = segmentationOf(body(2), names={1: "stem", 2: "plate"})
    widget.ui.segmentationSelector.setCurrentNode(node)
    assert widget.ui.applyButton.enabled and not widget.ui.cancelButton.enabled
    assert widget.segmentIds() == ["Segment_1", "Segment_2"]
    widget.ui.segmentsTableView.setSelectedSegmentIDs(["Segment_1"])
    widget.ui.thicknessCheckBox.checked = True
    click(widget.ui.applyButton)
    assert slicer.util.errors == []
    assert widget.ui.cancelButton.enabled and not widget.ui.applyButton.enabled and shown(widget, "progressBar")
    untilDone(widget)
    assert slicer.util.errors == [] and widget.ui.statusLabel.text == "Done."
    assert widget.ui.applyButton.enabled and not shown(widget, "progressBar")
    surface = widget.ui.surfaceSelector.currentNode()
    assert surface.GetName() == "stem medial surface" and widget.ui.surfaceSelector.nodeCount() == 1
    slider = widget.ui.toleranceSlider
    low, high = Surfaces.toleranceRange(Scene.wholeOf(surface).GetPolyData())
    assert (slider.minimum, slider.maximum, slider.value) == (low, high, low)
    cells = surface.GetPolyData().GetNumberOfCells()
    slider.value = high
    left = surface.GetPolyData().GetNumberOfCells()
    assert 0 < left < cells
    slider.value = low
    assert surface.GetPolyData().GetNumberOfCells() == cells
    choose(widget.ui.colorComboBox, "Radius")
    assert surface.GetDisplayNode().GetActiveScalarName() == "Radius"
    choose(widget.ui.colorComboBox, "Segment")
    assert not surface.GetDisplayNode().GetScalarVisibility()
    writeLabels(tmp_path / "labels.nrrd", body())
    out = run("skeleton", tmp_path / "labels.nrrd", "-o", tmp_path / "s.vtp").stdout
    branches = next(node for node in scene.nodes.values() if node.GetAttribute(Scene.ROLE) == "branches")
    assert str(branches.GetTable().GetNumberOfRows()) in out


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_set_every_widget(widget, preset):
    choose(widget.ui.presetComboBox, preset)
    assert widget.settings() == PRESETS[preset][1]
    assert widget.ui.statusLabel.text == PRESETS[preset][0]


def test_settings_are_kept_in_the_scene(widget):
    widget.ui.toleranceLineEdit.text = "2vox"
    widget.ui.toleranceLineEdit.__dict__["object"].editingFinished.emit()
    widget.ui.threadsSpinBox.value = 1
    widget.ui.borderComboBox.__dict__["object"].setCurrentText("drop")
    stored = Settings.fromText(widget.logic.getParameterNode().GetParameter("Settings"))
    assert (stored.tolerance, stored.threads, stored.border) == ("2vox", 1, "drop")
    again = VoxelCore.VoxelCoreWidget(panel.Parent())
    again.setup()
    assert again.settings() == stored
    again.cleanup()


def test_cancel_stops_and_leaves_the_scene_as_it_was(widget, scene):
    widget.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    before = set(scene.nodes)
    click(widget.ui.applyButton)
    for _ in range(20):
        panel.application.processEvents()
        time.sleep(0.01)
    click(widget.ui.cancelButton)
    assert not widget.logic.isRunning() and set(scene.nodes) == before
    assert widget.ui.statusLabel.text.startswith("Stopped") and widget.ui.applyButton.enabled


def test_closing_the_scene_stops_what_runs(widget, scene):
    widget.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    click(widget.ui.applyButton)
    scene.Clear()
    assert not widget.logic.isRunning() and not widget.ui.applyButton.enabled
    assert [node for node in scene.nodes.values() if node.GetAttribute(Scene.ROLE)] == []


@pytest.mark.parametrize("what", ["tolerance", "program"])
def test_errors_are_shown_as_one_line(widget, scene, what):
    widget.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    if what == "tolerance":
        widget.ui.toleranceLineEdit.text = "banana"
    else:
        widget.ui.programPathLineEdit.currentPath = "/nowhere/voxelcore"
    before = set(scene.nodes)
    click(widget.ui.applyButton)
    untilDone(widget)
    assert len(slicer.util.errors) == 1 and "\n" not in slicer.util.errors[0]
    assert ("banana" if what == "tolerance" else "/nowhere/voxelcore") in slicer.util.errors[0]
    assert widget.ui.statusLabel.text == slicer.util.errors[0]
    assert set(scene.nodes) == before and widget.ui.applyButton.enabled


def test_program_of_the_users_choice_computes_and_is_remembered(widget, scene):
    widget.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    widget.ui.programPathLineEdit.currentPath = PROGRAM
    click(widget.ui.applyButton)
    assert widget.logic._computation.run.backend.kind == "program"
    untilDone(widget)
    assert slicer.util.errors == [] and slicer.app.settings().value("VoxelCore/Program") == PROGRAM


def test_surface_that_was_removed_leaves_an_empty_slider(widget, scene):
    widget.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    click(widget.ui.applyButton)
    untilDone(widget)
    assert widget.ui.toleranceSlider.enabled
    scene.RemoveNode(widget.ui.surfaceSelector.currentNode())
    assert not widget.ui.toleranceSlider.enabled and widget.ui.colorComboBox.currentText == ""
    widget.ui.toleranceSlider.value = 3.0  # asks nobody for anything


def test_module_tests_itself(scene, monkeypatch):
    """What 'Reload and Test' runs in Slicer."""
    test = VoxelCore.VoxelCoreTest()
    test.runTest()


def test_script_of_the_guide_runs(scene):
    page = open(os.path.join(ROOT, "Applications", "manual", "guide", "slicer.md"), encoding="utf-8").read()
    lines = re.search(r"## From a script\n\n((?:    .*\n)+)", page).group(1)
    segmentationOf(body(), name="Segmentation")
    names = {"slicer": slicer}
    exec(textwrap.dedent(lines), names)
    assert {"surface", "skeleton", "thickness"} <= {node.GetAttribute(Scene.ROLE) for node in names["nodes"]}


def test_picture_in_the_guide_is_that_of_todays_panel(scene, tmp_path):
    import panel_picture
    from PyQt5.QtGui import QImage

    panel_picture.draw(tmp_path / "panel.png")
    today, shown = (QImage(str(path)).convertToFormat(QImage.Format_Grayscale8) for path in (
        tmp_path / "panel.png", os.path.join(ROOT, "Applications/manual/guide/slicer-panel.png")))
    sides = today.width(), today.height()
    assert sides == (shown.width(), shown.height()), "run panel_picture.py, and look at the picture"
    values = [numpy.frombuffer(image.constBits().asstring(image.sizeInBytes()), numpy.uint8).reshape(sides[1], -1)
              for image in (today, shown)]
    assert (abs(values[0].astype(int) - values[1]) > 60).mean() < 0.005
    assert (values[0] < 100).mean() > 0.01, "there is text"


def opened():
    made = VoxelCore.VoxelCoreWidget(panel.Parent())
    made.setup()
    return made


def test_first_run_says_who_computes_and_that_nothing_is_installed_until_it_is_understood(scene):
    version = run("--version").stdout.split()[1]
    slicer.app.settings().setValue("VoxelCore/Program", PROGRAM)
    first = opened()
    said = first.ui.firstRunLabel.text
    assert shown(first, "firstRunCollapsibleButton") and f"The program {PROGRAM}, version {version}, computes" in said
    assert "Nothing is installed" in said and "no data leave" in said and "Undo" in said
    assert version in first.ui.applyButton.toolTip
    # What the user chooses is said at once, also where it will not do.
    for wrong in ("/nowhere/voxelcore", "/bin/true"):
        first.ui.programPathLineEdit.currentPath = wrong
        assert wrong in first.ui.firstRunLabel.text and "installs nothing" in first.ui.firstRunLabel.text
        assert wrong in first.ui.statusLabel.text and "\n" not in first.ui.statusLabel.text
    first.ui.programPathLineEdit.currentPath = PROGRAM
    assert said == first.ui.firstRunLabel.text and first.ui.statusLabel.text == ""
    click(first.ui.firstRunButton)
    assert not shown(first, "firstRunCollapsibleButton") and slicer.util.errors == []
    first.cleanup()
    again = opened()
    assert not shown(again, "firstRunCollapsibleButton")
    again.cleanup()


def test_first_run_names_the_package_where_it_computes(scene):
    first = opened()  # no program on the path of these tests
    import voxelcore

    assert f"The package voxelcore of {sys.executable}, version {voxelcore.__version__}" in first.ui.firstRunLabel.text
    first.ui.segmentationSelector.setCurrentNode(segmentationOf(body()))
    click(first.ui.applyButton)
    assert not shown(first, "firstRunCollapsibleButton")
    first.cleanup()
    again = opened()
    assert not shown(again, "firstRunCollapsibleButton")
    again.cleanup()


def test_panel_without_program_and_package_says_what_to_do_before_anything_is_pressed(scene, monkeypatch):
    line = "the program voxelcore is not here; choose it"

    def find(program=""):
        raise VoxelCore.VoxelCoreError(line)

    monkeypatch.setattr(VoxelCore.Backend, "find", find)
    bare = opened()
    assert bare.ui.statusLabel.text == line and line in bare.ui.firstRunLabel.text and slicer.util.errors == []
    bare.cleanup()


def test_module_says_what_it_is():
    class Parent:
        pass

    module = VoxelCore.VoxelCore(Parent())
    assert module.parent.title == "VoxelCore" and module.parent.categories == ["Surface Models"]
    assert MODULE.endswith("slicer/VoxelCore")
