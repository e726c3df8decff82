#include "EditsJson.h"

#include <utility>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

Json
SimplifiedJson(const EditRecord::Simplified & simplified, bool inFile)
{
  Json json{ { "before", TopologyJson(simplified.before) },
             { "after", TopologyJson(simplified.after) },
             { "as_asked", simplified.asAsked },
             { "reason", simplified.reason },
             { "cuts", simplified.cuts },
             { "fills", simplified.fills },
             { "voxels_added", simplified.voxelsAdded },
             { "voxels_removed", simplified.voxelsRemoved } };
  if (!inFile)
  {
    json["changes"] = Json::array();
    for (const EditRecord::Change & change : simplified.changes)
    {
      json["changes"].push_back({ { "kind", change.isFill ? "fill" : "cut" },
                                  { "centre_mm", change.centre },
                                  { "voxels", change.voxels },
                                  { "cost_voxels", change.cost },
                                  { "pieces", change.difference[0] },
                                  { "loops", change.difference[1] },
                                  { "cavities", change.difference[2] } });
    }
  }
  return json;
}

} // namespace

nlohmann::ordered_json
TopologyJson(const TopologyNumbers & topology)
{
  return { { "euler", topology.euler }, { "betti", topology.betti } };
}

nlohmann::ordered_json
VoxelChangesJson(const VoxelChanges & changes)
{
  Json list = Json::array();
  for (const VoxelRun & run : changes)
  {
    list.push_back(VoxelChangesText({ run }));
  }
  return list;
}

nlohmann::ordered_json
EditRecordJson(const EditRecord & edits, bool inFile)
{
  Json json{ { "cavities_filled", edits.cavitiesFilled },
             { "voxels_added", edits.voxelsAdded },
             { "components_joined", edits.componentsJoined },
             { "components_removed", edits.componentsRemoved },
             { "voxels_removed", edits.voxelsRemoved } };
  for (const auto & [name, filtered] : { std::pair("median", &edits.filtered), std::pair("denoised", &edits.denoised) })
  {
    if (*filtered)
    {
      json[name] = { { "voxels_added", (*filtered)->voxelsAdded }, { "voxels_removed", (*filtered)->voxelsRemoved } };
    }
  }
  if (edits.mended)
  {
    json["mended"] = { { "pieces_joined", edits.mended->piecesJoined },
                       { "loops_closed", edits.mended->loopsClosed },
                       { "cavities_filled", edits.mended->cavitiesFilled },
                       { "voxels_added", edits.mended->voxelsAdded },
                       { "voxels_removed", edits.mended->voxelsRemoved } };
  }
  for (const auto & [name, filled] : { std::pair("closed", &edits.closed),
                                       std::pair("hollows_filled", &edits.hollows),
                                       std::pair("slices_filled", &edits.slices),
                                       std::pair("torn_pieces_joined", &edits.torn) })
  {
    if (*filled)
    {
      json[name] = { { "holes", (*filled)->holes },
                     { "voxels_added", (*filled)->voxelsAdded },
                     { "components_joined", (*filled)->componentsJoined } };
    }
  }
  if (edits.connected)
  {
    json["connected"] = { { "closed_mask", TopologyJson(edits.connected->closed) },
                          { "pieces_joined", edits.connected->piecesJoined },
                          { "voxels_added", edits.connected->voxelsAdded },
                          { "voxels_removed", edits.connected->voxelsRemoved } };
    if (!inFile)
    {
      json["connected"]["changes"] = VoxelChangesJson(edits.connected->changes);
    }
  }
  if (edits.touching)
  {
    json["touching"] = { { "pieces_joined", edits.touching->piecesJoined },
                         { "pieces_apart", edits.touching->piecesApart },
                         { "voxels_added", edits.touching->voxelsAdded } };
    if (!inFile)
    {
      json["touching"]["changes"] = VoxelChangesJson(edits.touching->changes);
    }
  }
  if (edits.smoothed)
  {
    json["smoothed"] = { { "voxels_added", edits.smoothed->voxelsAdded },
                         { "voxels_removed", edits.smoothed->voxelsRemoved },
                         { "largest_shift_voxels", edits.smoothed->largestShift } };
  }
  if (edits.simplified)
  {
    json["topology_simplified"] = SimplifiedJson(*edits.simplified, inFile);
  }
  if (edits.changed)
  {
    json["changed"] = { { "voxels_added", edits.changed->voxelsAdded },
                        { "voxels_removed", edits.changed->voxelsRemoved } };
  }
  return json;
}

} // namespace voxelcore
