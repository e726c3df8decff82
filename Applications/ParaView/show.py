"""A scan's surface, its medial surface coloured by radius, and its curve skeleton, in ParaView: a picture and a state.

usage: pvbatch show.py VoxelCore.xml SCAN OUT [LABEL]      writes OUT.png and OUT.pvsm; SCAN: .vti .nrrd .mha
"""

import sys

from paraview import simple

plugin, scan, out = sys.argv[1:4]
label = int(sys.argv[4]) if len(sys.argv) > 4 else 1
simple.LoadPlugin(plugin, remote=False)
image = simple.OpenDataFile(scan)
image.UpdatePipeline()
view = simple.CreateRenderView(ViewSize=[1400, 1000], OrientationAxesVisibility=0, UseColorPaletteForBackground=0)
view.Background = [1, 1, 1]

chosen = simple.Threshold(Input=image, LowerThreshold=label, UpperThreshold=label, AllScalars=0)
surface = simple.Show(simple.ExtractSurface(Input=chosen), view)
surface.ColorArrayName = ["POINTS", ""]
surface.DiffuseColor, surface.Opacity = [0.75, 0.78, 0.82], 0.2

core = simple.VoxelCore(Input=image, Label=label)
shown = simple.Show(core, view)
simple.ColorBy(shown, ("POINTS", "Radius"))
shown.RescaleTransferFunctionToDataRange()
colors = simple.GetColorTransferFunction("Radius")
colors.ApplyPreset("Viridis (matplotlib)", True)
bar = simple.GetScalarBar(colors, view)
bar.LabelFormat = bar.RangeLabelFormat = "%.1f"
bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = "Radius (mm)", "", [0, 0, 0], [0, 0, 0]
shown.SetScalarBarVisibility(view, True)

skeleton = simple.CurveSkeleton(Input=image, Label=label)
skeleton.UpdatePipeline()
sides = skeleton.GetDataInformation().GetBounds()
thick = 0.006 * sorted((sides[1] - sides[0], sides[3] - sides[2], sides[5] - sides[4]))[-1]
tubes = simple.Show(simple.Tube(Input=skeleton, Radius=thick, Capping=1), view)
tubes.ColorArrayName = ["POINTS", ""]
tubes.DiffuseColor = [0.85, 0.1, 0.15]

simple.SetActiveView(view)
camera = simple.GetActiveCamera()
simple.ResetCamera(view)
camera.Azimuth(35)
camera.Elevation(25)
simple.ResetCamera(view)
camera.Zoom(1.05)
simple.SaveScreenshot(f"{out}.png", view)
simple.SaveState(f"{out}.pvsm")
