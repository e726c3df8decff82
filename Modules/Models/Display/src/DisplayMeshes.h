#pragma once
// What is shown, as VTK draws it.

#include "voxelcore/Display/RenderPicture.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace voxelcore
{

/** The array of point scalars that the functions below add: the lengths to be coloured by, in mm. Where there is none
 *  for a point (erosion thickness of closed surfaces is infinite) it is NaN. */
constexpr const char * kShownArray = "Shown";

vtkSmartPointer<vtkPolyData>
SurfacePolyData(const LabelSurfaceMesh & mesh);

/** With normals for smooth shading: faces that meet at a sharp angle, or more than two at an edge, keep their own. */
vtkSmartPointer<vtkPolyData>
MedialPolyData(const DisplayLabel & label, PictureColoring coloring);

/** Tubes of `scale` times the radius, at least `least` mm thick; points without a branch as balls, faces that stay as
 *  they are. */
vtkSmartPointer<vtkPolyData>
CurvePolyData(const DisplayLabel & label, PictureColoring coloring, double scale, double least);

} // namespace voxelcore
