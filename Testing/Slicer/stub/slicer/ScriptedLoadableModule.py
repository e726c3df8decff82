"""The base classes of scripted modules."""

import os
import sys
import unittest


class ScriptedLoadableModule:
    def __init__(self, parent):
        self.parent = parent


class ScriptedLoadableModuleLogic:
    def __init__(self, parent=None):
        self.moduleName = type(self).__name__[: -len("Logic")]

    def getParameterNode(self):
        import slicer

        for node in slicer.mrmlScene.nodes.values():
            if node.IsA("vtkMRMLScriptedModuleNode") and node.GetName() == self.moduleName:
                return node
        return slicer.mrmlScene.AddNewNodeByClass("vtkMRMLScriptedModuleNode", self.moduleName)


class ScriptedLoadableModuleWidget:
    def __init__(self, parent=None):
        self.parent = parent
        self.layout = parent.layout() if parent is not None else None

    def setup(self):
        pass

    def resourcePath(self, name):
        folder = os.path.dirname(os.path.abspath(sys.modules[type(self).__module__].__file__))
        return os.path.join(folder, "Resources", name)


class ScriptedLoadableModuleTest(unittest.TestCase):
    def delayDisplay(self, message):
        print(message)
