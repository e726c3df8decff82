"""Makes an icon of a picture: the square in its middle, 128 pixels wide, white made transparent.

usage: icon.py PICTURE.png OUT.png LEFT TOP SIDE     needs python3-vtk9
"""

import sys

import numpy
import vtk
from vtk.util import numpy_support

SIDE = 128


def main(path, out, left, top, side):
    reader = vtk.vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3]
    part = pixels[top : top + side, left : left + side].astype(float) / 255
    alpha = (part.min(axis=2) < 0.97).astype(float)
    # Means of what is drawn, over the square of the picture that a pixel stands for.
    edges = numpy.linspace(0, side, SIDE + 1).astype(int)
    mean = lambda values: numpy.add.reduceat(  # noqa: E731
        numpy.add.reduceat(values, edges[:-1], axis=0), edges[:-1], axis=1)
    weight = mean(alpha)
    colours = mean(part * alpha[..., None]) / numpy.maximum(weight, 1)[..., None]
    covered = weight / mean(numpy.ones_like(alpha))
    icon = numpy.dstack([colours, covered])
    made = vtk.vtkImageData()
    made.SetDimensions(SIDE, SIDE, 1)
    made.GetPointData().SetScalars(
        numpy_support.numpy_to_vtk((255 * icon[::-1]).round().astype(numpy.uint8).reshape(-1, 4), deep=1))
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(out)
    writer.SetInputData(made)
    writer.Write()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
