#include "voxelcore/Masks/ShapeClosing.h"

#include "BallDilation.h"
#include "BallDistances.h"
#include "EditedBits.h"
#include "voxelcore/Base/LengthText.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kMostReach = 1000; // voxels

[[noreturn]] void
RefuseWidth(std::string_view text, const char * why)
{
  throw UsageError("width '" + std::string(text) + "' " + why +
                   "; write a number and mm or vox, for example 2.5mm or 4vox");
}

/** Puts in each voxel of the shape's box about which the ball lies in what was dilated by it. */
void
AddEroded(const VoxelShape & dilated, const BallRows & ball, VoxelShape & shape, const ProgressCallback & progress)
{
  const auto room = static_cast<std::size_t>(ball.Room()[0] / 64);
  ForSlices(shape.Box().size[2], progress, [&](std::int32_t z) {
    BitRow row(dilated.WordsPerRow());
    BitRow spare(row.size());
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      const auto    target = shape.Row(y, z);
      const auto    reached = std::as_const(dilated).Row(y + ball.reach[1], z + ball.reach[2]);
      std::uint64_t open = 0;
      for (std::size_t word = 0; word < target.size(); ++word)
      {
        open |= reached[word + room] & ~target[word];
      }
      if (open == 0)
      {
        continue;
      }
      ranges::fill(row, ~std::uint64_t{ 0 });
      for (std::size_t half = ball.ofHalfLength.size(); half-- > 0;)
      {
        if (half + 1 < ball.ofHalfLength.size())
        {
          Spread<false>(row, spare);
        }
        for (const auto [dy, dz] : ball.ofHalfLength[half])
        {
          const auto source = dilated.Row(y + ball.reach[1] + dy, z + ball.reach[2] + dz);
          for (std::size_t word = 0; word < row.size(); ++word)
          {
            row[word] &= source[word];
          }
        }
      }
      for (std::size_t word = 0; word < target.size(); ++word)
      {
        target[word] |= row[word + room];
      }
    }
  });
}

void
Close(VoxelShape & shape, const LatticeBall & ball, const ProgressCallback & progress)
{
  const BallRows rows(ball);
  if (!rows.IsOneVoxel() && shape.Box().size[0] > 0)
  {
    const VoxelShape dilated = Dilated(shape, rows, PartOfProgress(progress, 0, 0.5));
    const auto       second = PartOfProgress(progress, 0.5, 1);
    if (DistancesAreFaster(rows, shape.Box()))
    {
      ErodeByDistances(dilated, rows, shape, second);
    }
    else
    {
      AddEroded(dilated, rows, shape, second);
    }
  }
}

} // namespace

GapWidth
ParseGapWidth(std::string_view text)
{
  const LengthText length = ReadLength(text, [&](const char * why) { RefuseWidth(text, why); });
  if (length.value == 0)
  {
    RefuseWidth(text, "is 0");
  }
  if (!length.unit.empty() && length.unit != "mm" && length.unit != "vox")
  {
    RefuseWidth(text, "has an unknown unit");
  }
  return { length.value, length.unit == "vox" ? SpatialUnit::Voxels : SpatialUnit::Millimetres, length.text };
}

LatticeBall
BallOfDiameter(const GapWidth & width, const ImageGeometry & geometry)
{
  if (geometry.unit == SpatialUnit::Voxels && width.unit == SpatialUnit::Millimetres)
  {
    RefuseMillimetres(width.text);
  }
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  const auto           smallest = static_cast<double>(*ranges::min_element(weights.weight));
  const double diameter = width.unit == SpatialUnit::Voxels ? width.value * smallest : width.value / weights.unit;
  if (diameter > 2.0 * kMostReach * smallest)
  {
    throw InputError(width.text + " is more than 2000 voxels; give a smaller width");
  }
  // Lengths in mm are rounded on their way here: 2.8 mm is four voxels of 0.7 mm.
  return { weights.weight, static_cast<std::int64_t>(0.25 * diameter * diameter * (1 + 1e-9)) };
}

EditedShape
CloseShape(VoxelShape shape, const LatticeBall & ball, const ProgressCallback & progress)
{
  const Additions before(shape);
  Close(shape, ball, progress);
  return before.To(std::move(shape));
}

} // namespace voxelcore
