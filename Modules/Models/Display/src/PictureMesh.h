#pragma once
// A mesh as it is drawn in a picture.

#include "voxelcore/Models/DisplayContent.h"

class vtkLookupTable;
class vtkPolyData;
class vtkRenderer;

namespace voxelcore
{

/** Adds a mesh to a renderer, polygons lit, lines and points in their plain colour: that of `scale` for the point array
 *  kShownArray, or `color` where there is no scale. `pixel`: pixels drawn for each of the picture. Nothing is added for
 *  a mesh that is null or has an opacity of 0. */
void
AddMesh(vtkRenderer *    renderer,
        vtkPolyData *    mesh,
        const Color &    color,
        vtkLookupTable * scale,
        double           opacity,
        int              pixel);

} // namespace voxelcore
