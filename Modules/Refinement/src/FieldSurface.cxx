#include "BandField.h"
#include "FlatProfile.h"
#include "Vectors.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/SurfaceEstimate.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace voxelcore
{

namespace
{

// Where a field is 0; where it has no good answer the next one is asked.
class FieldSurface : public SurfaceEstimate
{
public:
  // A slope (per unit of `sides`) less than `flattest` tells nothing: where labels allow no surface, the field is flat.
  FieldSurface(std::vector<BandField> fields, const Vector3 & spacing, const Vector3 & sides, double flattest)
    : m_Fields(std::move(fields))
    , m_Spacing(spacing)
    , m_Sides(sides)
    , m_Flattest(flattest)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    for (const BandField & field : m_Fields)
    {
      const SurfacePoint point = Project(field, place, reach);
      if (point.found)
      {
        return point;
      }
    }
    return {};
  }

private:
  SurfacePoint
  Project(const BandField & field, const Vector3 & place, double reach) const
  {
    constexpr int    steps = 6;
    constexpr double longest = 1.0; // voxels a step
    constexpr double close = 1e-4;  // voxels
    Vector3          at = Over(place, m_Spacing);
    SurfacePoint     point;
    for (int step = 0; step <= steps; ++step)
    {
      double  value = 0;
      Vector3 slope{};
      if (!field.Evaluate(at, value, slope) || Length(Over(slope, m_Sides)) < m_Flattest)
      {
        return point;
      }
      const Vector3 normal = Over(slope, m_Spacing); // per mm
      const double  squared = Dot(normal, normal);
      Vector3       move = Over(Along({ 0, 0, 0 }, -value / squared, normal), m_Spacing);
      const double  length = Length(move);
      if (length < close || step == steps)
      {
        point.position = Times(at, m_Spacing);
        point.normal = Along({ 0, 0, 0 }, -1 / std::sqrt(squared), normal);
        point.found = length < 10 * close && Distance(point.position, place) <= reach;
        return point;
      }
      at = Along(at, std::min(1.0, longest / length), move);
    }
    return point;
  }

  std::vector<BandField> m_Fields;
  Vector3                m_Spacing;
  Vector3                m_Sides;
  double                 m_Flattest;
};

// Of two estimates the one that is smoothed much, as ripples of a few hundredths of a voxel hold feet up, which makes wings of
// the core of a tube. It moves the walls of parts less than five voxels thick and rounds edges: where it is off by more than
// ripples can be, towards the other.
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
    point.position = Along(wide.position, part, gap);
    point.normal = Along(wide.normal, part, Minus(narrow.normal, wide.normal));
    const double length = Length(point.normal);
    point.normal = Along({ 0, 0, 0 }, 1 / length, point.normal);
    point.found = length > 0 && Distance(point.position, place) <= reach;
    return point;
  }

