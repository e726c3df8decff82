#pragma once
// From certified results to records, and back.

#include "voxelcore/Labels/LabelMap.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <string>

namespace voxelcore
{

/** A certified skeleton as files hold it; its numbers go into the record. */
SkeletonPart
TakeSkeleton(CertifiedSkeleton skeleton, LabelRecord & record);

/** What a finished file says of a label's shape. */
CertifiedShape
RecordedShape(const CoreReport & made, const LabelRecord & label);


} // namespace voxelcore
