#pragma once
// The parameters of a run as JSON, and back.

#include "voxelcore/Report/CoreReport.h"

#include <nlohmann/json.hpp>

namespace voxelcore
{

/** `inFile`: without what does not change the result. */
nlohmann::ordered_json
ParametersJson(const ParameterRecord & parameters, bool inFile);

/** \throws nlohmann::json::exception when something is missing. */
ParameterRecord
ReadParameters(const nlohmann::ordered_json & json);

} // namespace voxelcore
