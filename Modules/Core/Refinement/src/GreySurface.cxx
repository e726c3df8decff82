// The surface that grey values tell.

#include "FieldSurface.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// Of two estimates the one that is smoothed much, as ripples of a few hundredths of a voxel hold foot points up, which
// makes wings of the core of a tube. It moves the walls of parts less than five voxels thick and rounds edges: where it
// is off by more than ripples can be, towards the other.
class GreySurface : public SurfaceEstimate
{
public:
  GreySurface(FieldSurface wide, FieldSurface narrow, const Vector3 & spacing)
    : m_Wide(std::move(wide))
    , m_Narrow(std::move(narrow))
    , m_Spacing(spacing)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    constexpr double   ripple = 0.04; // voxels
    constexpr double   wrong = 0.12;
    const SurfacePoint wide = m_Wide.Project(place, reach);
    const SurfacePoint narrow = m_Narrow.Project(wide.found ? wide.position : place, reach);
    if (!wide.found || !narrow.found)
    {
      return wide.found ? wide : narrow;
    }
    const Vector3 gap = Minus(narrow.position, wide.position);
    const double  part = std::clamp((Length(Over(gap, m_Spacing)) - ripple) / (wrong - ripple), 0.0, 1.0);
    SurfacePoint  point;
    point.position = AddScaled(wide.position, part, gap);
    point.normal = AddScaled(wide.normal, part, Minus(narrow.normal, wide.normal));
    const double length = Length(point.normal);
    point.normal = AddScaled({ 0, 0, 0 }, 1 / length, point.normal);
    point.found = length > 0 && Distance(point.position, place) <= reach;
    return point;
  }

  double
  Ripples() const override
  {
    return 0.01;
  }

private:
  FieldSurface m_Wide;
  FieldSurface m_Narrow;
  Vector3      m_Spacing;
};

} // namespace

VoxelBox
GreyBoxAround(const VoxelBox & shape, const VoxelBox & scan)
{
  constexpr std::int32_t margin = 24;
  VoxelBox               box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::max(scan.lower[axis], shape.lower[axis] - margin);
    box.size[axis] =
      std::min(scan.lower[axis] + scan.size[axis], shape.lower[axis] + shape.size[axis] + margin) - box.lower[axis];
  }
  return box;
}

std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyBoxRows &      grey,
                const ProgressCallback & progress)
{
  constexpr Vector3 sides{ 1, 1, 1 };
  constexpr double  flattest = 0.08; // of the mean magnitude
  constexpr double  close = 0.03;
  constexpr int     reach = 7;
  BandField         field(shape, BoundaryVertices(shape), sides, 1.5, reach);
  field.FillGrey(scan, grey);
  const auto smoothed = [&](BandField one, double sigma) {
    one.SetWidth(sigma);
    one.FindCoefficients(BandField::StepWeight(sigma));
    const double least = flattest * one.Far();
    return FieldSurface(std::move(one), spacing, sides, least, close);
  };
  ReportProgress(progress, "surface", 0.3);
  FieldSurface narrow = smoothed(field, 1.0);
  ReportProgress(progress, "surface", 0.6);
  return std::make_unique<GreySurface>(smoothed(std::move(field), 1.5), std::move(narrow), spacing);
}

std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyRows &         rows,
                const ProgressCallback & progress)
{
  const VoxelBox box = GreyBoxAround(shape.Box(), scan);
  const auto     visit = [&](const GreyRowTaker & take) {
    std::vector<float> values(static_cast<std::size_t>(box.size[0]));
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        rows(box.lower[0], y, z, values);
        take(y, z, values);
      }
    }
  };
  return SurfaceFromGrey(shape, spacing, scan, GreyBoxRows{ box, visit }, progress);
}

} // namespace voxelcore
