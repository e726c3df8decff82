#pragma once
// Steps of the job `thickness`.

#include "voxelcore/Thickness/ThicknessJob.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** The report with what was measured as its last member. */
std::string
WithThickness(std::string report, const ThicknessResult & result, const ThicknessOptions & options);

} // namespace voxelcore
