// The surface that labels tell: distances to the boundary between them, smoothed as long as the labels allow.

#include "FieldSurface.h"
#include "FlatProfile.h"
#include "SharpEdges.h"
#include "SmoothingZones.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

namespace voxelcore
{

namespace
{

// Distances end before the middle of all but thin parts, and on both sides of the surface alike: the bend of a ridge in
// the middle of a part would be carried to its surface.
constexpr double kClip = 5.5;
// Terraces get longer as the root of the surface's radius, and what flattens them grows as the fourth power of their
// length. So there are wider passes (sigma times the root of 2, worth four others) where balls of such a radius
// (in sigmas) fit in beside the surface, the widest (2 sigma, worth sixteen) where greater balls do and no edge is
// near, and few passes in the thinnest parts, which do not survive more.
constexpr int    kOnePass = 1;
constexpr int    kFewPasses = 3;
constexpr int    kSomePasses = 18;
constexpr int    kWiderPasses = 14;
constexpr int    kWidestPasses = 24;
constexpr double kThick = 8;
constexpr double kThickest = 12;
constexpr double kBend = 7.5;
constexpr double kNearBend = 8;
constexpr double kFlattest = 0.32;
constexpr double kClose = 0.1; // ripples are longer
// How far passes look, in sigmas: what ends nearer stands in the widest ones' way.
constexpr double kReach = 7;

// Bends are flattened, and distances measured, in millimetres: in voxels a round tube in thick slices is an oval one.
// But between very thick slices there is nothing to flatten by.
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

// What passes weigh: the spacing alone decides that, and of each label only which of them are taken. What few labels
// need is found when the first one asks.
class PassWeights
{
public:
  explicit PassWeights(const Vector3 & spacing)
    : m_Sides(SidesOf(spacing))
    // Steps of thick slices need more smoothing than steps of thin ones.
    , m_Sigma(0.8 + 0.2 * std::max({ m_Sides[0], m_Sides[1], m_Sides[2] }))
    , m_Profile(kClip)
    , m_Some(Take(m_Profile, m_Sigma, kSomePasses))
    , m_Coefficients(m_Profile.Weight(m_Sigma))
    , m_Swelling(SwellingAfter(m_Some))
  {}

  const Vector3 &
  Sides() const
  {
    return m_Sides;
  }
  double
  Sigma() const
  {
    return m_Sigma;
  }
  double
  Wider() const
  {
    return std::sqrt(2.0) * m_Sigma;
  }
  double
  Widest() const
  {
    return 2 * m_Sigma;
  }

  const std::vector<float> &
  Some() const
  {
    return m_Some;
  }

  /** Of the coefficients where some passes are all. */
  float
  Coefficients() const
  {
    return m_Coefficients;
  }

  const WallSwelling &
  Swelling() const
  {
    return m_Swelling;
  }

  /** Wider passes, or the widest ones after them. */
  struct Further
  {
    std::vector<float> passes;
    float              last = 0;         ///< of a pass of the first width after them
    float              coefficients = 0; ///< after that one
  };

  const Further &
  AfterSome() const
  {
    std::call_once(m_HasWider, [&] { m_Wider = Find(m_Profile, Wider(), kWiderPasses, m_WiderProfile); });
    return m_Wider;
  }

  const Further &
  AfterWider() const
  {
    AfterSome();
    std::call_once(m_HasWidest, [&] {
      std::optional<FlatProfile> profile;
      m_Widest = Find(*m_WiderProfile, Widest(), kWidestPasses, profile);
    });
    return m_Widest;
  }

private:
  static std::vector<float>
  Take(FlatProfile & profile, double sigma, int passes)
  {
    std::vector<float> weights;
    weights.reserve(static_cast<std::size_t>(passes));
    for (int pass = 0; pass < passes; ++pass)
    {
      weights.push_back(profile.Smooth(sigma));
    }
    return weights;
  }

  Further
  Find(FlatProfile profile, double sigma, int passes, std::optional<FlatProfile> & after) const
  {
    Further further;
    further.passes = Take(profile, sigma, passes);
    after = profile;
    further.last = profile.Smooth(m_Sigma);
    further.coefficients = profile.Weight(m_Sigma);
    return further;
  }

