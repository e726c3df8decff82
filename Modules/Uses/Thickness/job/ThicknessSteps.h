#pragma once
// Steps of the job `thickness`.

#include "voxelcore/Thickness/ThicknessJob.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** What was measured, for the report: a list with a record for each label, and for the separation. */
std::string
ThicknessJson(const ThicknessResult & result, const ThicknessOptions & options);

} // namespace voxelcore
