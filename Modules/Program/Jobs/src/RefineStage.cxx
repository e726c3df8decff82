#include "voxelcore/Jobs/RefineStage.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace voxelcore
{

namespace
{

/** The grey values around labels. When a second label asks, all are read and kept, if they are not too many. */
class GreyValues
{
public:
  GreyValues(std::filesystem::path path, ReadOptions options, const VoxelBox & whole)
    : m_Path(std::move(path))
    , m_Options(std::move(options))
    , m_Whole(whole)
  {}

  /** Gives the rows of a box, in order, and the geometry of the whole scan. */
  ImageGeometry
  Visit(const VoxelBox & box, const GreyRow & take, const ProgressCallback & progress)
  {
    constexpr double most = 512e6 / sizeof(float); // voxels
    double           voxels = 1;
    for (const std::int32_t side : m_Whole.size)
    {
      voxels *= side;
    }
    std::unique_lock lock(m_Mutex);
    if (m_Labels++ == 0 || voxels > most)
    {
      lock.unlock();
      return VisitGreyRows(m_Path, box, m_Options, take, progress);
    }
    if (!m_Values)
    {
      m_Values.emplace(ReadGreyVolume(m_Path, m_Whole, m_Options, progress));
    }
    lock.unlock();
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        take(y, z, { m_Values->Row(box.lower[0], y, z), static_cast<std::size_t>(box.size[0]) });
      }
    }
    return m_Values->geometry;
  }

private:
  std::filesystem::path     m_Path;
  ReadOptions               m_Options;
  VoxelBox                  m_Whole;
  std::mutex                m_Mutex;
  std::size_t               m_Labels = 0; ///< asked for so far
  std::optional<GreyVolume> m_Values;
};

/** A box of the scan as it lies around the voxel `place`. */
VoxelBox
LookedAtFrom(const SurfaceSource::Place & place, VoxelBox box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= place[axis];
  }
  return box;
}

/** Of a shape that goes on beyond the scan: the values at the border go on with it, and where a body ends at the border
 *  their sign is turned. `rows` gives those within. */
std::unique_ptr<SurfaceEstimate>
SurfaceBeyondScan(const VoxelShape &       shape,
                  const Vector3 &          spacing,
                  const VoxelBox &         scan,
                  const GreyRows &         rows,
                  const ProgressCallback & progress)
{
  const auto nearest = [&scan](std::int32_t at, std::size_t axis) {
    return std::clamp(at, scan.lower[axis], scan.lower[axis] + scan.size[axis] - 1);
  };
  const auto goOn = [&](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values) {
    const std::int32_t first = nearest(x, 0);
    const std::int32_t last = nearest(x + static_cast<std::int32_t>(values.size()) - 1, 0);
    std::vector<float> within(static_cast<std::size_t>(last - first + 1));
    rows(first, nearest(y, 1), nearest(z, 2), within);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const std::int32_t at = x + static_cast<std::int32_t>(i);
      const bool         isBeyond = at != nearest(at, 0) || y != nearest(y, 1) || z != nearest(z, 2);
      values[i] = within[static_cast<std::size_t>(nearest(at, 0) - first)];
      if (isBeyond && values[i] > 0 && !shape.Contains(at, y, z))
      {
        values[i] = -values[i];
      }
    }
  };
  return SurfaceFromGrey(shape, spacing, BoxOfBoth(scan, shape.Box()), GreyRows(goOn), progress);
}

/** Rows of a box kept in memory. */
GreyRows
KeptRows(const GreyBoxRows & grey)
{
  const VoxelBox & box = grey.box;
  const auto       size = std::array{ static_cast<std::size_t>(box.size[0]), static_cast<std::size_t>(box.size[1]) };
  auto       values = std::make_shared<std::vector<float>>(size[0] * size[1] * static_cast<std::size_t>(box.size[2]));
  const auto placeOf = [box, size](std::int32_t x, std::int32_t y, std::int32_t z) {
    return (static_cast<std::size_t>(z - box.lower[2]) * size[1] + static_cast<std::size_t>(y - box.lower[1])) *
             size[0] +
           static_cast<std::size_t>(x - box.lower[0]);
  };
  grey.visit([&](std::int32_t y, std::int32_t z, std::span<const float> row) {
    ranges::copy(row, values->begin() + static_cast<std::ptrdiff_t>(placeOf(box.lower[0], y, z)));
  });
  return [values, placeOf](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> row) {
    std::copy_n(values->begin() + static_cast<std::ptrdiff_t>(placeOf(x, y, z)), row.size(), row.begin());
  };
}

