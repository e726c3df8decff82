#include "BallDilation.h"

#include "BallDistances.h"
#include "voxelcore/Base/Library.h"

#include <cmath>

namespace voxelcore
{

std::int32_t
LatticeReach(std::int64_t squared, std::int64_t weight)
{
  auto n = static_cast<std::int64_t>(std::sqrt(static_cast<double>(squared)) / static_cast<double>(weight));
  n += (n + 1) * (n + 1) * weight * weight <= squared ? 1 : 0;
  n -= n * n * weight * weight > squared ? 1 : 0;
  return static_cast<std::int32_t>(n);
}

BallRows::BallRows(const LatticeBall & of)
  : ball(of)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach[axis] = LatticeReach(ball.squaredRadius, ball.weight[axis]);
  }
  ofHalfLength.resize(static_cast<std::size_t>(reach[0]) + 1);
  for (std::int32_t z = -reach[2]; z <= reach[2]; ++z)
  {
    for (std::int32_t y = -reach[1]; y <= reach[1]; ++y)
    {
      const std::int64_t left =
        ball.squaredRadius - ball.weight[1] * ball.weight[1] * y * y - ball.weight[2] * ball.weight[2] * z * z;
      if (left >= 0)
      {
        ofHalfLength[static_cast<std::size_t>(LatticeReach(left, ball.weight[0]))].push_back({ y, z });
      }
    }
  }
}

VoxelShape
Dilated(const VoxelShape & shape, const BallRows & ball, const ProgressCallback & progress)
{
  const VoxelBox & box = shape.Box();
  const auto       margin = ball.Room();
  const auto       room = static_cast<std::size_t>(margin[0] / 64);
  const VoxelBox   grown = Grown(box, margin);
  VoxelShape       dilated(grown);
  if (DistancesAreFaster(ball, box))
  {
    DilateByDistances(shape, ball, dilated, progress);
    return dilated;
  }
  std::vector<std::uint8_t> holds(static_cast<std::size_t>(box.size[1]) * static_cast<std::size_t>(box.size[2]));
  const auto                rowOf = [&](std::int32_t y, std::int32_t z) {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y);
  };
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      holds[rowOf(y, z)] = ranges::any_of(shape.Row(y, z), [](std::uint64_t word) { return word != 0; }) ? 1 : 0;
    }
  }
  ForSlices(grown.size[2], progress, [&](std::int32_t z) {
    BitRow row(dilated.WordsPerRow());
    BitRow spare(row.size());
    for (std::int32_t y = 0; y < grown.size[1]; ++y)
    {
      ranges::fill(row, 0);
      const bool any = AddBallRows(ball, row, spare, [&](std::int32_t dy, std::int32_t dz) {
        const std::int32_t fromY = y - margin[1] - dy;
        const std::int32_t fromZ = z - margin[2] - dz;
        if (fromY < 0 || fromZ < 0 || fromY >= box.size[1] || fromZ >= box.size[2] || holds[rowOf(fromY, fromZ)] == 0)
        {
          return false;
        }
        const auto source = shape.Row(fromY, fromZ);
        for (std::size_t word = 0; word < source.size(); ++word)
        {
          row[word + room] |= source[word];
        }
        return true;
      });
      if (any)
      {
        ranges::copy(row, dilated.Row(y, z).begin());
      }
    }
  });
  return dilated;
}

} // namespace voxelcore
