#include "EditRecords.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Masks/DepthSimplification.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace voxelcore
{

void
AddEdits(const EditRecord & record, EditRecord & sum)
{
  sum.cavitiesFilled += record.cavitiesFilled;
  sum.voxelsAdded += record.voxelsAdded;
  sum.componentsJoined += record.componentsJoined;
  sum.componentsRemoved += record.componentsRemoved;
  sum.voxelsRemoved += record.voxelsRemoved;
  for (auto EditRecord::*const member : { &EditRecord::filtered, &EditRecord::denoised })
  {
    if (const auto & one = record.*member)
    {
      auto & all = sum.*member;
      all = all.value_or(EditRecord::Filtered());
      all->voxelsAdded += one->voxelsAdded;
      all->voxelsRemoved += one->voxelsRemoved;
    }
  }
  if (record.changed)
  {
    sum.changed = record.changed; // of the only label
  }
  if (record.mended)
  {
    EditRecord::Mended & mended = sum.mended ? *sum.mended : sum.mended.emplace(EditRecord::Mended());
    mended.voxelsAdded += record.mended->voxelsAdded;
    mended.voxelsRemoved += record.mended->voxelsRemoved;
    mended.piecesJoined += record.mended->piecesJoined;
    mended.loopsClosed += record.mended->loopsClosed;
    mended.cavitiesFilled += record.mended->cavitiesFilled;
  }
  for (auto EditRecord::*const member :
       { &EditRecord::closed, &EditRecord::hollows, &EditRecord::slices, &EditRecord::torn })
  {
    if (const auto & one = record.*member)
    {
      auto & all = sum.*member;
      all = all.value_or(EditRecord::Filled());
      all->voxelsAdded += one->voxelsAdded;
      all->componentsJoined += one->componentsJoined;
      all->holes += one->holes;
    }
  }
  if (record.connected)
  {
    auto &       all = sum.connected ? *sum.connected : sum.connected.emplace(EditRecord::Connected());
    const auto & one = *record.connected;
    all.closed.euler += one.closed.euler;
    for (std::size_t i = 0; i < 3; ++i)
    {
      all.closed.betti[i] += one.closed.betti[i];
    }
    all.piecesJoined += one.piecesJoined;
    all.voxelsAdded += one.voxelsAdded;
    all.voxelsRemoved += one.voxelsRemoved;
  }
  if (record.touching)
  {
    auto & all = sum.touching ? *sum.touching : sum.touching.emplace(EditRecord::Touching());
    all.voxelsAdded += record.touching->voxelsAdded;
    all.piecesJoined += record.touching->piecesJoined;
    all.piecesApart += record.touching->piecesApart;
  }
  if (record.smoothed)
  {
    EditRecord::Smoothed & smoothed = sum.smoothed ? *sum.smoothed : sum.smoothed.emplace(EditRecord::Smoothed());
    smoothed.voxelsAdded += record.smoothed->voxelsAdded;
    smoothed.voxelsRemoved += record.smoothed->voxelsRemoved;
    smoothed.largestShift = std::max(smoothed.largestShift, record.smoothed->largestShift);
  }
  if (record.simplified)
  {
    auto &       all = sum.simplified ? *sum.simplified : sum.simplified.emplace(EditRecord::Simplified());
    const auto & one = *record.simplified;
    for (std::size_t i = 0; i < 3; ++i)
    {
      all.before.betti[i] += one.before.betti[i];
      all.after.betti[i] += one.after.betti[i];
    }
    all.cuts += one.cuts;
    all.fills += one.fills;
    all.voxelsAdded += one.voxelsAdded;
    all.voxelsRemoved += one.voxelsRemoved;
  }
}

std::vector<std::string>
EditsInWords(const EditRecord & sum, const ShapeEditOptions & options)
{
  std::vector<std::string> notes;
  const auto hasChanged = [](const auto & record) { return record && record->voxelsAdded + record->voxelsRemoved > 0; };
  if (hasChanged(sum.filtered))
  {
    notes.push_back("median of " + std::to_string(options.median->voxels) +
                    " voxels: " + Counted(sum.filtered->voxelsAdded, "voxel", "voxels") + " added, " +
                    std::to_string(sum.filtered->voxelsRemoved) + " removed");
  }
  if (hasChanged(sum.denoised))
  {
    notes.push_back("denoised: " + Counted(sum.denoised->voxelsAdded, "voxel", "voxels") + " added, " +
                    std::to_string(sum.denoised->voxelsRemoved) + " removed");
  }
  if (hasChanged(sum.mended))
  {
    notes.push_back("mended: " + Counted(sum.mended->piecesJoined, "piece", "pieces") + " joined, " +
                    Counted(sum.mended->loopsClosed, "loop", "loops") + " closed, " +
                    Counted(sum.mended->cavitiesFilled, "cavity", "cavities") + " filled; " +
                    Counted(sum.mended->voxelsAdded, "voxel", "voxels") + " added, " +
                    std::to_string(sum.mended->voxelsRemoved) + " removed");
  }
  const auto joined = [](std::uint64_t components, const char * where) {
    return components > 0 ? ", " + Counted(components, "component", "components") + where + " joined" : std::string();
  };
  const auto filled = [&](const std::string & what, const auto & record) {
    if (record && record->voxelsAdded > 0)
    {
      notes.push_back(what + " with " + Counted(record->voxelsAdded, "voxel", "voxels") +
                      joined(record->componentsJoined, ""));
    }
  };
  filled("gaps up to " + (options.close ? options.close->text : "") + " closed", sum.closed);
  filled(Counted(sum.hollows ? sum.hollows->holes : 0, "hollow", "hollows") + " filled", sum.hollows);
  filled(Counted(sum.slices ? sum.slices->holes : 0, "hole", "holes") + " of slices filled", sum.slices);
  if (hasChanged(sum.connected))
  {
    notes.push_back(
      "voxels that touch over edges and corners joined: " +
      Counted(static_cast<std::uint64_t>(std::max<std::int64_t>(0, sum.connected->piecesJoined)), "piece", "pieces") +
      " fewer; " + Counted(sum.connected->voxelsAdded, "voxel", "voxels") + " added, " +
      std::to_string(sum.connected->voxelsRemoved) + " removed");
  }
  if (sum.touching)
  {
    notes.push_back(
      "pieces that touch over edges and corners joined: " + Counted(sum.touching->piecesJoined, "piece", "pieces") +
      " fewer, with " + Counted(sum.touching->voxelsAdded, "voxel", "voxels") +
      (sum.touching->piecesApart > 0
         ? "; " + std::to_string(sum.touching->piecesApart) +
             " more touch where the mask is too rough: clean it with --denoise or --mend-shape"
         : "") +
      "; to keep them apart: --connectivity 6");
  }
  if (options.fillCavities && sum.cavitiesFilled > 0)
  {
    notes.push_back(
      Counted(sum.cavitiesFilled, "cavity", "cavities") + " filled with " +
      Counted(sum.voxelsAdded, "voxel", "voxels") + joined(sum.componentsJoined, " in them") +
      (options.fillUnasked ? ", so that curves are left; to keep surfaces around them: --cavities keep" : ""));
  }
  if (sum.torn && sum.torn->componentsJoined > 0)
  {
    notes.push_back(Counted(sum.torn->componentsJoined, "torn piece", "torn pieces") + " joined with " +
                    Counted(sum.torn->voxelsAdded, "voxel", "voxels"));
  }
  if ((options.minVoxels || options.largest) && sum.componentsRemoved > 0)
  {
    notes.push_back(Counted(sum.componentsRemoved, "component", "components") + " removed, with " +
                    Counted(sum.voxelsRemoved, "voxel", "voxels"));
  }
  if (hasChanged(sum.smoothed))
  {
    char shift[32];
    (void)std::snprintf(shift, sizeof(shift), "%.2f", sum.smoothed->largestShift);
    notes.push_back("smoothed: " + Counted(sum.smoothed->voxelsAdded, "voxel", "voxels") + " added, " +
                    std::to_string(sum.smoothed->voxelsRemoved) + " removed; the boundary moved by " + shift +
                    " voxels at most");
  }
  if (hasChanged(sum.simplified))
  {
    const EditRecord::Simplified & simplified = *sum.simplified;
    notes.push_back("topology simplified: " + CountsText(simplified.before) + " became " +
                    CountsText(simplified.after) + " by " + Counted(simplified.cuts, "cut", "cuts") + " of " +
                    Counted(simplified.voxelsRemoved, "voxel", "voxels") + " and " +
                    Counted(simplified.fills, "fill", "fills") + " of " + std::to_string(simplified.voxelsAdded));
  }
  if (hasChanged(sum.changed))
  {
    notes.push_back("voxels changed as listed: " + Counted(sum.changed->voxelsAdded, "voxel", "voxels") + " added, " +
                    std::to_string(sum.changed->voxelsRemoved) + " removed");
  }
  return notes;
}

} // namespace voxelcore
