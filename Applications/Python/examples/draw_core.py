#!/usr/bin/python3
"""Draws the medial surface of a label, coloured by radius. usage: draw_core.py SCAN.nii.gz LABEL OUT.png

Needs python3-nibabel and python3-vtk9, and a display (or xvfb-run).
"""

import sys

import nibabel
import numpy
import voxelcore
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the window's inside

scan, label, picture = sys.argv[1:]
image = nibabel.load(scan)

# nibabel's axes point to the right, the front and the top; ours, as ITK's, to the left, the back and the top.
to_lps = numpy.diag([-1, -1, 1]) @ image.affine[:3, :3]
spacing = numpy.linalg.norm(to_lps, axis=0)
core = voxelcore.core(
    numpy.asanyarray(image.dataobj),
    label=int(label),
    lambda_="1vox",
    spacing=spacing,
    direction=to_lps / spacing,
    origin=image.affine[:3, 3] * (-1, -1, 1),
)
print(core)

surface = core.to_polydata()
surface.GetPointData().SetActiveScalars("Radius")
mapper = vtkPolyDataMapper()
mapper.SetInputData(surface)
mapper.SetScalarRange(0, core.radius.max())
mapper.GetLookupTable().SetHueRange(0.667, 0)  # thin blue, thick red
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetLineWidth(3)
actor.GetProperty().SetAmbient(0.4)
renderer = vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(actor)
renderer.ResetCamera()
camera = renderer.GetActiveCamera()
camera.Azimuth(30)
camera.Elevation(20)
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetSize(800, 600)
window.AddRenderer(renderer)
window.Render()
grab = vtkWindowToImageFilter()
grab.SetInput(window)
writer = vtkPNGWriter()
writer.SetFileName(picture)
writer.SetInputConnection(grab.GetOutputPort())
writer.Write()