private:
  FieldSurface m_Wide;
  FieldSurface m_Narrow;
  Vector3      m_Spacing;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  // Bends are flattened, and distances measured, in millimetres: in voxels a round tube in thick slices is an oval one. But
  // between very thick slices there is nothing to flatten by.
  constexpr double mostRatio = 2;
  const double     least = std::min({ spacing[0], spacing[1], spacing[2] });
  Vector3          sides{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sides[axis] = std::min(spacing[axis] / least, mostRatio);
  }
  // Steps of thick slices need more smoothing than steps of thin ones.
  const double sigma = 0.8 + 0.2 * std::max({ sides[0], sides[1], sides[2] });
  // Distances end before the middle of all but thin parts, and on both sides of the surface alike: the bend of a ridge in the
  // middle of a part would be carried to its surface.
  constexpr double clip = 5.5;
  // Terraces get longer as the root of the surface's radius, and passes to flatten them more as the fourth power of their
  // length: many where balls of such a radius fit in beside the surface, wide ones where greater balls do and no edge is
  // near, few in the thinnest parts, which do not survive more.
  constexpr int    onePass = 1;
  constexpr int    fewPasses = 3;
  constexpr int    somePasses = 20;
  constexpr int    manyPasses = 60;
  constexpr int    widePasses = 16;
  constexpr double mostOfDiagonal = 0.8;
  constexpr double nearPassed = 5;
  const double     thick = 8 * sigma;
  const double     thickest = 12 * sigma;
  constexpr double allPasses = somePasses + manyPasses + 2 * widePasses;
  constexpr double flattest = 0.32;
  const auto       reach = static_cast<std::int32_t>(std::ceil(thickest));

  BandField field(shape, sides, sigma, reach);
  field.FillDistances(reach);
  const BandField::Parts many = field.FindThick(thick);
  BandField::Parts       wide = field.FindThick(thickest);
  field.Clip(clip);
  FlatProfile            profile(clip);
  std::vector<BandField> fields;
  int                    passes = 0;
  const auto             keep = [&] {
    fields.insert(fields.begin(), field);
    fields.front().SmoothToCoefficients(profile.Weight(sigma));
  };
  const auto end = [&] {
    field.ClearContradictions();
    ReportProgress(progress, "surface", ++passes / allPasses);
  };
  while (passes < somePasses)
  {
    if (passes + 1 == onePass || passes + 1 == fewPasses)
    {
      keep();
    }
    field.Smooth(profile.Smooth(sigma));
    end();
  }
  const auto any = [](const BandField::Parts & parts) {
    return std::any_of(parts.begin(), parts.end(), [](std::uint8_t part) { return part != 0; });
  };
  std::optional<BandField> former;
  if (any(many))
  {
    former = field;
    for (int pass = 0; pass < manyPasses; ++pass)
    {
      field.SmoothPart(profile.Smooth(sigma), false, many);
      end();
    }
  }
  if (any(wide))
  {
    field.LeaveOutBends(wide, 7.5, 8);
  }
  for (int pass = any(wide) ? widePasses : 0; pass > 0; --pass)
  {
    field.SmoothPart(profile.Smooth(2 * sigma), true, wide);
    end();
    field.SmoothPart(profile.Smooth(sigma), false, wide);
    end();
  }
  keep();
  if (former)
  {
    // Where labels allow no surface so smooth, the smooth one passes them by.
    std::vector<LatticePoint> passed;
    const FieldSurface        smooth({ fields.front() }, spacing, sides, flattest);
    for (const LatticePoint & p : BoundaryVertices(shape))
    {
      const Vector3 place =
        Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, spacing);
      if (!smooth.Project(place, mostOfDiagonal * Length(spacing)).found)
      {
        passed.push_back(p);
      }
    }
    field.TakeBackAround(passed, nearPassed, *former);
    fields.erase(fields.begin());
    keep();
  }
  return std::make_unique<FieldSurface>(std::move(fields), spacing, sides, flattest);
}

std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyRows &         rows,
                const ProgressCallback & progress)
{
  constexpr Vector3 sides{ 1, 1, 1 };
  constexpr double  flattest = 0.08; // of the mean magnitude
  BandField         field(shape, sides, 1.5, 7);
  field.FillGrey(scan, rows);
  const auto smoothed = [&](BandField one, double sigma) {
    one.SetWidth(sigma);
    one.SmoothToCoefficients(BandField::StepWeight(sigma));
    const double           least = flattest * one.Far();
    std::vector<BandField> fields;
    fields.push_back(std::move(one));
    return FieldSurface(std::move(fields), spacing, sides, least);
  };
  ReportProgress(progress, "surface", 0.3);
  FieldSurface narrow = smoothed(field, 1.0);
  ReportProgress(progress, "surface", 0.6);
  return std::make_unique<GreySurface>(smoothed(std::move(field), 1.5), std::move(narrow), spacing);
}

} // namespace voxelcore
