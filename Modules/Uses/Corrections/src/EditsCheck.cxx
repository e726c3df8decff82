#include "voxelcore/Corrections/TreeEdits.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <map>
#include <set>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

bool
IsIn(const VoxelShape & shape, const Voxel & voxel)
{
  return shape.Contains(voxel[0], voxel[1], voxel[2]);
}

/** In how many voxels two shapes differ. */
std::uint64_t
CountDifferences(const VoxelShape & a, const VoxelShape & b)
{
  const VoxelBox box = BoxOfBoth(a.Box(), b.Box());
  std::uint64_t  count = 0;
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        count += a.Contains(x, y, z) != b.Contains(x, y, z) ? 1 : 0;
      }
    }
  }
  return count;
}

} // namespace

void
RequireEdits(const VoxelShape &        before,
             const TopologyNumbers &   counted,
             std::span<const TreeEdit> edits,
             const EditedTree &        edited,
             const TopologyNumbers &   certified,
             const std::string &       name)
{
  std::map<Voxel, bool>       isIn; // of what is touched
  std::array<std::int64_t, 3> betti = counted.betti;
  // Each once.
  const std::set<std::size_t> all(edited.order.begin(), edited.order.end());
  bool                        holds = edits.size() == edited.outcomes.size() && edits.size() == edited.order.size() &&
               edits.size() == all.size() && (all.empty() || *all.rbegin() < edits.size());
  for (std::size_t at = 0; holds && at < edits.size(); ++at)
  {
    const std::size_t       i = edited.order[at];
    const TreeEdit::Kind    kind = edits[i].kind;
    const TreeEditOutcome & outcome = edited.outcomes[i];
    const bool              isAdded = kind == TreeEdit::Kind::Join || kind == TreeEdit::Kind::Path;
    holds = outcome.misfit.empty() ? IsChangeOf(kind, outcome.change) : outcome.voxels.empty();
    for (const Voxel & voxel : outcome.voxels)
    {
      const auto was = isIn.try_emplace(voxel, IsIn(before, voxel)).first;
      holds = holds && was->second != isAdded;
      was->second = isAdded;
    }
    for (std::size_t k = 0; k < 3 && outcome.misfit.empty(); ++k)
    {
      betti[k] += outcome.change[k];
    }
  }
  std::uint64_t differences = 0;
  for (const auto & [voxel, is] : isIn)
  {
    differences += is != IsIn(before, voxel) ? 1 : 0;
    holds = holds && is == IsIn(edited.shape, voxel);
  }
  if (!holds || differences != CountDifferences(before, edited.shape))
  {
    throw CertificateError(name + ": the edited body is not what its edits make of it; nothing was written");
  }
  if (betti != certified.betti)
  {
    throw CertificateError(name + ": the edited body's skeleton does not have its topology; nothing was written");
  }
}

} // namespace voxelcore
