"""Puts pictures under and beside each other, each with a title.

usage: tile.py OUT.png COLUMNS PICTURE.png TITLE [PICTURE.png TITLE]...    needs python3-vtk9
"""

import sys

import vtk

MARGIN = 34  # pixels above each picture, for its title


def read(path):
    reader = vtk.vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def titled(path, title):
    """The picture on a larger canvas, its title above it."""
    picture = read(path)
    width, height, _ = picture.GetDimensions()
    canvas = vtk.vtkImageCanvasSource2D()
    canvas.SetScalarTypeToUnsignedChar()
    canvas.SetNumberOfScalarComponents(3)
    canvas.SetExtent(0, width - 1, 0, height + MARGIN - 1, 0, 0)
    canvas.SetDrawColor(255, 255, 255)
    canvas.FillBox(0, width - 1, 0, height + MARGIN - 1)
    canvas.DrawImage(0, 0, picture)
    letters = vtk.vtkTextProperty()
    letters.SetFontSize(20)
    letters.SetColor(0, 0, 0)
    text = vtk.vtkImageData()
    size = [0, 0]
    vtk.vtkTextRenderer.GetInstance().RenderString(letters, title, text, size, 72)
    blend = vtk.vtkImageBlend()
    canvas.Update()
    blend.AddInputData(canvas.GetOutput())
    # Blending goes by extents, not by origins.
    columns, rows, _ = text.GetDimensions()
    left, bottom = (width - size[0]) // 2, height + 4
    text.SetExtent(left, left + columns - 1, bottom, bottom + rows - 1, 0, 0)
    blend.AddInputData(text)
    blend.Update()
    return blend.GetOutput()


def append(pictures, axis):
    whole = vtk.vtkImageAppend()
    whole.SetAppendAxis(axis)
    for picture in pictures:
        whole.AddInputData(picture)
    whole.Update()
    return whole.GetOutput()


def main():
    out, columns = sys.argv[1], int(sys.argv[2])
    tiles = [titled(*pair) for pair in zip(sys.argv[3::2], sys.argv[4::2])]
    rows = [append(tiles[k : k + columns], 0) for k in range(0, len(tiles), columns)]
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(out)
    writer.SetInputData(append(rows[::-1], 1))  # VTK's rows begin at the bottom
    writer.Write()


main()
