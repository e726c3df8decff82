#include "SimpleFlips.h"

#include <queue>
#include <vector>

namespace voxelcore
{

namespace
{

struct Waiting
{
  std::uint64_t priority; // cost, then who came first
  Voxel         at;

  bool
  operator<(const Waiting & other) const
  {
    return priority < other.priority;
  }
};

} // namespace

void
FlipSimpleVoxels(PaddedShape & shape, PaddedShape & open, const PaddedCost & cost, const ProgressCallback & progress)
{
  // A voxel of `open` leaves it for the queue, and comes back when its turn finds it not simple.
  std::priority_queue<Waiting> queue;
  std::uint32_t                arrival = ~std::uint32_t{ 0 };
  const auto                   push = [&](const Voxel & at) {
    open.Flip(at);
    queue.push({ std::uint64_t{ cost(at) } << 32 | arrival--, at });
  };
  const Voxel & size = shape.Size();
  for (std::int32_t z = 1; z + 1 < size[2]; ++z)
  {
    for (std::int32_t y = 1; y + 1 < size[1]; ++y)
    {
      shape.VisitBoundary(y, z, [&](const Voxel & at) {
        if (open.Contains(at) && IsSimpleVoxel(shape.Around(at)))
        {
          push(at);
        }
      });
    }
  }
  for (std::uint64_t turn = 0; !queue.empty(); ++turn)
  {
    if (turn % 65536 == 0)
    {
      ReportProgress(progress, "simplifying", 0);
    }
    const Voxel at = queue.top().at;
    queue.pop();
    if (!IsSimpleVoxel(shape.Around(at)))
    {
      open.Flip(at);
      continue;
    }
    shape.Flip(at);
    for (Neighbourhood left = open.Around(at); left != 0; left &= left - 1)
    {
      const auto  bit = std::countr_zero(left);
      const Voxel next{ at[0] + bit % 3 - 1, at[1] + bit / 3 % 3 - 1, at[2] + bit / 9 - 1 };
      if (IsSimpleVoxel(shape.Around(next)))
      {
        push(next);
      }
    }
  }
}

} // namespace voxelcore
