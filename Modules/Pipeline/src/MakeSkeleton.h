#pragma once
// From one label's certified core to its certified, measured skeleton.

#include "voxelcore/CoreReport.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/Progress.h"
#include "voxelcore/SkeletonModel.h"
#include "voxelcore/SkeletonStage.h"

namespace voxelcore
{

/** Fills record.skeleton but for the output's name. `surface` in LPS mm, the core of that label.
 *  \throws CertificateError when the skeleton does not have the shape's topology; Cancelled */
SkeletonPart
MakeSkeleton(const ModelPart &        surface,
             const SkeletonStage &    stage,
             const SpacingWeights &   weights,
             const ImageGeometry &    geometry,
             LabelRecord &            record,
             const ProgressCallback & progress);

/** How branches are measured on a grid of this spacing. */
MeasureOptions
MeasuringOf(const BranchOptions & options, const Vector3 & spacing);

/** Cuts and splits as the options ask for, and measures; tells what it did in `record`. */
void
CutAndMeasure(SkeletonPart & part, const BranchOptions & options, const Vector3 & spacing, SkeletonRecord & record);

} // namespace voxelcore