  // Where walls are thin, there are no wider passes; the last is that of the coefficients.
  WallSwelling
  SwellingAfter(std::vector<float> weights) const
  {
    weights.push_back(weights.back());
    return { kClip, m_Sigma, weights };
  }

  Vector3            m_Sides;
  double             m_Sigma;
  FlatProfile        m_Profile; ///< after some passes
  std::vector<float> m_Some;
  float              m_Coefficients;
  WallSwelling       m_Swelling;

  mutable std::once_flag             m_HasWider;
  mutable std::once_flag             m_HasWidest;
  mutable Further                    m_Wider;
  mutable Further                    m_Widest;
  mutable std::optional<FlatProfile> m_WiderProfile;
};

class LabelPasses
{
public:
  LabelPasses(const VoxelShape &       shape,
              const Vector3 &          spacing,
              const PassWeights &      weights,
              const ProgressCallback & progress)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_Weights(weights)
    , m_Progress(progress)
    , m_Sides(weights.Sides())
    , m_Sigma(weights.Sigma())
    , m_Points(BoundaryVertices(shape))
    , m_Field(shape, m_Points, m_Sides, m_Sigma, static_cast<std::int32_t>(std::ceil(kReach * m_Sigma)))
    , m_Filled(m_Field.Grid().Count(), 0)
    , m_Depth(shape,
              m_Points,
              m_Sides,
              { kThick * m_Sigma, kThickest * m_Sigma },
              [&](const auto & tile, const auto & toIn, const auto & toOut) {
                m_Field.TakeDistances(tile, toIn, toOut, kClip, m_Filled);
              })
  {
    m_Field.FillDistances(shape, kClip, m_Filled);
  }

  FieldSurface
  Run() &&
  {
    const std::vector<float> & weights = m_Weights.Some();
    for (const float one : weights)
    {
      SmoothWith(m_Field, one, nullptr);
    }
    float                              weight = m_Weights.Coefficients();
    std::optional<BandField::Snapshot> former;
    if (const SmoothingZones thick(m_Depth, kThick * m_Sigma, 0); thick.Any())
    {
      const auto edges = FindZonesAtEdges(m_Field, m_Depth, kThick * m_Sigma, thick);
      former = m_Field.Save(edges ? edges->all : thick);
      weight = SmoothThick(thick, edges);
    }
    m_Depth.DropDepths();
    FieldSurface surface(std::move(m_Field), m_Spacing, m_Sides, kFlattest, kClose);
    surface.SetSwelling(m_Weights.Swelling());
    // Where labels allow no surface so smooth, a less smooth one.
    std::vector<std::uint8_t> changed;
    const auto                replace = [&](auto blend) {
      SmoothingZones zones(m_Depth);
      const bool     any = MarkPassedBy(surface, weight, changed, zones);
      if (any)
      {
        constexpr double near = 5;
        zones.LeaveOutAroundMarks(near);
        surface.Change([&](BandField & field) { changed = blend(field, zones); });
      }
      return any;
    };
    const auto afterPasses = [&](int passes) { // the last of them by the coefficients
      return replace([&](BandField & field, const SmoothingZones & zones) {
        BandField less(m_Shape, field, field.LeftOut(zones, passes - 1));
        less.SetWidth(m_Sigma);
        less.FillDistances(m_Shape, kClip);
        for (int pass = 0; pass < passes - 1; ++pass)
        {
          less.Smooth(weights[static_cast<std::size_t>(pass)], nullptr);
        }
        return field.BlendWith(less, zones, weight);
      });
    };
    const bool rough = !former || replace([&](BandField & field, const SmoothingZones & zones) {
      return field.BlendWith(*former, zones, weight);
    });
    former.reset();
    if (rough && afterPasses(kFewPasses))
    {
      afterPasses(kOnePass);
    }
    surface.Change([&](BandField & field) { field.FindCoefficients(weight); });
    return surface;
  }

private:
  void
  SmoothWith(BandField & field, float weight, const SmoothingZones * zones)
  {
    constexpr double all = kSomePasses + kWiderPasses + kWidestPasses + 1;
    field.Smooth(weight, zones);
    ReportProgress(m_Progress, "surface", ++m_Passes / all);
  }

