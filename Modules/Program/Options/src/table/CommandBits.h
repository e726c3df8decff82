#pragma once
// The commands an option belongs to.

#include "voxelcore/Options/Parameters.h"

namespace voxelcore::table
{

using enum ParameterKind;

constexpr std::uint32_t kCore = static_cast<std::uint32_t>(CommandId::Core);
constexpr std::uint32_t kInfo = static_cast<std::uint32_t>(CommandId::Info);
constexpr std::uint32_t kVerify = static_cast<std::uint32_t>(CommandId::Verify);
constexpr std::uint32_t kPrune = static_cast<std::uint32_t>(CommandId::Prune);
constexpr std::uint32_t kPhantom = static_cast<std::uint32_t>(CommandId::Phantom);
constexpr std::uint32_t kSkeleton = static_cast<std::uint32_t>(CommandId::Skeleton);
constexpr std::uint32_t kMeasure = static_cast<std::uint32_t>(CommandId::Measure);
constexpr std::uint32_t kRender = static_cast<std::uint32_t>(CommandId::Render);
constexpr std::uint32_t kBatch = static_cast<std::uint32_t>(CommandId::Batch);
constexpr std::uint32_t kReconstruct = static_cast<std::uint32_t>(CommandId::Reconstruct);
constexpr std::uint32_t kVoxelize = static_cast<std::uint32_t>(CommandId::Voxelize);
constexpr std::uint32_t kRoots = static_cast<std::uint32_t>(CommandId::Roots);
constexpr std::uint32_t kThickness = static_cast<std::uint32_t>(CommandId::Thickness);
constexpr std::uint32_t kSheets = static_cast<std::uint32_t>(CommandId::Sheets);
constexpr std::uint32_t kStraighten = static_cast<std::uint32_t>(CommandId::Straighten);
constexpr std::uint32_t kCompare = static_cast<std::uint32_t>(CommandId::Compare);
constexpr std::uint32_t kMaps = kThickness | kSheets;
/** Those that join pieces that touch by default (Testing/Performance/Defaults.md says why); `core` keeps the shape of
 *  the paper. */
constexpr std::uint32_t kJoins = kSkeleton | kMaps;
constexpr std::uint32_t kReads = kCore | kInfo | kSkeleton | kRoots | kThickness | kSheets;
constexpr std::uint32_t kReadsValues = kReads | kStraighten | kCompare;
constexpr std::uint32_t kModels = kCore | kPrune;
constexpr std::uint32_t kStages = kCore | kSkeleton;
constexpr std::uint32_t kBranches = kSkeleton | kMeasure;
constexpr std::uint32_t kWrites =
  kModels | kPhantom | kBranches | kRender | kReconstruct | kVoxelize | kRoots | kMaps | kStraighten | kCompare;
constexpr std::uint32_t kAll = kWrites | kInfo | kVerify;

} // namespace voxelcore::table
