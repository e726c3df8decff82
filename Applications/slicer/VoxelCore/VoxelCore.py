"""Medial surfaces, curve skeletons and local thickness of segments. The work is in VoxelCoreLib; here are the module,
its panel, and what scripts call."""

import logging
import os

import ctk  # noqa: F401  (the panel's widgets are made from it)
import qt
import slicer
import vtk
from slicer.ScriptedLoadableModule import (
    ScriptedLoadableModule,
    ScriptedLoadableModuleLogic,
    ScriptedLoadableModuleTest,
    ScriptedLoadableModuleWidget,
)
from slicer.util import VTKObservationMixin

from VoxelCoreLib import Backend, Cancelled, Scene, Surfaces, VoxelCoreError
from VoxelCoreLib.Computation import Computation
from VoxelCoreLib.Settings import PRESETS, Settings


class VoxelCore(ScriptedLoadableModule):
    def __init__(self, parent):
        ScriptedLoadableModule.__init__(self, parent)
        self.parent.title = "VoxelCore"
        self.parent.categories = ["Surface Models"]
        self.parent.dependencies = ["Segmentations", "SubjectHierarchy", "Plots", "Tables"]
        self.parent.contributors = ["The VoxelCore authors"]
        self.parent.helpText = (
            "Computes medial surfaces, curve skeletons and local thickness of segments. Every result has the same "
            "components, loops and cavities as the segment; this is checked each time. Choose a segmentation, segments "
            "and a preset, then press Apply."
        )
        self.parent.acknowledgementText = (
            "Voxel cores: Y. Yan, D. Letscher, T. Ju, Voxel Cores: Efficient, robust, and provably good approximation "
            "of 3D medial axes, ACM Transactions on Graphics 37(4), 2018."
        )


