#include "voxelcore/Refinement/SurfaceDistance.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

// The surface passes within half a diagonal of a boundary vertex; smoothed, a little beyond.
constexpr double kReach = 0.75; // voxel diagonals

constexpr int    kMostSteps = 16;  // about three are taken
constexpr double kNoNearer = 1e-6; // of a voxel's diagonal: where steps end

std::vector<SurfacePoint>
FeetOf(const SurfaceEstimate & surface, std::span<const LatticePoint> boundary, const Vector3 & spacing)
{
  std::vector<SurfacePoint> feet(boundary.size());
  const double              reach = kReach * Length(spacing);
  const auto                count = static_cast<std::ptrdiff_t>(feet.size());
#pragma omp parallel for schedule(dynamic, 256) if (count > 512)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const LatticePoint & at = boundary[static_cast<std::size_t>(i)];
    SurfacePoint &       foot = feet[static_cast<std::size_t>(i)];
    const Vector3        place =
      Times({ static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z) }, spacing);
    foot = surface.Project(place, reach);
    if (!foot.found)
    {
      foot.position = place;
    }
  }
  return feet;
}

BallTree
TreeOf(const std::vector<SurfacePoint> & feet)
{
  std::vector<Vector3> places;
  places.reserve(feet.size());
  for (const SurfacePoint & foot : feet)
  {
    places.push_back(foot.position);
  }
  return { places, std::vector<double>(places.size(), 0.0), SpacingWeights() };
}

} // namespace

SurfaceDistance::SurfaceDistance(std::shared_ptr<const SurfaceEstimate> surface,
                                 std::span<const LatticePoint>          boundary,
                                 const Vector3 &                        spacing)
  : m_Surface(std::move(surface))
  , m_Spacing(spacing)
  , m_Reach(kReach * Length(spacing))
  , m_Feet(FeetOf(*m_Surface, boundary, spacing))
  , m_Tree(TreeOf(m_Feet))
{}

double
SurfaceDistance::From(const Vector3 & place) const
{
  if (m_Feet.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  const Vector3 from = Times(place, m_Spacing);
  std::size_t   number = 0;
  m_Tree.Gap(from, -HUGE_VAL, number);
  SurfacePoint foot = m_Feet[m_Tree.BallOf(number)];
  double       distance = Distance(from, foot.position);
  for (int step = 0; step < kMostSteps && foot.found; ++step)
  {
    // To where the plane that touches the surface is nearest, but no farther than the surface may be followed.
    const Vector3      gap = Minus(from, foot.position);
    const Vector3      way = AddScaled(gap, -Dot(gap, foot.normal), foot.normal);
    const double       length = Length(way);
    const Vector3      to = AddScaled(foot.position, std::min(1.0, m_Reach / std::max(length, m_Reach)), way);
    const SurfacePoint next = m_Surface->Project(to, m_Reach);
    const double       nearer = next.found ? Distance(from, next.position) : distance;
    if (!(nearer < distance - kNoNearer * m_Reach))
    {
      break;
    }
    foot = next;
    distance = nearer;
  }
  return distance;
}

double
SurfaceDistance::RadiusAt(const Vector3 & place, double radius, const Vector3 & before) const
{
  return std::max(0.0, radius + (From(place) - From(before)));
}

} // namespace voxelcore
