"""Slicer's windows on PyQt5: the widgets of MRML and CTK by the properties, signals and slots that their headers have,
and PythonQt's way to talk to them: properties are attributes, signals are connected by their signature. A name that a
class has not is an AttributeError."""

import io
import sys
import types
import xml.etree.ElementTree as xml

from PyQt5 import QtCore, QtWidgets, sip, uic
from PyQt5.QtCore import pyqtProperty, pyqtSignal

import slicer
import slicer.util


def properties(cls, **defaults):
    """Qt properties with get and set, as moc makes them of Q_PROPERTY."""
    for name, default in defaults.items():

        def get(self, name=name, default=default):
            return self.__dict__.get("_" + name, default)

        def put(self, value, name=name):
            self.__dict__["_" + name] = value
            changed = getattr(self, "changed", None)
            if changed is not None:
                changed(name)

        setattr(cls, "set" + name[0].upper() + name[1:], put)
        type_ = {str: "QString", list: "QStringList"}.get(type(default), type(default))
        namespace = {name: pyqtProperty(type_, get, put)}
        cls = type(cls)(cls.__name__, (cls,), namespace)
    return cls


class _MRMLWidget(QtWidgets.QWidget):
    mrmlSceneChanged = pyqtSignal(object)
    signals = {"mrmlSceneChanged(vtkMRMLScene*)": "mrmlSceneChanged"}

    def setMRMLScene(self, scene):
        self.scene = scene
        self.mrmlSceneChanged.emit(scene)


class qMRMLWidget(_MRMLWidget):
    invokable = ("setMRMLScene",)


class _NodeComboBox(QtWidgets.QWidget):
    currentNodeChanged = pyqtSignal(object)
    signals = {"currentNodeChanged(vtkMRMLNode*)": "currentNodeChanged"}
    invokable = ("setMRMLScene", "currentNode", "setCurrentNode", "addAttribute", "nodeCount")

    def __init__(self, parent=None):
        QtWidgets.QWidget.__init__(self, parent)
        self.current, self.filters, self.scene = None, [], None

    def setMRMLScene(self, scene):
        self.scene = scene
        for event in (scene.NodeAddedEvent, scene.NodeRemovedEvent):
            scene.AddObserver(event, lambda *unused: self.update())
        self.update()

    def nodes(self):
        return [node for node in self.scene.nodes.values() if node.GetClassName() in self.property("nodeTypes")
                and not node.GetHideFromEditors()
                and all(node.GetAttribute(name) == value for _, name, value in self.filters)]

    def nodeCount(self):
        return len(self.nodes())

    def addAttribute(self, nodeType, name, value=None):
        assert nodeType in self.property("nodeTypes")
        self.filters.append((nodeType, name, value))
        self.update()

    def update(self):
        """As the true one: what is removed is no longer current; without 'none' the first node is."""
        if self.scene is None or sip.isdeleted(self):
            return
        nodes = self.nodes()
        if self.current in nodes:
            return
        self.setCurrentNode(nodes[0] if nodes and not self.property("noneEnabled") else None)

    def currentNode(self):
        return self.current

    def setCurrentNode(self, node):
        if node is not self.current:
            self.current = node
            self.currentNodeChanged.emit(node)


qMRMLNodeComboBox = properties(
    _NodeComboBox, nodeTypes=[], showHidden=False, showChildNodeTypes=True, hideChildNodeTypes=[], baseName="",
    noneEnabled=False, addEnabled=True, removeEnabled=True, editEnabled=False, renameEnabled=False,
    selectNodeUponCreation=True, noneDisplay="None")
qMRMLNodeComboBox.__name__ = "qMRMLNodeComboBox"


class _SegmentsTableView(_MRMLWidget):
    selectionChanged = pyqtSignal(object, object)
    signals = {"selectionChanged(QItemSelection,QItemSelection)": "selectionChanged"}
    invokable = ("setMRMLScene", "setSegmentationNode", "selectedSegmentIDs", "setSelectedSegmentIDs",
                 "setSelectionMode", "segmentationNode", "clearSelection")

    def __init__(self, parent=None):
        _MRMLWidget.__init__(self, parent)
        self.node, self.selected, self.mode = None, [], 1

    def setSelectionMode(self, mode):
        self.mode = int(mode)

    def segmentationNode(self):
        return self.node

    def setSegmentationNode(self, node):
        if node is not self.node:
            self.node, self.selected = node, []

    def selectedSegmentIDs(self):
        return tuple(self.selected)

    def setSelectedSegmentIDs(self, ids):
        self.selected = [one for one in ids if one in self.node.GetSegmentation().GetSegmentIDs()]
        self.selectionChanged.emit(None, None)

    def clearSelection(self):
        self.setSelectedSegmentIDs([])


qMRMLSegmentsTableView = properties(
    _SegmentsTableView, selectionMode=1, headerVisible=True, visibilityColumnVisible=True, colorColumnVisible=True,
    opacityColumnVisible=True, statusColumnVisible=False, layerColumnVisible=False, readOnly=False,
    filterBarVisible=False, textFilter="", jumpToSelectedSegmentEnabled=False)


