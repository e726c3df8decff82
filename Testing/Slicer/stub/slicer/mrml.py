"""The part of MRML that the module VoxelCore uses: nodes with ids, references, display nodes and observers, a scene
with undo, and the subject hierarchy. Names and meaning follow Slicer's headers; what is not here fails as in Slicer, by
an AttributeError."""

import copy

import vtk


def _properties(cls, **defaults):
    """Get and Set for plain values; Set tells observers."""
    for name, default in defaults.items():

        def get(self, name=name, default=default):
            return self.__dict__.get("_" + name, default)

        def put(self, *values, name=name):
            self.__dict__["_" + name] = values if len(values) > 1 else values[0]
            self.Modified()

        setattr(cls, "Get" + name, get)
        setattr(cls, "Set" + name, put)


class vtkMRMLNode(vtk.vtkObject):
    def __init__(self):
        self.scene = None
        self._ID = None
        self._attributes = {}
        self._references = {}

    def GetClassName(self):
        return type(self).__name__

    def IsA(self, name):
        return any(base.__name__ == name for base in type(self).__mro__)

    def GetID(self):
        return self._ID

    def GetScene(self):
        return self.scene

    def GetAttribute(self, name):
        return self._attributes.get(name)

    def SetAttribute(self, name, value):
        self._attributes[name] = value
        self.Modified()

    def SetNodeReferenceID(self, role, nodeId):
        assert nodeId is None or isinstance(nodeId, str)
        self._references[role] = nodeId
        self.Modified()

    def GetNodeReferenceID(self, role):
        return self._references.get(role)

    def GetNodeReference(self, role):
        nodeId = self._references.get(role)
        return self.scene.GetNodeByID(nodeId) if self.scene is not None and nodeId else None

    def state(self):
        return {name: copy.copy(value) if isinstance(value, dict) else value
                for name, value in self.__dict__.items() if name != "scene"}


_properties(vtkMRMLNode, Name=None, HideFromEditors=False, UndoEnabled=False)


class vtkMRMLScriptedModuleNode(vtkMRMLNode):
    def GetParameter(self, name):
        return self._attributes.get("parameter:" + name, "")

    def SetParameter(self, name, value):
        assert isinstance(value, str)
        self.SetAttribute("parameter:" + name, value)


class vtkMRMLColorTableNode(vtkMRMLNode):
    pass


class vtkMRMLDisplayNode(vtkMRMLNode):
    UseManualScalarRange, UseDataScalarRange = 0, 1

    def SetAndObserveColorNodeID(self, nodeId):
        self.SetNodeReferenceID("color", nodeId)

    def GetColorNode(self):
        return self.GetNodeReference("color")

    def SetActiveScalar(self, name, location):
        self._activeScalar = name, location
        self.Modified()

    def GetActiveScalarName(self):
        return self.__dict__.get("_activeScalar", ("", 0))[0]


_properties(vtkMRMLDisplayNode, Color=(0.5, 0.5, 0.5), ScalarVisibility=False, ScalarRange=(0.0, 100.0),
            ScalarRangeFlag=1, Visibility=True, LineWidth=1.0, BackfaceCulling=True)


class vtkMRMLModelDisplayNode(vtkMRMLDisplayNode):
    pass


class vtkMRMLScalarVolumeDisplayNode(vtkMRMLDisplayNode):
    def SetWindowLevelMinMax(self, low, high):
        self._windowLevel = float(low), float(high)

    def SetThreshold(self, low, high):
        self._threshold = float(low), float(high)


_properties(vtkMRMLScalarVolumeDisplayNode, AutoWindowLevel=True, ApplyThreshold=False)


class vtkMRMLTransformableNode(vtkMRMLNode):
    def SetAndObserveTransformNodeID(self, nodeId):
        self.SetNodeReferenceID("transform", nodeId)

    def GetTransformNodeID(self):
        return self.GetNodeReferenceID("transform")


class vtkMRMLLinearTransformNode(vtkMRMLTransformableNode):
    pass


