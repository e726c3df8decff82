"""Results as nodes of the scene: all of them or none, in a folder of the subject hierarchy."""

import numpy
import slicer
import vtk
from vtk.util import numpy_support

from . import Results, Surfaces, Tables, VoxelCoreError

VIRIDIS = "vtkMRMLColorTableNodeFileViridis.txt"
ROLE = "VoxelCore.Role"
WHOLE = "voxelCoreWhole"  # reference from a shown surface to the one with all cells


class Additions:
    """What was added, so that it can be taken away again when something fails."""

    def __init__(self, scene):
        self.scene = scene
        self.hierarchy = slicer.vtkMRMLSubjectHierarchyNode.GetSubjectHierarchyNode(scene)
        self.nodes = []
        self.folders = []

    def folder(self, parent, name):
        item = self.hierarchy.CreateFolderItem(parent, name)
        self.folders.append(item)
        return item

    def node(self, className, name, folder, role):
        node = self.scene.AddNewNodeByClass(className, self.scene.GenerateUniqueName(name))
        if node is None:
            raise VoxelCoreError(f"Slicer cannot make a node of class {className}")
        self.nodes.append(node)
        node.SetUndoEnabled(True)
        node.SetAttribute(ROLE, role)
        if folder is not None:
            item = self.hierarchy.GetItemByDataNode(node)
            if item:
                self.hierarchy.SetItemParent(item, folder)
        return node

    def display(self, node):
        node.CreateDefaultDisplayNodes()
        display = node.GetDisplayNode()
        display.SetUndoEnabled(True)
        self.nodes.append(display)
        return display

    def takeBack(self):
        for node in reversed(self.nodes):
            self.scene.RemoveNode(node)
        for item in reversed(self.folders):
            self.hierarchy.RemoveItem(item)
        self.nodes, self.folders = [], []


def colorBy(node, name):
    """Colours a model by a point array, from the 2nd to the 98th percentile; without one by the segment's colour."""
    display = node.GetDisplayNode()
    values = Surfaces.array(node.GetPolyData().GetPointData(), name) if name else None
    if values is None or len(values) == 0:
        display.SetScalarVisibility(False)
        return
    low, high = numpy.percentile(values, (2, 98))
    display.SetActiveScalar(name, vtk.vtkAssignAttribute.POINT_DATA)
    display.SetAndObserveColorNodeID(VIRIDIS)
    display.SetScalarRangeFlag(slicer.vtkMRMLDisplayNode.UseManualScalarRange)
    display.SetScalarRange(float(low), float(max(high, low + 1e-9)))
    display.SetScalarVisibility(True)


def arraysOf(node):
    """Point arrays that a model can be coloured by."""
    data = node.GetPolyData().GetPointData()
    names = [data.GetArrayName(index) for index in range(data.GetNumberOfArrays())]
    return [name for name in ("Thickness", "Radius", "BallRadius", "Lambda", "Tolerance", "ErosionThickness")
            if name in names]


def wholeOf(node):
    """The node with all cells of a surface that a slider cuts; None where it is not there (any more)."""
    return node.GetNodeReference(WHOLE) if node is not None else None


def setTolerance(node, tolerance):
    """Shows of a medial surface what is left at a tolerance, mm. What is stored for undo is not touched."""
    whole = wholeOf(node)
    if whole is None or whole.GetPolyData() is None:
        raise VoxelCoreError(f"{node.GetName()!r}: its whole surface was removed; compute it again")
    node.SetAndObservePolyData(Surfaces.atTolerance(whole.GetPolyData(), tolerance))


def _model(additions, segmentationNode, result, model, name, folder, role):
    node = additions.node("vtkMRMLModelNode", name, folder, role)
    node.SetAndObservePolyData(model)
    node.SetAndObserveTransformNodeID(segmentationNode.GetTransformNodeID())
    display = additions.display(node)
    display.SetColor(*result.volume.color)
    display.SetBackfaceCulling(False)
    colorBy(node, next(iter(arraysOf(node)), ""))
    return node


def _surface(additions, segmentationNode, result, folder):
    name = result.volume.name + " medial surface"
    node = _model(additions, segmentationNode, result, result.surface, name, folder, "surface")
    whole = additions.node("vtkMRMLModelNode", name + " (all tolerances)", folder, "wholeSurface")
    whole.SetAndObservePolyData(result.surface)
    whole.SetAndObserveTransformNodeID(segmentationNode.GetTransformNodeID())
    whole.SetHideFromEditors(True)
    node.SetNodeReferenceID(WHOLE, whole.GetID())
    return node


def _skeleton(additions, segmentationNode, result, folder):
    name = result.volume.name + " curve skeleton"
    node = _model(additions, segmentationNode, result, result.skeleton, name, folder, "skeleton")
    node.GetDisplayNode().SetLineWidth(3)
    return node