class VoxelCoreWidget(ScriptedLoadableModuleWidget, VTKObservationMixin):
    # Widgets that hold settings: name of the setting, of the widget, and of the widget's property.
    SETTINGS = (
        ("surface", "surfaceCheckBox", "checked"),
        ("skeleton", "skeletonCheckBox", "checked"),
        ("thickness", "thicknessCheckBox", "checked"),
        ("tables", "tablesCheckBox", "checked"),
        ("plots", "plotsCheckBox", "checked"),
        ("tolerance", "toleranceLineEdit", "text"),
        ("refine", "refineCheckBox", "checked"),
        ("standOut", "standOutLineEdit", "text"),
        ("pruneBranches", "pruneBranchesLineEdit", "text"),
        ("root", "rootComboBox", "currentText"),
        ("connectivity", "connectivityComboBox", "currentText"),
        ("tree", "treeCheckBox", "checked"),
        ("fillCavities", "fillCavitiesCheckBox", "checked"),
        ("minVoxels", "minVoxelsSpinBox", "value"),
        ("border", "borderComboBox", "currentText"),
        ("threads", "threadsSpinBox", "value"),
    )
    SIGNALS = {"checked": "toggled(bool)", "currentText": "currentIndexChanged(int)", "value": "valueChanged(int)"}

    def __init__(self, parent=None):
        ScriptedLoadableModuleWidget.__init__(self, parent)
        VTKObservationMixin.__init__(self)
        self.logic = None
        self._parameterNode = None
        self._updating = False

    def setup(self):
        ScriptedLoadableModuleWidget.setup(self)
        panel = slicer.util.loadUI(self.resourcePath("UI/VoxelCore.ui"))
        self.layout.addWidget(panel)
        self.ui = slicer.util.childWidgetVariables(panel)
        panel.setMRMLScene(slicer.mrmlScene)
        self.logic = VoxelCoreLogic()
        self.timer = qt.QTimer()
        self.timer.setInterval(100)
        self.timer.connect("timeout()", self.onTimer)

        self.ui.segmentsTableView.setSelectionMode(qt.QAbstractItemView.ExtendedSelection)
        self.ui.presetComboBox.addItems(list(PRESETS))
        self.ui.surfaceSelector.addAttribute("vtkMRMLModelNode", Scene.ROLE, "surface")
        for name, widget, property in self.SETTINGS:
            signal = "editingFinished()" if property == "text" else self.SIGNALS[property]
            getattr(self.ui, widget).connect(signal, self.onSettingChanged)
        self.ui.segmentationSelector.connect("currentNodeChanged(vtkMRMLNode*)", self.onSegmentationChanged)
        self.ui.segmentsTableView.connect("selectionChanged(QItemSelection,QItemSelection)", self.updateButtons)
        self.ui.presetComboBox.connect("activated(int)", self.onPreset)
        self.ui.applyButton.connect("clicked(bool)", self.onApply)
        self.ui.cancelButton.connect("clicked(bool)", self.onCancel)
        self.ui.surfaceSelector.connect("currentNodeChanged(vtkMRMLNode*)", self.onSurfaceChanged)
        self.ui.toleranceSlider.connect("valueChanged(double)", self.onTolerance)
        self.ui.colorComboBox.connect("activated(int)", self.onColor)
        self.addObserver(slicer.mrmlScene, slicer.mrmlScene.StartCloseEvent, self.onSceneStartClose)
        self.addObserver(slicer.mrmlScene, slicer.mrmlScene.EndCloseEvent, self.onSceneEndClose)
        self.ui.programPathLineEdit.currentPath = slicer.app.settings().value("VoxelCore/Program", "") or ""
        self.ui.programPathLineEdit.connect("currentPathChanged(QString)", self.sayWhoComputes)
        self.ui.firstRunButton.connect("clicked(bool)", self.onFirstRunUnderstood)
        understood = slicer.app.settings().value("VoxelCore/FirstRunUnderstood", "") == "true"
        self.ui.firstRunCollapsibleButton.visible = not understood
        self.showRunning(False)
        self.readParameterNode()
        self.onSurfaceChanged()
        self.sayWhoComputes()

    def sayWhoComputes(self, *unused):
        """Who will compute, before anything is pressed: in the box that is there until the first run, and the tool tip
        of Apply. Without a program it says what to do."""
        self.ui.statusLabel.text = ""
        try:
            backend = Backend.find(self.ui.programPathLineEdit.currentPath)
            who = f"The {backend.kind} {backend.path()}, version {backend.version()}, computes"
        except VoxelCoreError as error:
            self.ui.statusLabel.text = str(error)
            self.ui.firstRunLabel.text = f"Nothing can be computed yet: {error}. The module itself installs nothing."
            self.ui.applyButton.toolTip = str(error)
            return
        self.ui.firstRunLabel.text = (
            f"{who}, in a process of its own. Nothing is installed or downloaded, and no data leave this computer. The "
            "segments go into Slicer's temporary folder, and are removed from there. Results come into a folder of "
            "their own in the Data module; the segmentation stays as it is, and one Undo takes the results away."
        )
        self.ui.applyButton.toolTip = f"{who}."

    def onFirstRunUnderstood(self, *unused):
        slicer.app.settings().setValue("VoxelCore/FirstRunUnderstood", "true")
        self.ui.firstRunCollapsibleButton.visible = False

    def cleanup(self):
        self.onCancel()
        self.removeObservers()

    def enter(self):
        self.readParameterNode()

    def onSceneStartClose(self, caller=None, event=None):
        self.onCancel()
        self._parameterNode = None

    def onSceneEndClose(self, caller=None, event=None):
        self.readParameterNode()
        self.onSurfaceChanged()

    # Settings live in the parameter node, so that they are saved with the scene.

    def readParameterNode(self):
        self._parameterNode = self.logic.getParameterNode()
        settings = Settings.fromText(self._parameterNode.GetParameter("Settings"))
        self._updating = True
        for name, widget, property in self.SETTINGS:
            setattr(getattr(self.ui, widget), property, getattr(settings, name))
        segmentation = self._parameterNode.GetNodeReference("Segmentation")
        if segmentation is not None:
            self.ui.segmentationSelector.setCurrentNode(segmentation)
        self._updating = False
        self.onSegmentationChanged()

    def settings(self):
        found = Settings()
        for name, widget, property in self.SETTINGS:
            setattr(found, name, getattr(getattr(self.ui, widget), property))
        return found

    def onSettingChanged(self, *unused):
        if not self._updating:
            self._parameterNode.SetParameter("Settings", self.settings().text())
            self.updateButtons()

    def onPreset(self, *unused):
        text, settings = PRESETS[self.ui.presetComboBox.currentText]
        self._parameterNode.SetParameter("Settings", settings.text())
        self.readParameterNode()
        self.ui.statusLabel.text = text

    def onSegmentationChanged(self, *unused):
        node = self.ui.segmentationSelector.currentNode()
        self.ui.segmentsTableView.setSegmentationNode(node)
        if not self._updating and self._parameterNode is not None:
            self._parameterNode.SetNodeReferenceID("Segmentation", node.GetID() if node else None)
        self.updateButtons()

    def segmentIds(self):
        """Those marked in the table; without a mark all."""
        node = self.ui.segmentationSelector.currentNode()
        if node is None:
            return []
        return list(self.ui.segmentsTableView.selectedSegmentIDs()) or list(node.GetSegmentation().GetSegmentIDs())

    def updateButtons(self, *unused):
        running = self.logic.isRunning()
        self.ui.applyButton.enabled = not running and bool(self.segmentIds()) and bool(self.settings().steps())
        self.ui.cancelButton.enabled = running

    # The work.

    def showRunning(self, running):
        self.ui.progressBar.visible = running
        self.ui.progressBar.value = 0
        self.updateButtons()

    def onApply(self, *unused):
        self.ui.statusLabel.text = ""
        program = self.ui.programPathLineEdit.currentPath
        slicer.app.settings().setValue("VoxelCore/Program", program)
        try:
            backend = Backend.find(program)
            self.logic.start(
                self.ui.segmentationSelector.currentNode(), self.segmentIds(), self.settings(), backend
            )
        except VoxelCoreError as error:
            self.showError(error)
            return
        self.onFirstRunUnderstood()
        self.showRunning(True)
        self.timer.start()

    def onTimer(self):
        try:
            nodes = self.logic.poll()
        except VoxelCoreError as error:
            self.stopShowing()
            self.showError(error)
            return
        except Exception as error:
            self.stopShowing()
            logging.exception("VoxelCore")
            self.showError(f"the results cannot be shown: {error}")
            return
        self.ui.progressBar.value = int(100 * self.logic.fraction)
        self.ui.statusLabel.text = self.logic.title
        if nodes is None:
            return
        self.stopShowing()
        self.ui.statusLabel.text = "; ".join(self.logic.warnings) or "Done."
        self.showResults(nodes)

    def stopShowing(self):
        self.timer.stop()
        self.showRunning(False)

    def showError(self, error):
        line = str(error).strip().splitlines()[0]
        self.ui.statusLabel.text = line
        slicer.util.errorDisplay(line, windowTitle="VoxelCore")

    def onCancel(self, *unused):
        if self.logic is not None and self.logic.isRunning():
            self.logic.cancel()
            self.stopShowing()
            self.ui.statusLabel.text = "Stopped; nothing was added."

    def showResults(self, nodes):
        roles = {}
        for node in nodes:
            roles.setdefault(node.GetAttribute(Scene.ROLE), node)
        if "surface" in roles:
            self.ui.surfaceSelector.setCurrentNode(roles["surface"])
            self.onSurfaceChanged()
        if "thickness" in roles:
            slicer.util.setSliceViewerLayers(foreground=roles["thickness"], foregroundOpacity=0.6)
        if "plot" in roles:
            slicer.modules.plots.logic().ShowChartInLayout(roles["plot"])

    # What is shown of a surface.

    def onSurfaceChanged(self, *unused):
        node = self.ui.surfaceSelector.currentNode()
        whole = Scene.wholeOf(node)
        limits = Surfaces.toleranceRange(whole.GetPolyData()) if whole is not None else None
        self._updating = True
        self.ui.colorComboBox.clear()
        if node is not None and node.GetPolyData() is not None:
            self.ui.colorComboBox.addItems(Scene.arraysOf(node) + ["Segment"])
            display = node.GetDisplayNode()
            shown = display.GetActiveScalarName() if display and display.GetScalarVisibility() else "Segment"
            self.ui.colorComboBox.setCurrentText(shown)
        self.ui.toleranceSlider.enabled = limits is not None
        if limits is not None:
            current = Surfaces.toleranceRange(node.GetPolyData())
            self.ui.toleranceSlider.minimum = limits[0]
            self.ui.toleranceSlider.maximum = max(limits[1], limits[0] + 1e-3)
            self.ui.toleranceSlider.singleStep = (limits[1] - limits[0]) / 100 or 1e-3
            self.ui.toleranceSlider.value = current[0] if current else limits[1]
        self._updating = False

    def onTolerance(self, value):
        if not self._updating:
            self.change(lambda node: Scene.setTolerance(node, value))

    def onColor(self, *unused):
        name = self.ui.colorComboBox.currentText
        self.change(lambda node: Scene.colorBy(node, "" if name == "Segment" else name))

    def change(self, work):
        node = self.ui.surfaceSelector.currentNode()
        if node is None:
            return
        try:
            work(node)
        except VoxelCoreError as error:
            self.showError(error)


