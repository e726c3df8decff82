"""Draws the panel of the Slicer module for the guide: its .ui by PyQt5, with results in it, and with simple looks for
the widgets that only Slicer has.

usage: panel_picture.py OUT.png      as the tests run, see CMakeLists.txt
"""

import sys
import time

import conftest
import panel
import slicer
from PyQt5 import QtCore, QtGui, QtWidgets

import VoxelCore

HEIGHTS = {"qMRMLNodeComboBox": 28, "qMRMLSegmentsTableView": 78, "ctkPathLineEdit": 26, "ctkSliderWidget": 26}


def nameOf(widget):
    """Its class in Slicer, or an empty text."""
    return next((name for name, kind in panel.CUSTOM.items() if type(widget) is kind), "")


class Looks(QtCore.QObject):
    """Paints Slicer's widgets, which are empty in the stand-in."""

    def eventFilter(self, widget, event):
        if event.type() != QtCore.QEvent.Paint:
            return False
        painter = QtWidgets.QStylePainter(widget)
        getattr(self, nameOf(widget))(widget, painter)
        painter.end()
        return True

    def qMRMLNodeComboBox(self, widget, painter):
        option = QtWidgets.QStyleOptionComboBox()
        option.initFrom(widget)
        option.currentText = widget.currentNode().GetName() if widget.currentNode() else ""
        painter.drawComplexControl(QtWidgets.QStyle.CC_ComboBox, option)
        painter.drawControl(QtWidgets.QStyle.CE_ComboBoxLabel, option)

    def qMRMLSegmentsTableView(self, widget, painter):
        painter.fillRect(widget.rect(), QtCore.Qt.white)
        segmentation = widget.segmentationNode().GetSegmentation()
        for row, one in enumerate(segmentation.GetSegmentIDs()):
            box = QtCore.QRect(0, 26 * row, widget.width(), 26)
            if one in widget.selectedSegmentIDs():
                painter.fillRect(box, widget.palette().highlight().color().lighter(160))
            painter.fillRect(box.adjusted(8, 6, 22 - box.width(), -6), QtGui.QColor(("#80ae80", "#d8b13a")[row % 2]))
            painter.drawText(box.adjusted(32, 0, 0, 0), QtCore.Qt.AlignVCenter, segmentation.GetSegment(one).GetName())
        painter.setPen(QtCore.Qt.gray)
        painter.drawRect(widget.rect().adjusted(0, 0, -1, -1))

    def ctkPathLineEdit(self, widget, painter):
        option = QtWidgets.QStyleOptionFrame()
        option.initFrom(widget)
        option.lineWidth = 1
        painter.drawPrimitive(QtWidgets.QStyle.PE_PanelLineEdit, option)

    def ctkSliderWidget(self, widget, painter):
        low, high, value = (widget.property(name) for name in ("minimum", "maximum", "value"))
        option = QtWidgets.QStyleOptionSlider()
        option.initFrom(widget)
        option.orientation = QtCore.Qt.Horizontal
        option.rect = widget.rect().adjusted(0, 0, -80, 0)
        option.minimum, option.maximum = 0, 100
        option.sliderPosition = int(100 * (value - low) / (high - low))
        painter.drawComplexControl(QtWidgets.QStyle.CC_Slider, option)
        painter.drawText(widget.rect(), QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter, f"{value:.2f} mm")

    def ctkCollapsibleButton(self, widget, painter):
        painter.fillRect(0, 0, widget.width(), 24, widget.palette().button().color().darker(108))
        painter.drawText(10, 0, widget.width(), 24, QtCore.Qt.AlignVCenter, "\u25be  " + widget.property("text"))


def draw(path):
    slicer.mrmlScene.Clear()
    parent = panel.Parent()
    made = VoxelCore.VoxelCoreWidget(parent)
    made.setup()
    node = conftest.segmentationOf(conftest.body(2), names={1: "stem", 2: "plate"}, name="Segmentation")
    made.ui.segmentationSelector.setCurrentNode(node)
    made.ui.segmentsTableView.setSelectedSegmentIDs(["Segment_1"])
    made.onApply()
    while made.logic.isRunning():
        panel.application.processEvents()
        time.sleep(0.01)
    assert slicer.util.errors == [] and made.ui.statusLabel.text == "Done."
    slider = made.ui.toleranceSlider
    slider.value = slider.minimum + 0.3 * (slider.maximum - slider.minimum)
    looks = Looks()
    for child in parent.box.findChildren(QtWidgets.QWidget):
        name = nameOf(child)
        if name and hasattr(Looks, name):
            child.setMinimumHeight(HEIGHTS.get(name, 0))
            child.installEventFilter(looks)
            if name == "ctkCollapsibleButton":
                margins = child.layout().contentsMargins()
                child.layout().setContentsMargins(margins.left(), 30, margins.right(), margins.bottom())
    parent.box.resize(400, parent.box.minimumSizeHint().height())
    parent.box.show()
    panel.application.processEvents()
    picture = parent.box.grab()
    made.cleanup()
    assert picture.save(str(path))


if __name__ == "__main__":
    draw(sys.argv[1])