SurfaceSource
GreySource(const RefineOptions &         options,
           const std::filesystem::path & scan,
           const ReadOptions &           reading,
           const InputScan &             input)
{
  const bool other = !options.grey.empty();
  if (other ? !options.greyRange : !reading.threshold)
  {
    throw UsageError(
      "--refine grey needs grey values: a scan with --threshold LO:HI, or --grey FILE --grey-range LO:HI");
  }
  const auto range = other ? *options.greyRange : *reading.threshold;
  if (std::isinf(range.first) && std::isinf(range.second))
  {
    throw UsageError("--refine grey: the range of grey values has no end; give one, such as 300:inf");
  }
  const VoxelBox whole = PartRead(input);
  // Positive within the shape.
  const auto within = [range](float value) {
    return static_cast<float>(std::min(value - range.first, range.second - value));
  };
  if (!other && input.greyRows)
  {
    const auto rows = [take = input.greyRows,
                       within](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values) {
      take(x, y, z, values);
      ranges::transform(values, values.begin(), within);
    };
    return [=, spacing = input.geometry.spacing](const VoxelShape &           shape,
                                                 const SurfaceSource::Place & place,
                                                 const ProgressCallback &     progress) {
      const auto rowsThere = [&](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values) {
        rows(x + place[0], y + place[1], z + place[2], values);
      };
      const VoxelBox scanned = LookedAtFrom(place, whole);
      return SurfaceSource::Estimate(BoxOfBoth(scanned, shape.Box()).size != scanned.size
                                       ? SurfaceBeyondScan(shape, spacing, scanned, rowsThere, progress)
                                       : SurfaceFromGrey(shape, spacing, scanned, GreyRows(rowsThere), progress));
    };
  }
  ReadOptions how = reading;
  if (other)
  {
    how.volume.reset();
    how.component.reset();
    how.level.reset();
    how.raw.reset();
  }
  const ImageGeometry geometry = input.geometry;
  const auto          path = other ? options.grey : scan;
  const auto          greyValues = std::make_shared<GreyValues>(path, how, whole);
  return [=](const VoxelShape &           shape,
             const SurfaceSource::Place & place,
             const ProgressCallback &     progress) -> SurfaceSource::Estimate {
    const VoxelBox scanned = LookedAtFrom(place, whole);
    const VoxelBox box = GreyBoxAround(shape.Box(), scanned);
    const auto     visit = [&](const GreyRowTaker & take) {
      std::vector<float> inside(static_cast<std::size_t>(box.size[0]));
      const auto         takeRow = [&](std::int32_t y, std::int32_t z, std::span<const float> values) {
        ranges::transform(values, inside.begin(), within);
        take(y - place[1], z - place[2], inside);
      };
      const VoxelBox inScan = LookedAtFrom({ -place[0], -place[1], -place[2] }, box);
      RequireSamePlace(greyValues->Visit(inScan, takeRow, progress), geometry, "--grey", path);
    };
    if (BoxOfBoth(scanned, shape.Box()).size != scanned.size)
    {
      return SurfaceBeyondScan(shape, geometry.spacing, scanned, KeptRows({ box, visit }), progress);
    }
    return SurfaceFromGrey(shape, geometry.spacing, scanned, GreyBoxRows{ box, visit }, progress);
  };
}

} // namespace

SurfaceSource
MakeSurfaceSource(const RefineOptions &         options,
                  const std::filesystem::path & scan,
                  const ReadOptions &           reading,
                  const InputScan &             input)
{
  if (options.surface.empty())
  {
    return {};
  }
  if (options.surface == "labels")
  {
    return SurfacesFromLabels(input.geometry.spacing);
  }
  if (options.surface == "grey")
  {
    return GreySource(options, scan, reading, input);
  }
  if (!input.mesh)
  {
    throw UsageError("--refine mesh: " + scan.string() + " is no mesh; give --refine labels or --refine grey");
  }
  const auto mesh = std::make_shared<TriangleMesh>(*input.mesh);
  for (Vector3 & point : mesh->points)
  {
    point = OnPlaces(PhysicalToLattice(input.geometry, point));
  }
  return [mesh, spacing = input.geometry.spacing](const VoxelShape &,
                                                  const SurfaceSource::Place & place,
                                                  const ProgressCallback &) {
    std::vector<Vector3> points = mesh->points;
    for (Vector3 & point : points)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        point[axis] = (point[axis] - place[axis]) * spacing[axis];
      }
    }
    return SurfaceSource::Estimate(SurfaceFromTriangles(points, mesh->triangles));
  };
}

} // namespace voxelcore