class VoxelCoreLogic(ScriptedLoadableModuleLogic):
    """For scripts:

    logic = VoxelCoreLogic()
    nodes = logic.process(segmentationNode, ["Segment_1"], Settings(thickness=True))
    """

    def __init__(self):
        ScriptedLoadableModuleLogic.__init__(self)
        self._computation = None
        self.warnings = []

    def isRunning(self):
        return self._computation is not None

    @property
    def fraction(self):
        return self._computation.fraction if self._computation is not None else 1.0

    @property
    def title(self):
        return self._computation.title if self._computation is not None else ""

    def start(self, segmentationNode, segmentIds, settings, backend):
        """Begins a computation, which goes on as poll() is called. Raises VoxelCoreError."""
        if self._computation is not None:
            raise VoxelCoreError("a computation is running; stop it first")
        self._computation = Computation(
            segmentationNode, segmentIds, settings, backend, getattr(slicer.app, "temporaryPath", None)
        )

    def poll(self):
        """The new nodes when all is done, else None. Raises VoxelCoreError; nothing was added then."""
        computation = self._computation
        try:
            if computation is None or not computation.poll():
                return None
            self._computation = None
            self.warnings = list(computation.warnings)
            return computation.finish(slicer.mrmlScene)
        except BaseException:
            self._computation = None
            raise

    def cancel(self):
        """Ends the process and removes its files. The scene is as it was."""
        computation, self._computation = self._computation, None
        if computation is not None:
            computation.cancel()

    def process(self, segmentationNode, segmentIds, settings=None, backend=None, onProgress=None):
        """All of it, for scripts; returns the nodes. onProgress(title, fraction) may return False to stop: then
        VoxelCoreLib.Cancelled is raised."""
        self.start(segmentationNode, segmentIds, settings or Settings(), backend or Backend.find())
        computation, self._computation = self._computation, None
        nodes = computation.wait(slicer.mrmlScene, onProgress)
        self.warnings = list(computation.warnings)
        return nodes


