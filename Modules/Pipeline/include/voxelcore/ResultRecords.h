#pragma once
// From certified results to records and files, and back.

#include "voxelcore/CoreReport.h"
#include "voxelcore/LabelMap.h"
#include "voxelcore/OutputTransaction.h"
#include "voxelcore/SkeletonModel.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** A certified skeleton as files hold it; its numbers go into the record. */
SkeletonPart
TakeSkeleton(CertifiedSkeleton skeleton, LabelRecord & record);

/** What a finished file says of a label's shape. */
CertifiedShape
RecordedShape(const CoreReport & made, const LabelRecord & label);

/** Writes a model under its staged name; what the format could not hold is added to `notes`. */
void
WriteStagedModel(OutputTransaction &           transaction,
                 const std::filesystem::path & target,
                 const MedialModel &           model,
                 const ModelOptions &          options,
                 std::vector<std::string> &    notes);

} // namespace voxelcore
