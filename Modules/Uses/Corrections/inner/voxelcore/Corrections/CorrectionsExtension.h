#pragma once
// `voxelcore skeleton --annotations` and `--edits`

#include "voxelcore/Corrections/CorrectionsJob.h"
#include "voxelcore/Options/Command.h"

namespace voxelcore
{

extern const Extension kCorrectionsExtension;

/** Of a command that asks for one of them. \throws UsageError, naming the option, for a value without sense */
CorrectionsOptions
CorrectionsOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
