#pragma once
// Topology and edits of shapes in reports and provenance.

#include "voxelcore/Report/CoreReport.h"

#include <nlohmann/json.hpp>

namespace voxelcore
{

nlohmann::ordered_json
TopologyJson(const TopologyNumbers & topology);

/** A text for each run, as VoxelChangesText writes it. */
nlohmann::ordered_json
VoxelChangesJson(const VoxelChanges & changes);

/** `inFile`: without the list of changes. */
nlohmann::ordered_json
EditRecordJson(const EditRecord & edits, bool inFile);

} // namespace voxelcore
