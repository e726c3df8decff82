#pragma once
// `voxelcore thickness`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Thickness/ThicknessJob.h"

namespace voxelcore
{

extern const Command kThicknessCommand;

/** No path is read, and none need be there. */
ThicknessOptions
ThicknessOptionsWithoutFiles(const ParameterValues & values);
/** \throws UsageError, naming the option, for a value without sense */
ThicknessOptions
ThicknessOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
