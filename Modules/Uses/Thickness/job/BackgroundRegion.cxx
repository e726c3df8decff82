#include "BackgroundRegion.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Thickness/VoxelHull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

/** The bits of row `from`, which begins at voxel `fromX`, as far as they lie over row `to`, which begins at `toX`:
 *  change(word of to, bits). */
template <typename TChange>
void
OverRow(const ConstShapeRow & from, std::int32_t fromX, std::int32_t toX, std::size_t toWords, const TChange & change)
{
  const std::int64_t shift = std::int64_t{ fromX } - toX;
  const auto         low = static_cast<unsigned>(((shift % 64) + 64) % 64);
  const std::int64_t first = (shift - low) / 64;
  for (std::size_t word = 0; word < from.size(); ++word)
  {
    const std::uint64_t bits = from[word];
    const auto          place = first + static_cast<std::int64_t>(word);
    const auto          put = [&](std::int64_t at, std::uint64_t some) {
      if (some != 0 && at >= 0 && at < static_cast<std::int64_t>(toWords))
      {
        change(static_cast<std::size_t>(at), some);
      }
    };
    put(place, bits << low);
    if (low != 0)
    {
      put(place + 1, bits >> (64 - low));
    }
  }
}

/** change(row of the shape, word, bits) for the voxels of another shape. */
template <typename TChange>
void
OverShape(VoxelShape & shape, const VoxelShape & other, const TChange & change)
{
  const VoxelBox & box = shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      OverRow(other.RowAnywhere(y + box.lower[1] - other.Box().lower[1], z + box.lower[2] - other.Box().lower[2]),
              other.Box().lower[0],
              box.lower[0],
              row.size(),
              [&](std::size_t word, std::uint64_t bits) { change(row, word, bits); });
    }
  }
}

VoxelBox
BoxAround(const std::vector<VoxelShape> & shapes)
{
  std::array<std::int32_t, 3> lower{};
  std::array<std::int32_t, 3> upper{};
  lower.fill(std::numeric_limits<std::int32_t>::max());
  upper.fill(0);
  for (const VoxelShape & shape : shapes)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], shape.Box().lower[axis]);
      upper[axis] = std::max(upper[axis], shape.Box().lower[axis] + shape.Box().size[axis]);
    }
  }
  return { lower, { upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2] } };
}

VoxelShape
FullBox(const VoxelBox & box)
{
  VoxelShape shape(box);
  const auto width = static_cast<std::size_t>(box.size[0]);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        row[word] = width >= 64 * (word + 1) ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << (width % 64)) - 1;
      }
    }
  }
  return shape;
}

/** The labels of the scan, or the mask, that --within names. */
LabelMap
ReadWithin(const ThicknessOptions & options, const ImageGeometry & geometry, const ProgressCallback & progress)
{
  const std::string & within = options.within;
  ReadOptions         reading = options.core.reading;
  reading.binary = true;
  reading.refuseGrey = false;
  if (!NamesFile(within))
  {
    if (reading.threshold)
    {
      throw UsageError("--within " + within + ": a grey scan has no labels; give a mask");
    }
    reading.labels = within;
    return ReadLabelVolume(options.core.scan, reading, progress);
  }
  ReadOptions mask;
  mask.binary = true;
  mask.crop = reading.crop;
  mask.spacing = reading.spacing;
  mask.orthonormalize = reading.orthonormalize;
  mask.niftiForm = reading.niftiForm;
  LabelMap map = ReadLabelVolume(within, mask, progress);
  RequireSamePlace(map.geometry, geometry, "--within", within);
  return map;
}

} // namespace

VoxelShape
RegionOfBackground(const ThicknessOptions &        options,
                   const ImageGeometry &           geometry,
                   const std::vector<VoxelShape> & shapes,
                   const ProgressCallback &        progress)
{
  if (options.separation == SeparationRegion::Within)
  {
    LabelMap map = ReadWithin(options, geometry, progress);
    return std::move(map.labels.front().shape);
  }
  if (options.separation == SeparationRegion::Box)
  {
    return FullBox(BoxAround(shapes));
  }
  VoxelShape hull = HullOfVoxels(shapes);
  if (hull.CountVoxels() == 0)
  {
    throw InputError(options.core.scan.string() +
                     ": --separation hull: the labels lie in one plane; give --separation box");
  }
  return hull;
}

VoxelShape
BackgroundIn(VoxelShape region, const std::vector<VoxelShape> & shapes)
{
  for (const VoxelShape & shape : shapes)
  {
    OverShape(region, shape, [](const ShapeRow & row, std::size_t word, std::uint64_t bits) { row[word] &= ~bits; });
  }
  region.Compact();
  return region;
}

std::vector<char>
BallsAtRegion(const PaintingBalls &           balls,
              const ImageGeometry &           geometry,
              const VoxelShape &              region,
              const std::vector<VoxelShape> & shapes)
{
  // What is outside, one voxel further than the region's box: all beyond is outside, too.
  VoxelBox box = region.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= 1;
    box.size[axis] += 2;
  }
  VoxelShape outside = FullBox(box);
  const auto take = [](const ShapeRow & row, std::size_t word, std::uint64_t bits) { row[word] &= ~bits; };
  OverShape(outside, region, take);
  for (const VoxelShape & shape : shapes)
  {
    OverShape(outside, shape, take);
  }
  const auto isAnyIn = [&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
    const auto row = outside.Row(y, z);
    const auto first = static_cast<std::size_t>(begin) / 64;
    const auto last = static_cast<std::size_t>(end - 1) / 64;
    for (std::size_t word = first; word <= last; ++word)
    {
      std::uint64_t bits = row[word];
      bits &= word == first ? ~std::uint64_t{ 0 } << (static_cast<unsigned>(begin) % 64) : ~std::uint64_t{ 0 };
      bits &= word == last ? ~std::uint64_t{ 0 } >> (63 - static_cast<unsigned>(end - 1) % 64) : ~std::uint64_t{ 0 };
      if (bits != 0)
      {
        return true;
      }
    }
    return false;
  };
  const auto touches = [&](std::size_t ball) {
    Vector3 middle{};
    Vector3 reach{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] = balls.centres[ball][axis] - box.lower[axis] - 0.5; // of voxel indices
      reach[axis] = balls.radius[ball] / geometry.spacing[axis] + 1;
      if (middle[axis] - reach[axis] < 0 || middle[axis] + reach[axis] > box.size[axis] - 1)
      {
        return true;
      }
    }
    const auto range = [&](std::size_t axis, double part) {
      const double half = reach[axis] * std::sqrt(std::max(0.0, part));
      return std::pair(static_cast<std::int32_t>(std::ceil(middle[axis] - half)),
                       static_cast<std::int32_t>(std::floor(middle[axis] + half)) + 1);
    };
    const auto square = [&](std::size_t axis, std::int32_t at) {
      const double off = (at - middle[axis]) / reach[axis];
      return off * off;
    };
    const auto [zBegin, zEnd] = range(2, 1);
    for (std::int32_t z = zBegin; z < zEnd; ++z)
    {
      const double left = 1 - square(2, z);
      const auto [yBegin, yEnd] = range(1, left);
      for (std::int32_t y = yBegin; y < yEnd; ++y)
      {
        const auto [xBegin, xEnd] = range(0, left - square(1, y));
        if (xBegin < xEnd && isAnyIn(y, z, xBegin, xEnd))
        {
          return true;
        }
      }
    }
    return false;
  };
  std::vector<char> found(balls.Count(), 0);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    found[i] = touches(i) ? 1 : 0;
  }
  return found;
}

} // namespace voxelcore