class vtkMRMLDisplayableNode(vtkMRMLTransformableNode):
    displayClass = None

    def CreateDefaultDisplayNodes(self):
        if self.GetDisplayNode() is None:
            display = self.scene.AddNewNodeByClass(self.displayClass)
            self.SetNodeReferenceID("display", display.GetID())

    def GetDisplayNode(self):
        return self.GetNodeReference("display")


class vtkMRMLModelNode(vtkMRMLDisplayableNode):
    displayClass = "vtkMRMLModelDisplayNode"

    def SetAndObservePolyData(self, data):
        assert isinstance(data, vtk.vtkPolyData)
        self._polyData = data
        self.Modified()

    def GetPolyData(self):
        return self.__dict__.get("_polyData")


class vtkMRMLScalarVolumeNode(vtkMRMLDisplayableNode):
    displayClass = "vtkMRMLScalarVolumeDisplayNode"

    def SetAndObserveImageData(self, image):
        assert image.GetExtent()[::2] == (0, 0, 0)
        self._image = image
        self.Modified()

    def GetImageData(self):
        return self.__dict__.get("_image")

    def SetIJKToRASMatrix(self, matrix):
        self._matrix = vtk.vtkMatrix4x4()
        self._matrix.DeepCopy(matrix)
        self.Modified()

    def GetIJKToRASMatrix(self, matrix):
        matrix.DeepCopy(self._matrix)


class vtkMRMLLabelMapVolumeNode(vtkMRMLScalarVolumeNode):
    pass


class vtkMRMLTableNode(vtkMRMLNode):
    def __init__(self):
        vtkMRMLNode.__init__(self)
        self._table = vtk.vtkTable()
        self._columns = {}

    def GetTable(self):
        return self._table

    def AddColumn(self, column):
        rows = self._table.GetNumberOfRows() if self._table.GetNumberOfColumns() else None
        assert rows is None or column.GetNumberOfTuples() == rows
        self._table.AddColumn(column)
        self.Modified()

    def SetColumnUnitLabel(self, column, unit):
        assert self._table.GetColumnByName(column) is not None
        self._columns[column, "unit"] = unit

    def GetColumnUnitLabel(self, column):
        return self._columns.get((column, "unit"), "")

    def SetColumnDescription(self, column, text):
        assert self._table.GetColumnByName(column) is not None
        self._columns[column, "description"] = text


_properties(vtkMRMLTableNode, Locked=False, UseColumnTitleAsColumnHeader=False)


class vtkMRMLPlotSeriesNode(vtkMRMLNode):
    PlotTypeLine, PlotTypeBar, PlotTypeScatter, PlotTypeScatterBar = range(4)
    LineStyleNone, LineStyleSolid = 0, 1
    MarkerStyleNone, MarkerStyleCross, MarkerStylePlus, MarkerStyleSquare, MarkerStyleCircle = range(5)

    def SetAndObserveTableNodeID(self, nodeId):
        self.SetNodeReferenceID("table", nodeId)

    def GetTableNode(self):
        return self.GetNodeReference("table")


_properties(vtkMRMLPlotSeriesNode, XColumnName="", YColumnName="", PlotType=0, LineStyle=1, MarkerStyle=0,
            Color=(0.0, 0.0, 0.0))


class vtkMRMLPlotChartNode(vtkMRMLNode):
    def AddAndObservePlotSeriesNodeID(self, nodeId):
        self.SetNodeReferenceID(f"series{len(self._references)}", nodeId)


_properties(vtkMRMLPlotChartNode, Title="", XAxisTitle="", YAxisTitle="", LegendVisibility=True)