class _Plain(QtWidgets.QWidget):
    signals = {}
    invokable = ()


ctkCollapsibleButton = properties(_Plain, text="", collapsed=False)


class _PathLineEdit(QtWidgets.QWidget):
    currentPathChanged = pyqtSignal(str)
    signals = {"currentPathChanged(QString)": "currentPathChanged"}
    invokable = ()

    def changed(self, name):
        self.currentPathChanged.emit(self.property("currentPath"))


ctkPathLineEdit = properties(_PathLineEdit, currentPath="")


class _Slider(QtWidgets.QWidget):
    valueChanged = pyqtSignal(float)
    signals = {"valueChanged(double)": "valueChanged"}
    invokable = ("setValue", "setRange")

    def changed(self, name):
        if name in ("minimum", "maximum", "value"):
            value = min(max(self.property("value"), self.property("minimum")), self.property("maximum"))
            if name == "value" or value != self.property("value"):
                self.__dict__["_value"] = value
                self.valueChanged.emit(value)


ctkSliderWidget = properties(
    _Slider, decimals=2, singleStep=1.0, pageStep=10.0, minimum=0.0, maximum=99.99, value=0.0, prefix="", suffix="",
    tracking=True)

CUSTOM = dict(qMRMLWidget=qMRMLWidget, qMRMLNodeComboBox=qMRMLNodeComboBox,
              qMRMLSegmentsTableView=qMRMLSegmentsTableView, ctkCollapsibleButton=ctkCollapsibleButton,
              ctkSliderWidget=ctkSliderWidget, ctkPathLineEdit=ctkPathLineEdit)


class PythonQt:
    """A Qt object as Slicer's Python sees it."""

    def __init__(self, object):
        self.__dict__["object"] = object

    def __getattr__(self, name):
        object = self.__dict__["object"]
        if object.metaObject().indexOfProperty(name) >= 0:
            return object.property(name)
        allowed = getattr(object, "invokable", None)
        if name.startswith("_") or (allowed is not None and name not in allowed):
            raise AttributeError(f"{type(object).__name__} has no {name}")
        return getattr(object, name)

    def __setattr__(self, name, value):
        object = self.__dict__["object"]
        index = object.metaObject().indexOfProperty(name)
        if index < 0 or not object.metaObject().property(index).isWritable():
            raise AttributeError(f"{type(object).__name__} has no property {name} that can be set")
        before = object.property(name)
        if not object.setProperty(name, value):
            raise TypeError(f"{type(object).__name__}.{name}: {value!r} is no {type(before).__name__}")

    def connect(self, signature, function):
        object = self.__dict__["object"]
        known = getattr(object, "signals", {})
        if signature in known:
            getattr(object, known[signature]).connect(function)
            return
        if object.metaObject().indexOfSignal(QtCore.QMetaObject.normalizedSignature(signature)) < 0:
            raise AttributeError(f"{type(object).__name__} has no signal {signature}")
        name, _, words = signature.rstrip(")").partition("(")
        bound = getattr(object, name)
        (bound[{"int": int, "bool": bool, "double": float}[words]] if words else bound).connect(function)


def loadUI(path):
    """Of a .ui file. Its custom widgets are those above. uic makes no connections of vtk types: that is done here."""
    for name, cls in CUSTOM.items():
        module = types.ModuleType(name)
        setattr(module, name, cls)
        sys.modules[name] = module
    tree = xml.parse(path)
    connections = tree.getroot().find("connections")
    wanted = [{part.tag: part.text for part in connection} for connection in connections]
    connections.clear()
    panel = uic.loadUi(io.StringIO(xml.tostring(tree.getroot(), "unicode")))
    objects = {child.objectName(): child for child in [panel, *panel.findChildren(QtWidgets.QWidget)]}
    for one in wanted:
        slot = getattr(PythonQt(objects[one["receiver"]]), one["slot"].partition("(")[0])
        PythonQt(objects[one["sender"]]).connect(one["signal"], slot)
    return PythonQt(panel)


def childWidgetVariables(panel):
    found = types.SimpleNamespace()
    for child in panel.__dict__["object"].findChildren(QtWidgets.QWidget):
        if child.objectName():
            setattr(found, child.objectName(), PythonQt(child))
    return found


application = QtWidgets.QApplication.instance() or QtWidgets.QApplication(["test"])
qt = types.ModuleType("qt")
qt.QTimer = lambda: PythonQt(QtCore.QTimer())
qt.QAbstractItemView = QtWidgets.QAbstractItemView
ctk = types.ModuleType("ctk")
sys.modules["qt"], sys.modules["ctk"] = qt, ctk
slicer.util.loadUI, slicer.util.childWidgetVariables = loadUI, childWidgetVariables


class Parent:
    """What a module's widget is put into."""

    def __init__(self):
        self.box = QtWidgets.QWidget()
        self.box.setLayout(QtWidgets.QVBoxLayout())

    def layout(self):
        box = self.box.layout()
        return types.SimpleNamespace(addWidget=lambda panel: box.addWidget(panel.__dict__["object"]))
