#pragma once
// `voxelcore sheets`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Sheets/SheetsJob.h"

namespace voxelcore
{

extern const Command kSheetsCommand;

/** \throws UsageError, naming the option, for a value without sense */
SheetsOptions
SheetsOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
