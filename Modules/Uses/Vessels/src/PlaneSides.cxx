#include "PlaneSides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxelcore
{

namespace
{

// Across a branch the kernel is K = (1 + w) G - w G G, with a Gaussian G of this width in voxels. Sides of ellipses
// with half axes of 3 to 18 voxels are then off by 0.06 of a voxel (rms); 0.75 leaves more of the voxels' steps, 1.15
// draws in the tips of flat ones.
constexpr double kSigma = 0.9;

// G moves a step of curvature c by c sigma^2 / 2 times its slope there, which goes as 1 / sigma: so
// (1 + w) = w sqrt(2).
constexpr double kWeight = 1 + std::numbers::sqrt2;

// Voxels before and behind that count. With 5, a stenosis as short as 2.5 voxels (sigma) loses a tenth of its depth;
// with 3, areas are off by a fifth more.
constexpr double kAlong = 4;

// Beyond so many voxels across a branch, voxels hardly count.
constexpr double kAcross = 4;

/** By u of -1 to 1; of its powers from 1 to u^3 the first alone has an integral (Epanechnikov's kernel of the fourth
 *  order). */
double
AlongBranch(double u)
{
  return (1 - u * u) * (3 - 7 * u * u);
}

std::int32_t
Floor(double value)
{
  return static_cast<std::int32_t>(std::floor(value));
}

Vector3
Normalized(const Vector3 & a)
{
  return AddScaled({}, 1 / Length(a), a);
}

std::array<Vector3, 2>
AcrossOf(const Vector3 & axis)
{
  std::size_t least = 0;
  for (const std::size_t k : { 1U, 2U })
  {
    least = std::abs(axis[k]) < std::abs(axis[least]) ? k : least;
  }
  Vector3 other{};
  other[least] = 1;
  const Vector3 first = Normalized(Cross(other, axis));
  return { first, Cross(axis, first) };
}

} // namespace

SectionPlane::SectionPlane(const Vector3 & from, const Vector3 & along, double side)
  : origin(from)
  , axis(along)
  , across(AcrossOf(along))
  , step(side)
{}

Vector3
SectionPlane::At(const Vector2 & way) const
{
  return AddScaled(AddScaled(origin, way[0], across[0]), way[1], across[1]);
}

SidesOfSurface::SidesOfSurface(const VoxelShape &      shape,
                               const SurfaceEstimate & surface,
                               const Vector3 &         spacing,
                               const SectionPlane &    plane)
  : m_Shape(&shape)
  , m_Surface(&surface)
  , m_Spacing(spacing)
  , m_Plane(plane)
  , m_Reach(Length(spacing))
{}

Vector3
SidesOfSurface::Place(const Vector2 & inPlane) const
{
  return m_Plane.At({ m_Plane.step * inPlane[0], m_Plane.step * inPlane[1] });
}

Vector3
SidesOfSurface::Corner(const PlaneNode & node) const
{
  return Place({ static_cast<double>(node[0]), static_cast<double>(node[1]) });
}

double
SidesOfSurface::At(const PlaneNode & node)
{
  const Vector3                     place = Corner(node);
  const Vector3                     lattice = Over(place, m_Spacing);
  const std::array<std::int32_t, 3> corner{ Floor(lattice[0] + 0.5), Floor(lattice[1] + 0.5), Floor(lattice[2] + 0.5) };
  const unsigned                    around = m_Shape->Around(corner[0], corner[1], corner[2]);
  if (around == 0 || around == 0xFF)
  {
    return around != 0 ? m_Reach : -m_Reach;
  }
  // Normals may point either way: out is where those of the eight voxels are that are out.
  const SurfacePoint foot = m_Surface->Project(place, m_Reach);
  double             outwards = 0;
  for (unsigned c = 0; foot.found && c < 8; ++c)
  {
    const Vector3 centre =
      Times({ corner[0] - 0.5 + (c & 1U), corner[1] - 0.5 + (c >> 1U & 1U), corner[2] - 0.5 + (c >> 2U) }, m_Spacing);
    const double height = Dot(Minus(centre, foot.position), foot.normal);
    outwards += (around >> c & 1U) != 0 ? -height : height;
  }
  if (outwards == 0)
  {
    return m_Shape->Contains(Floor(lattice[0]), Floor(lattice[1]), Floor(lattice[2])) ? m_Reach : -m_Reach;
  }
  const double height = Dot(Minus(place, foot.position), foot.normal);
  return outwards > 0 ? -height : height;
}

double
SidesOfSurface::Crossing(const PlaneNode & in, const PlaneNode & out)
{
  const Vector3    from = Corner(in);
  const Vector3    way = Minus(Corner(out), from);
  double           at = 0.5;
  constexpr int    kSteps = 3;       // along planes that touch a surface that bends little within a square
  constexpr double kFlattest = 0.05; // a way that hardly leads to the surface meets it anywhere
  for (int step = 0; step < kSteps; ++step)
  {
    const Vector3      place = AddScaled(from, at, way);
    const SurfacePoint foot = m_Surface->Project(place, m_Reach);
    const double       slope = Dot(way, foot.normal);
    if (!foot.found || !(std::abs(slope) > kFlattest * Length(way)))
    {
      break;
    }
    at = std::clamp(at + Dot(Minus(foot.position, place), foot.normal) / slope, 0.0, 1.0);
  }
  return at;
}

SidesOfVoxels::SidesOfVoxels(const VoxelShape &   shape,
                             const Vector3 &      spacing,
                             const SectionPlane & plane,
                             double               reach)
  : m_Shape(&shape)
  , m_Spacing(spacing)
  , m_Plane(plane)
  , m_Origin(Over(plane.origin, spacing))
  , m_Axis(Normalized(Over(plane.axis, spacing)))
  , m_Across(AcrossOf(m_Axis))
  , m_Step(plane.step / std::cbrt(spacing[0] * spacing[1] * spacing[2]))
  , m_Edge(static_cast<std::int32_t>(std::ceil(kAcross / m_Step)))
  , m_Half(static_cast<std::int32_t>(reach / std::min({ spacing[0], spacing[1], spacing[2] }) / m_Step) + 2 + m_Edge)
{
  Fill();
}

Vector3
SidesOfVoxels::Place(const Vector2 & inPlane) const
{
  Vector3 place = AddScaled(AddScaled(m_Origin, m_Step * inPlane[0], m_Across[0]), m_Step * inPlane[1], m_Across[1]);
  // Along the branch into the plane.
  place = Times(place, m_Spacing);
  const Vector3 along = Times(m_Axis, m_Spacing);
  return AddScaled(place, Dot(Minus(m_Plane.origin, place), m_Plane.axis) / Dot(along, m_Plane.axis), along);
}

std::size_t
SidesOfVoxels::Index(const PlaneNode & node) const
{
  const auto side = static_cast<std::size_t>(2 * m_Half + 1);
  return static_cast<std::size_t>(node[1] + m_Half) * side + static_cast<std::size_t>(node[0] + m_Half);
}

double
SidesOfVoxels::At(const PlaneNode & node)
{
  while (std::max(std::abs(node[0]), std::abs(node[1])) > m_Half - m_Edge)
  {
    m_Half *= 2;
    Fill();
  }
  return m_Sides[Index(node)];
}

double
SidesOfVoxels::Crossing(const PlaneNode & in, const PlaneNode & out)
{
  const double inside = At(in);
  return inside / (inside - At(out));
}

void
SidesOfVoxels::Fill()
{
  const auto          side = static_cast<std::size_t>(2 * m_Half + 1);
  std::vector<double> weights(side * side, 0.0);
  m_Sides.assign(side * side, 0.0);
  DealOut(m_Sides, weights);
  Smooth(m_Sides);
  Smooth(weights);
  for (std::size_t i = 0; i < m_Sides.size(); ++i)
  {
    m_Sides[i] = weights[i] > 0 ? m_Sides[i] / weights[i] : -1;
  }
}

void
SidesOfVoxels::DealOut(std::vector<double> & sums, std::vector<double> & weights) const
{
  // The voxels within reach along the branch, in rows along the axis of the grid that it follows most.
  std::size_t k = 0;
  for (const std::size_t other : { 1U, 2U })
  {
    k = std::abs(m_Axis[other]) > std::abs(m_Axis[k]) ? other : k;
  }
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  const double      edge = m_Half * m_Step;
  const auto        side = static_cast<std::size_t>(2 * m_Half + 1);
  Vector3           half{};
  for (const std::size_t axis : { i, j })
  {
    half[axis] = edge * (std::abs(m_Across[0][axis]) + std::abs(m_Across[1][axis])) + kAlong * std::abs(m_Axis[axis]);
  }
  std::array<std::int32_t, 3> at{};
  for (at[i] = Floor(m_Origin[i] - half[i]); at[i] <= m_Origin[i] + half[i]; ++at[i])
  {
    for (at[j] = Floor(m_Origin[j] - half[j]); at[j] <= m_Origin[j] + half[j]; ++at[j])
    {
      Vector3 way{};
      way[i] = at[i] + 0.5 - m_Origin[i];
      way[j] = at[j] + 0.5 - m_Origin[j];
      const double before = way[i] * m_Axis[i] + way[j] * m_Axis[j];
      const double middle = m_Origin[k] - before / m_Axis[k];
      const double reach = kAlong / std::abs(m_Axis[k]);
      for (at[k] = Floor(middle - reach + 0.5); at[k] + 0.5 < middle + reach; ++at[k])
      {
        way[k] = at[k] + 0.5 - m_Origin[k];
        const double  along = AlongBranch((before + way[k] * m_Axis[k]) / kAlong);
        const Vector2 inPlane{ Dot(way, m_Across[0]) / m_Step + m_Half, Dot(way, m_Across[1]) / m_Step + m_Half };
        const Vector2 lower{ std::floor(inPlane[0]), std::floor(inPlane[1]) };
        if (lower[0] < 0 || lower[1] < 0 || lower[0] >= 2 * m_Half || lower[1] >= 2 * m_Half)
        {
          continue;
        }
        const double      sign = m_Shape->Contains(at[0], at[1], at[2]) ? along : -along;
        const Vector2     part{ inPlane[0] - lower[0], inPlane[1] - lower[1] };
        const std::size_t first = static_cast<std::size_t>(lower[1]) * side + static_cast<std::size_t>(lower[0]);
        for (std::size_t corner = 0; corner < 4; ++corner)
        {
          const double share =
            ((corner & 1U) != 0 ? part[0] : 1 - part[0]) * ((corner & 2U) != 0 ? part[1] : 1 - part[1]);
          const std::size_t node = first + (corner & 1U) + ((corner & 2U) != 0 ? side : 0);
          sums[node] += share * sign;
          weights[node] += share * along;
        }
      }
    }
  }
}

void
SidesOfVoxels::Smooth(std::vector<double> & values) const
{
  const auto side = 2 * m_Half + 1;
  const auto blurred = [&](const std::vector<double> & given, double variance) {
    // What is dealt out to corners is blurred by that already.
    const double        left = variance / (m_Step * m_Step) - 1.0 / 6;
    const auto          reach = static_cast<std::int32_t>(std::ceil(4 * std::sqrt(left)));
    std::vector<double> kernel;
    double              sum = 0;
    for (std::int32_t t = -reach; t <= reach; ++t)
    {
      kernel.push_back(std::exp(-0.5 * t * t / left));
      sum += kernel.back();
    }
    std::vector<double> result = given;
    for (const std::int32_t stride : { 1, side })
    {
      std::vector<double> next(result.size(), 0.0);
      for (std::int32_t t = -reach; t <= reach; ++t)
      {
        const double weight = kernel[static_cast<std::size_t>(t + reach)] / sum;
        // Row by row, or with whole rows moved: what leaves one side of a row must not enter the next.
        const std::int32_t begin = std::max(0, -t);
        const std::int32_t end = side - std::max(0, t);
        for (std::int32_t y = stride == 1 ? 0 : begin; y < (stride == 1 ? side : end); ++y)
        {
          const std::int32_t row = y * side;
          for (std::int32_t x = stride == 1 ? begin : 0; x < (stride == 1 ? end : side); ++x)
          {
            next[static_cast<std::size_t>(row + x)] += weight * result[static_cast<std::size_t>(row + x + t * stride)];
          }
        }
      }
      result = std::move(next);
    }
    return result;
  };
  const std::vector<double> once = blurred(values, kSigma * kSigma);
  const std::vector<double> twice = blurred(once, kSigma * kSigma + m_Step * m_Step / 6);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = (1 + kWeight) * once[i] - kWeight * twice[i];
  }
}

} // namespace voxelcore
