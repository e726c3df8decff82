#include "voxelcore/Masks/MaskDiagnosis.h"

#include "voxelcore/Shape/TouchingPieces.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <vector>

namespace voxelcore
{

namespace
{

/** Noise tells where it is one in so many of what there is: below, a user sees it in the numbers that jobs print. */
constexpr std::uint64_t kNoisePart = 10;
/** An island has less than one in so many of the largest piece's voxels; those that networks leave have a thousandth
 *  and less. */
constexpr std::uint64_t kIslandPart = 100;
/** What it decides is told of from one voxel in so many on. The aorta of TotalSegmentator's test data, whose skeleton
 *  is a third too long by four loops, has one in 146; a block of 480 voxels with a pinhole has one in 480. */
constexpr std::uint64_t kDecidedPart = 400;
/** A ball of 5 voxels around a hole of one: between its rim and the hole runs the curve. */
constexpr std::uint64_t kFaultVoxels = 125;

void
CountTouching(const VoxelShape & shape, const JoinedPieces & joined, MaskDiagnosis & found)
{
  found.touching = joined.PiecesJoined();
  if (found.touching > 0)
  {
    const std::uint64_t before = ComponentSizes(shape).front() + joined.VoxelsAdded();
    const std::uint64_t after = ComponentSizes(joined.shape).front();
    found.touchingVoxels = after - std::min(after, before);
  }
}

} // namespace

bool
MaskDiagnosis::IsNoisy() const
{
  const auto all = static_cast<std::uint64_t>(topology.betti[0] + topology.betti[1] + topology.betti[2]);
  const auto decided = std::max(kFaultVoxels * islands, islandVoxels) + std::max(kFaultVoxels * torn, tornVoxels) +
                       kFaultVoxels * loops + cavities;
  return Sum() > 0 && kNoisePart * Sum() >= all - touching - 1 && kDecidedPart * decided >= voxels;
}

bool
MaskDiagnosis::MayBeTree() const
{
  const auto [pieces, holes, hollows] = topology.betti;
  return 2 * loops > static_cast<std::uint64_t>(holes) &&
         static_cast<std::uint64_t>(pieces) == 1 + touching + torn + islands;
}

std::string
MaskDiagnosis::NoiseText() const
{
  std::string text;
  const auto  add = [&](std::uint64_t count, const char * one, const char * many, const std::string & more) {
    if (count > 0)
    {
      text += (text.empty() ? "" : ", ") + Counted(count, one, many) + more;
    }
  };
  add(islands,
      "island",
      "islands",
      " of at most " + Counted(largestIsland, "voxel", "voxels") + " (" + ShareText(islandVoxels, voxels) +
        " of the voxels)");
  add(torn, "piece a voxel apart", "pieces a voxel apart", "");
  add(loops,
      "loop a voxel wide",
      "loops a voxel wide",
      bridges > 0 ? " (" + Counted(bridges, "bridge", "bridges") + ")" : "");
  add(cavities, "cavity a voxel wide", "cavities a voxel wide", "");
  return text;
}

std::string
MaskDiagnosis::NoiseOptions() const
{
  std::string options = torn + loops + cavities > 0 ? "--mend-shape" : "";
  if (islands > 0)
  {
    options += (options.empty() ? "--min-voxels " : " --min-voxels ") + std::to_string(largestIsland + 1);
  }
  return options;
}

MaskDiagnosis
DiagnoseMask(const VoxelShape & shape, const ProgressCallback & progress)
{
  MaskDiagnosis found;
  found.voxels = shape.CountVoxels();
  found.topology = ComputeShapeTopology(shape);
  const auto [pieces, loops, cavities] = found.topology.betti;
  if (pieces + loops + cavities < 2)
  {
    found.leastPiece = found.voxels;
    return found;
  }
  const JoinedPieces joined = pieces > 1 ? JoinTouchingPieces(shape) : JoinedPieces{ shape, {}, 0 };
  CountTouching(shape, joined, found);
  const MendedShape mended = MendShape(joined.shape, progress);
  found.torn = mended.piecesJoined;
  found.loops = mended.loopsClosed;
  found.bridges = mended.voxelsRemoved;
  found.cavities = mended.cavitiesFilled;
  const std::vector<std::uint64_t> sizes = ComponentSizes(mended.shape);
  if (found.torn > 0)
  {
    const std::uint64_t before = ComponentSizes(joined.shape).front() + mended.voxelsAdded;
    found.tornVoxels = sizes.front() - std::min(sizes.front(), before);
  }
  for (const std::uint64_t size : sizes)
  {
    if (kIslandPart * size < sizes.front())
    {
      ++found.islands;
      found.islandVoxels += size;
      found.largestIsland = std::max(found.largestIsland, size);
    }
    else
    {
      found.leastPiece = size;
    }
  }
  return found;
}

MaskDiagnosis
DiagnoseTouching(const VoxelShape & shape)
{
  MaskDiagnosis found;
  found.voxels = shape.CountVoxels();
  CountTouching(shape, JoinTouchingPieces(shape), found);
  return found;
}

std::string
ShareText(std::uint64_t part, std::uint64_t all)
{
  return RoughText(100 * static_cast<double>(part) / static_cast<double>(all)) + " %";
}

} // namespace voxelcore