class VoxelCoreTest(ScriptedLoadableModuleTest):
    """Runs in Slicer's Reload and Test, on a slab whose numbers a person can check."""

    def setUp(self):
        slicer.mrmlScene.Clear()

    def runTest(self):
        self.setUp()
        self.test_SlabHasItsThicknessInPlace()
        self.setUp()
        self.test_CancelLeavesNothing()

    def _slab(self):
        import numpy

        voxels = numpy.zeros((10, 30, 26), numpy.uint8)
        voxels[2:8, 3:27, 3:23] = 1
        matrix = vtk.vtkMatrix4x4()
        for axis, length in enumerate((0.5, 0.5, 0.75)):
            matrix.SetElement(axis, axis, length)
            matrix.SetElement(axis, 3, 10.0 * axis)
        labels = slicer.util.addVolumeFromArray(voxels, matrix, "slab", "vtkMRMLLabelMapVolumeNode")
        segmentation = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLSegmentationNode", "slab segmentation")
        slicer.modules.segmentations.logic().ImportLabelmapToSegmentationNode(labels, segmentation)
        slicer.mrmlScene.RemoveNode(labels)
        return segmentation

    def test_SlabHasItsThicknessInPlace(self):
        import numpy

        segmentation = self._slab()
        ids = list(segmentation.GetSegmentation().GetSegmentIDs())
        nodes = VoxelCoreLogic().process(segmentation, ids, Settings(skeleton=False, thickness=True))
        roles = {node.GetAttribute(Scene.ROLE): node for node in nodes}
        map = slicer.util.arrayFromVolume(roles["thickness"])
        inside = map[map > 0]
        # The slab is six slices of 0.75 mm thick; the largest balls that reach into its edges and corners are smaller.
        self.assertLess(abs(float(numpy.median(inside)) - 6 * 0.75), 0.01)
        self.assertLess(abs(float(inside.mean()) - 4.26), 0.1)
        points = slicer.util.arrayFromModelPoints(roles["surface"])
        middle = 20 + 0.75 * (2 + 7) / 2
        self.assertLess(numpy.median(abs(points[:, 2] - middle)), 0.05)
        self.delayDisplay("The slab's surface and thickness are in place")

    def test_CancelLeavesNothing(self):
        segmentation = self._slab()
        before = slicer.mrmlScene.GetNumberOfNodes()
        ids = list(segmentation.GetSegmentation().GetSegmentIDs())
        self.assertRaises(
            Cancelled, VoxelCoreLogic().process, segmentation, ids, onProgress=lambda title, fraction: False
        )
        self.assertEqual(slicer.mrmlScene.GetNumberOfNodes(), before)
        self.delayDisplay("What was cancelled left nothing")