def _map(additions, segmentationNode, result, folder):
    node = additions.node("vtkMRMLScalarVolumeNode", result.volume.name + " thickness", folder, "thickness")
    image = vtk.vtkImageData()
    image.SetDimensions(*reversed(result.map.shape))
    scalars = numpy_support.numpy_to_vtk(result.map.ravel(), deep=1, array_type=vtk.VTK_FLOAT)
    scalars.SetName("Thickness")
    image.GetPointData().SetScalars(scalars)
    matrix = vtk.vtkMatrix4x4()
    for row in range(4):
        for column in range(4):
            matrix.SetElement(row, column, float(result.volume.ijkToRas[row, column]))
    node.SetIJKToRASMatrix(matrix)  # also the voxel size
    node.SetAndObserveImageData(image)
    node.SetAndObserveTransformNodeID(segmentationNode.GetTransformNodeID())
    display = additions.display(node)
    display.SetAndObserveColorNodeID(VIRIDIS)
    inside = result.map[result.map > 0]
    low, high = numpy.percentile(inside, (2, 98)) if len(inside) else (0.0, 1.0)
    display.SetAutoWindowLevel(False)
    display.SetWindowLevelMinMax(float(low), float(max(high, low + 1e-6)))
    if len(inside):
        display.SetThreshold(float(inside.min()) * 0.5, float(inside.max()))  # the background is 0
        display.SetApplyThreshold(True)
    return node


def _table(additions, name, folder, role, columns, units, descriptions):
    node = additions.node("vtkMRMLTableNode", name, folder, role)
    for title, values in columns:
        node.AddColumn(Tables.vtkColumn(title, values))
        if title in units:
            node.SetColumnUnitLabel(title, units[title])
        if title in descriptions:
            node.SetColumnDescription(title, descriptions[title])
    node.SetUseColumnTitleAsColumnHeader(True)
    node.SetLocked(True)
    return node


def _chart(additions, name, folder, table, kind, xColumn, yColumn, xTitle, yTitle, color):
    series = additions.node("vtkMRMLPlotSeriesNode", name + " series", folder, "plotSeries")
    series.SetAndObserveTableNodeID(table.GetID())
    series.SetXColumnName(xColumn)
    series.SetYColumnName(yColumn)
    series.SetPlotType(kind)
    if kind == slicer.vtkMRMLPlotSeriesNode.PlotTypeScatter:
        series.SetLineStyle(slicer.vtkMRMLPlotSeriesNode.LineStyleNone)
        series.SetMarkerStyle(slicer.vtkMRMLPlotSeriesNode.MarkerStyleCircle)
    series.SetColor(*color)
    chart = additions.node("vtkMRMLPlotChartNode", name, folder, "plot")
    chart.AddAndObservePlotSeriesNodeID(series.GetID())
    chart.SetTitle(name)
    chart.SetXAxisTitle(xTitle)
    chart.SetYAxisTitle(yTitle)
    chart.SetLegendVisibility(False)
    return chart


def _tablesAndPlots(additions, result, settings, folder):
    name = result.volume.name
    if result.branches is not None and len(result.branches[1][0]):
        names, columns, units, descriptions = result.branches
        table = _table(additions, f"{name} branches", folder, "branches", zip(names, columns), units, descriptions)
        if settings.plots:
            _chart(additions, f"{name} branches plot", folder, table, slicer.vtkMRMLPlotSeriesNode.PlotTypeScatter,
                   "branch_distance", "mean_radius", "length (mm)", "mean radius (mm)", result.volume.color)
    if result.map is not None:
        middles, shares = Tables.histogram(result.map, result.volume.lpsGeometry()[0])
        table = _table(additions, f"{name} thickness histogram", folder, "histogram",
                       [("thickness", middles), ("share", shares)], {"thickness": "mm", "share": "%"}, {})
        if settings.plots:
            _chart(additions, f"{name} thickness plot", folder, table, slicer.vtkMRMLPlotSeriesNode.PlotTypeLine,
                   "thickness", "share", "thickness (mm)", "voxels (%)", result.volume.color)


def addResults(scene, segmentationNode, results, settings):
    """All nodes of the results, in one step of undo. Returns them. Adds nothing where it fails."""
    if segmentationNode is None or scene.GetNodeByID(segmentationNode.GetID() or "") is not segmentationNode:
        raise VoxelCoreError("the segmentation was removed meanwhile; nothing was added")
    scene.SaveStateForUndo()
    additions = Additions(scene)
    try:
        hierarchy = additions.hierarchy
        beside = hierarchy.GetItemParent(hierarchy.GetItemByDataNode(segmentationNode))
        top = additions.folder(beside or hierarchy.GetSceneItemID(), segmentationNode.GetName() + " VoxelCore")
        for result in results:
            folder = additions.folder(top, result.volume.name) if len(results) > 1 else top
            if result.surface is not None:
                _surface(additions, segmentationNode, result, folder)
            if result.skeleton is not None:
                _skeleton(additions, segmentationNode, result, folder)
            if result.map is not None:
                _map(additions, segmentationNode, result, folder)
            if settings.tables or settings.plots:
                _tablesAndPlots(additions, result, settings, folder)
        if settings.tables:
            rows = [result.row() for result in results]
            columns = [(title, [row[title] for row in rows]) for title in rows[0]]
            _table(additions, segmentationNode.GetName() + " summary", top, "summary", columns, Results.UNITS,
                   Results.DESCRIPTIONS)
    except Exception:
        additions.takeBack()
        raise
    return [node for node in additions.nodes if node.GetAttribute(ROLE)]