class vtkMRMLSubjectHierarchyNode(vtkMRMLNode):
    inHierarchy = (vtkMRMLTransformableNode, vtkMRMLTableNode, vtkMRMLPlotSeriesNode, vtkMRMLPlotChartNode)

    def __init__(self):
        vtkMRMLNode.__init__(self)
        self._items = {1: (None, "Scene", None)}  # parent, name, data node
        self._next = 2

    @staticmethod
    def GetSubjectHierarchyNode(scene):
        return scene.hierarchy

    def GetSceneItemID(self):
        return 1

    def _add(self, parent, name, node):
        assert parent in self._items, f"no item {parent}"
        self._items[self._next] = parent, name, node
        self._next += 1
        return self._next - 1

    def CreateFolderItem(self, parent, name):
        return self._add(parent, name, None)

    def GetItemByDataNode(self, node):
        return next((item for item, (_, _, data) in self._items.items() if data is node and node is not None), 0)

    def GetItemParent(self, item):
        return self._items[item][0] if item in self._items else 0

    def GetItemName(self, item):
        _, name, node = self._items[item]
        return node.GetName() if node is not None else name

    def SetItemParent(self, item, parent):
        assert parent in self._items
        self._items[item] = (parent, *self._items[item][1:])

    def RemoveItem(self, item):
        for child in [child for child, (parent, _, _) in self._items.items() if parent == item]:
            self.RemoveItem(child)
        _, _, node = self._items.pop(item)
        if node is not None:
            self.scene.RemoveNode(node)

    def onNodeAdded(self, node):
        if isinstance(node, self.inHierarchy):
            self._add(1, None, node)

    def onNodeRemoved(self, node):
        item = self.GetItemByDataNode(node)
        if item:
            del self._items[item]


class vtkMRMLScene(vtk.vtkObject):
    NodeAddedEvent, NodeRemovedEvent, StartCloseEvent, EndCloseEvent = 66000, 66001, 66004, 66005

    def __init__(self):
        self.nodes = {}
        self.counts = {}
        self.classes = {}
        self.undoStack = []
        self.hierarchy = None

    def begin(self):
        self.hierarchy = self.AddNewNodeByClass("vtkMRMLSubjectHierarchyNode", "SubjectHierarchy")
        viridis = vtkMRMLColorTableNode()
        viridis._ID, viridis.scene = "vtkMRMLColorTableNodeFileViridis.txt", self
        self.nodes[viridis._ID] = viridis

    def AddNewNodeByClass(self, className, name=""):
        if className not in self.classes:
            return None
        node = self.classes[className]()
        self.counts[className] = self.counts.get(className, 0) + 1
        node._ID = f"{className}{self.counts[className]}"
        node.SetName(name or className[7:-4])
        self._put(node)
        return node

    def _put(self, node):
        node.scene = self
        self.nodes[node._ID] = node
        if self.hierarchy is not None:
            self.hierarchy.onNodeAdded(node)
        self.InvokeEvent(self.NodeAddedEvent)

    def RemoveNode(self, node):
        if self.nodes.pop(node._ID, None) is None:
            raise RuntimeError(f"{node._ID} is not in the scene")
        self.hierarchy.onNodeRemoved(node)
        node.scene = None
        self.InvokeEvent(self.NodeRemovedEvent)

    def GetNodeByID(self, nodeId):
        return self.nodes.get(nodeId)

    def GetNumberOfNodes(self):
        return len(self.nodes)

    def GenerateUniqueName(self, base):
        names = {node.GetName() for node in self.nodes.values()}
        name, count = base, 0
        while name in names:
            count += 1
            name = f"{base}_{count}"
        return name

    def SaveStateForUndo(self):
        self.undoStack.append(
            {nodeId: (node, node.state()) for nodeId, node in self.nodes.items() if node.GetUndoEnabled()}
        )

    def Undo(self):
        before = self.undoStack.pop()
        for nodeId, node in list(self.nodes.items()):
            if node.GetUndoEnabled() and nodeId not in before:
                self.RemoveNode(node)
        for nodeId, (node, state) in before.items():
            if nodeId not in self.nodes:
                self._put(node)
            node.__dict__.update(state)

    def Clear(self):
        self.InvokeEvent(self.StartCloseEvent)
        for node in list(self.nodes.values()):
            if not isinstance(node, (vtkMRMLSubjectHierarchyNode, vtkMRMLColorTableNode)):
                self.RemoveNode(node)
        self.hierarchy._items = {1: self.hierarchy._items[1]}
        self.InvokeEvent(self.EndCloseEvent)
