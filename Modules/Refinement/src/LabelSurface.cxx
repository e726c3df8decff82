// The surface that labels tell: distances to the boundary between them, smoothed as long as the labels allow.

#include "FieldSurface.h"
#include "FlatProfile.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Distances end before the middle of all but thin parts, and on both sides of the surface alike: the bend of a ridge in the
// middle of a part would be carried to its surface.
constexpr double kClip = 5.5;
// Terraces get longer as the root of the surface's radius, and passes to flatten them more as the fourth power of their
// length: many where balls of such a radius (in sigmas) fit in beside the surface, wide ones where greater balls do and no edge
// is near, few in the thinnest parts, which do not survive more.
constexpr int    kOnePass = 1;
constexpr int    kFewPasses = 3;
constexpr int    kSomePasses = 20;
constexpr int    kManyPasses = 60;
constexpr int    kWidePasses = 16;
constexpr double kThick = 8;
constexpr double kThickest = 12;
constexpr double kBend = 7.5;
constexpr double kNearBend = 8;
constexpr double kFlattest = 0.32;

// Bends are flattened, and distances measured, in millimetres: in voxels a round tube in thick slices is an oval one. But
// between very thick slices there is nothing to flatten by.
Vector3
SidesOf(const Vector3 & spacing)
{
  constexpr double mostRatio = 2;
  const double     least = std::min({ spacing[0], spacing[1], spacing[2] });
  Vector3          sides{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sides[axis] = std::min(spacing[axis] / least, mostRatio);
  }
  return sides;
}

bool
Any(const BandField::Parts & parts)
{
  return std::any_of(parts.begin(), parts.end(), [](std::uint8_t part) { return part != 0; });
}

class LabelPasses
{
public:
  LabelPasses(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_Progress(progress)
    , m_Sides(SidesOf(spacing))
    // Steps of thick slices need more smoothing than steps of thin ones.
    , m_Sigma(0.8 + 0.2 * std::max({ m_Sides[0], m_Sides[1], m_Sides[2] }))
    , m_Reach(static_cast<std::int32_t>(std::ceil(kThickest * m_Sigma)))
    , m_Field(shape, m_Sides, m_Sigma, m_Reach)
    , m_Profile(kClip)
  {}

  // The smoothest first.
  std::vector<BandField>
  Run() &&
  {
    m_Field.FillDistances(m_Reach);
    const BandField::Parts many = m_Field.FindThick(kThick * m_Sigma);
    BandField::Parts       wide = m_Field.FindThick(kThickest * m_Sigma);
    m_Field.Clip(kClip);
    for (int pass = 1; pass <= kSomePasses; ++pass)
    {
      if (pass == kOnePass || pass == kFewPasses)
      {
        Keep();
      }
      m_Field.Smooth(m_Profile.Smooth(m_Sigma));
      End();
    }
    if (Any(many))
    {
      const BandField former = m_Field;
      SmoothThick(many, wide);
      Keep();
      const std::vector<LatticePoint> passed = PassedBy();
      if (!passed.empty())
      {
        constexpr double near = 5;
        m_Field.TakeBackAround(passed, near, former);
        m_Fields.erase(m_Fields.begin());
        Keep();
      }
    }
    else
    {
      Keep();
    }
    return std::move(m_Fields);
  }

private:
  // As it is now, with what Evaluate() needs.
  void
  Keep()
  {
    m_Fields.insert(m_Fields.begin(), m_Field);
    m_Fields.front().SmoothToCoefficients(m_Profile.Weight(m_Sigma));
  }

  void
  End()
  {
    constexpr double all = kSomePasses + kManyPasses + 2 * kWidePasses;
    m_Field.ClearContradictions();
    ReportProgress(m_Progress, "surface", ++m_Passes / all);
  }

  void
  SmoothThick(const BandField::Parts & many, BandField::Parts & wide)
  {
    for (int pass = 0; pass < kManyPasses; ++pass)
    {
      m_Field.SmoothPart(m_Profile.Smooth(m_Sigma), false, many);
      End();
    }
    if (!Any(wide))
    {
      return;
    }
    m_Field.LeaveOutBends(wide, kBend, kNearBend);
    for (int pass = 0; pass < kWidePasses; ++pass)
    {
      m_Field.SmoothPart(m_Profile.Smooth(2 * m_Sigma), true, wide);
      End();
      m_Field.SmoothPart(m_Profile.Smooth(m_Sigma), false, wide);
      End();
    }
  }

  // Boundary vertices that are far off the smooth surface: labels allow none so smooth there.
  std::vector<LatticePoint>
  PassedBy() const
  {
    constexpr double                ofDiagonal = 0.8;
    const FieldSurface              smooth({ m_Fields.front() }, m_Spacing, m_Sides, kFlattest);
    const std::vector<LatticePoint> points = BoundaryVertices(m_Shape);
    std::vector<std::uint8_t>       passed(points.size(), 0);
    const auto                      count = static_cast<std::ptrdiff_t>(points.size());
#pragma omp parallel for schedule(dynamic, 256) if (count > 4096)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const LatticePoint & p = points[static_cast<std::size_t>(i)];
      const Vector3        place =
        Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, m_Spacing);
      passed[static_cast<std::size_t>(i)] = smooth.Project(place, ofDiagonal * Length(m_Spacing)).found ? 0 : 1;
    }
    std::vector<LatticePoint> some;
    std::copy_if(points.begin(), points.end(), std::back_inserter(some), [&](const LatticePoint & p) {
      return passed[static_cast<std::size_t>(&p - points.data())] != 0;
    });
    return some;
  }

  const VoxelShape &       m_Shape;
  const Vector3 &          m_Spacing;
  const ProgressCallback & m_Progress;
  Vector3                  m_Sides;
  double                   m_Sigma;
  std::int32_t             m_Reach;
  BandField                m_Field;
  FlatProfile              m_Profile;
  std::vector<BandField>   m_Fields;
  int                      m_Passes = 0;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  return std::make_unique<FieldSurface>(LabelPasses(shape, spacing, progress).Run(),
                                        spacing,
                                        SidesOf(spacing),
                                        kFlattest);
}

} // namespace voxelcore
