#pragma once
// Skeletons in reports and provenance.

#include "voxelcore/Report/CoreReport.h"

#include <nlohmann/json.hpp>

namespace voxelcore
{

/** Every option that changes a skeleton. */
nlohmann::ordered_json
SkeletonStageJson(const SkeletonRequest & stage);

/** \throws nlohmann::json::exception when something is missing; UsageError */
SkeletonRequest
ReadSkeletonStage(const nlohmann::ordered_json & json);

/** `inFile`: without the file's name. */
nlohmann::ordered_json
SkeletonRecordJson(const SkeletonRecord & skeleton, bool inFile);

/** Of what SkeletonRecordJson gave. */
std::vector<LoopCut>
ReadLoopCuts(const nlohmann::ordered_json & json);

/** The same; none where there was none. How far sections reach is not told. */
std::optional<BorderNumbers>
ReadBorderNumbers(const nlohmann::ordered_json & json);

/** The part that measuring does not find again: the topology. */
SkeletonRecord
ReadSkeletonRecord(const nlohmann::ordered_json & json);

} // namespace voxelcore
