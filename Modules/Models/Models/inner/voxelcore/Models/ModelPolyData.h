#pragma once
// Medial surfaces in VTK's form, in memory: what a .vtp holds.

#include "voxelcore/Models/MedialModel.h"

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace voxelcore
{

/** The points, cells and arrays of the .vtp that WriteModel would write of this model, with `keepEdges` also the field
 *  arrays EdgeVertices and EdgeLambda. \throws UsageError when edges are to be kept whose measures are not known. */
vtkSmartPointer<vtkPolyData>
MakePolyData(const MedialModel & model, bool keepEdges);

/** The inverse: the model in polydata that MakePolyData made, or VTK's reader found in a .vtp of ours. Its arrays must
 *  be as they were; only SPACE may be missing (MedialModel::inLps). \throws InputError */
MedialModel
ModelFromPolyData(vtkPolyData & data);

} // namespace voxelcore