  // What is near a bend is left out of the widest passes. Those need no more than the means of 2^3 voxels: nothing is
  // left that is shorter. Returns the weight of the coefficients.
  float
  SmoothThick(const SmoothingZones & thick, const std::optional<ZonesAtEdges> & edges)
  {
    const PassWeights::Further * further = &m_Weights.AfterSome();
    m_Field.SetWidth(m_Weights.Wider());
    if (edges)
    {
      m_Field.Smooth(kDrawsIn, &edges->beside);
    }
    for (const float weight : further->passes)
    {
      SmoothWith(m_Field, weight, edges ? &edges->flat : &thick);
    }
    SmoothingZones thickest(m_Depth, kThickest * m_Sigma, 1);
    if (thickest.Any())
    {
      constexpr double onSurface = 1;
      m_Field.MarkBends(onSurface, kBend, thickest);
      thickest.LeaveOutAroundMarks(kNearBend);
      BandField halved = m_Field.Halved(m_Shape, m_Depth, thickest);
      further = &m_Weights.AfterWider();
      halved.SetWidth(m_Weights.Widest());
      for (const float weight : further->passes)
      {
        SmoothWith(halved, weight, &thickest);
      }
      m_Field.AddChange(m_Shape, std::move(halved));
    }
    m_Field.SetWidth(m_Sigma);
    SmoothWith(m_Field, further->last, &thick);
    return further->coefficients;
  }

  // Boundary vertices that are far off the surface, of those in bricks that have changed, if any are named.
  bool
  MarkPassedBy(FieldSurface &                    surface,
               float                             weight,
               const std::vector<std::uint8_t> & changed,
               SmoothingZones &                  zones) const
  {
    constexpr double          ofDiagonal = 0.8;
    const BandField &         field = surface.Field();
    std::vector<std::uint8_t> passed(m_Points.size(), 0);
    const auto                count = static_cast<std::ptrdiff_t>(m_Points.size());
    for (const BandField::Slab & slab : field.Slabs())
    {
      surface.Change([&](BandField & one) { one.FindCoefficients(weight, slab, changed); });
#pragma omp parallel for schedule(dynamic, 256) if (count > 4096)
      for (std::ptrdiff_t i = 0; i < count; ++i)
      {
        const LatticePoint & p = m_Points[static_cast<std::size_t>(i)];
        if (!field.IsIn(slab, p.z) ||
            (!changed.empty() &&
             changed[static_cast<std::size_t>(field.Grid().Find({ p.x >> 3, p.y >> 3, p.z >> 3 }))] == 0))
        {
          continue;
        }
        const Vector3 place =
          Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, m_Spacing);
        passed[static_cast<std::size_t>(i)] = surface.Project(place, ofDiagonal * Length(m_Spacing)).found ? 0 : 1;
      }
    }
    bool any = false;
    for (std::size_t i = 0; i < passed.size(); ++i)
    {
      if (passed[i] != 0)
      {
        any = true;
        zones.Mark(m_Points[i].x, m_Points[i].y, m_Points[i].z);
      }
    }
    return any;
  }

  const VoxelShape &        m_Shape;
  const Vector3 &           m_Spacing;
  const PassWeights &       m_Weights;
  const ProgressCallback &  m_Progress;
  Vector3                   m_Sides;
  double                    m_Sigma;
  std::vector<LatticePoint> m_Points;
  BandField                 m_Field;
  std::vector<std::uint8_t> m_Filled; ///< bricks whose distances the depths knew
  BoundaryDepth             m_Depth;
  int                       m_Passes = 0;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  return SurfacesFromLabels(spacing)(shape, progress);
}

std::function<std::unique_ptr<SurfaceEstimate>(const VoxelShape & shape, const ProgressCallback & progress)>
SurfacesFromLabels(const Vector3 & spacing)
{
  const auto weights = std::make_shared<const PassWeights>(spacing);
  return [spacing, weights](const VoxelShape & shape, const ProgressCallback & progress) {
    return std::make_unique<FieldSurface>(LabelPasses(shape, spacing, *weights, progress).Run());
  };
}

} // namespace voxelcore
