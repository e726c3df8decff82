#include "voxelcore/Vessels/BranchSections.h"

#include "BorderPlaces.h"
#include "NearestBranch.h"
#include "PlaneContours.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>

namespace voxelcore
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// All in sides of the cube with a voxel's diagonal.
constexpr double kLeastWindow = 3;    // over which a direction is found, to each side
constexpr double kWindowInRadii = 2;  // the same in radii, as what is thick zigzags in proportion
constexpr double kFinest = 0.4;       // sides of squares in which a section is looked at,
constexpr double kCoarsest = 1;       // between these,
constexpr double kInRadius = 8;       // and so many in a radius where that lies between them: 60 places on a circle
constexpr double kReachInRadii = 1.3; // a section goes hardly farther from its branch in most cases
constexpr double kAstray = 1;         // a branch may lie outside a surface smoother than its voxels by about so much
constexpr double kOtherIsNearer = 0.5;

/** Where a branch is and where it goes. */
struct OnBranch
{
  Vector3 place{};
  Vector3 axis{};
  double  radius = 0;
  double  wide = 0; ///< radius of the circle with the area of the section, or of the ball if that is more
};

class Branches
{
public:
  Branches(const std::vector<DenseBranch> & branches, double side)
    : m_Branches(&branches)
    , m_Side(side)
  {}

  /** The place is on the lines between points; the axis is that of the parabola that fits best around it. */
  OnBranch
  At(std::size_t branch, double arc) const
  {
    const DenseBranch & line = (*m_Branches)[branch];
    const auto          after = ranges::lower_bound(line.arc, arc);
    const auto          last =
      static_cast<std::size_t>(std::min<std::ptrdiff_t>(std::max<std::ptrdiff_t>(after - line.arc.begin(), 1),
                                                        static_cast<std::ptrdiff_t>(line.arc.size()) - 1));
    const double gap = line.arc[last] - line.arc[last - 1];
    const double t = gap > 0 ? std::clamp((arc - line.arc[last - 1]) / gap, 0.0, 1.0) : 0;
    OnBranch     on;
    on.place = AddScaled(line.places[last - 1], t, Minus(line.places[last], line.places[last - 1]));
    on.radius = (1 - t) * line.radius[last - 1] + t * line.radius[last];
    on.wide = (1 - t) * line.wide[last - 1] + t * line.wide[last];
    on.axis = Axis(line, arc, std::max(kLeastWindow * m_Side, kWindowInRadii * on.wide));
    return on;
  }

private:
  /** By least squares over `window` before and behind; round a closed branch. */
  static Vector3
  Axis(const DenseBranch & line, double arc, double window)
  {
    window = std::min(window, line.isClosed ? 0.25 * line.Length() : line.Length());
    // Sums of powers of u and of these times places, from the first on.
    double     moments[5]{};
    Vector3    sums[3]{};
    const auto add = [&](std::size_t i, double shift) {
      const double u = (line.arc[i] + shift - arc) / window;
      if (std::abs(u) >= 1)
      {
        return;
      }
      const double near = 1 - u * u;
      const double before = i > 0 ? line.arc[i] - line.arc[i - 1] : 0;
      const double behind = i + 1 < line.arc.size() ? line.arc[i + 1] - line.arc[i] : 0;
      double       power = near * near * (before + behind);
      for (std::size_t k = 0; k < 5; ++k)
      {
        moments[k] += power;
        if (k < 3)
        {
          sums[k] = AddScaled(sums[k], power, Minus(line.places[i], line.places.front()));
        }
        power *= u;
      }
    };
    for (std::size_t i = 0; i < line.places.size(); ++i)
    {
      add(i, 0);
      if (line.isClosed)
      {
        add(i, line.Length());
        add(i, -line.Length());
      }
    }
    // The slope of the parabola at u = 0, by Cramer's rule; where too few places are near, of the straight line.
    const double * m = moments;
    const double   c[3] = { m[2] * m[3] - m[1] * m[4], m[0] * m[4] - m[2] * m[2], m[1] * m[2] - m[0] * m[3] };
    const double   determinant = m[1] * c[0] + m[2] * c[1] + m[3] * c[2];
    Vector3        slope{};
    if (determinant > 1e-9 * m[0] * m[0] * m[0])
    {
      slope = AddScaled(AddScaled(AddScaled({}, c[0], sums[0]), c[1], sums[1]), c[2], sums[2]);
    }
    else
    {
      slope = AddScaled(AddScaled({}, m[0], sums[1]), -m[1], sums[0]);
    }
    if (!(Length(slope) > 0))
    {
      slope = Minus(line.places.back(), line.places.front());
    }
    return Length(slope) > 0 ? AddScaled({}, 1 / Length(slope), slope) : Vector3{ 0, 0, 1 };
  }

  const std::vector<DenseBranch> * m_Branches;
  double                           m_Side;
};

Vector3
TurnedToLps(const ImageGeometry & geometry, const Vector3 & alongGrid)
{
  Vector3 turned{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      turned[row] += geometry.direction[3 * row + k] * alongGrid[k];
    }
  }
  return turned;
}

void
Measure(const SectionBody &   body,
        const SectionPlane &  plane,
        PlaneSides &          sides,
        std::int32_t          astray,
        const NearestBranch & nearest,
        BranchSection &       section)
{
  const ImageGeometry & geometry = body.geometry;
  const auto toLps = [&](const Vector3 & place) { return LatticeToPhysical(geometry, Over(place, geometry.spacing)); };
  auto       lines = PlaneContours(sides, astray);
  for (auto & line : lines)
  {
    for (Vector2 & at : line)
    {
      const Vector3 way = Minus(sides.Place(at), plane.origin);
      at = { Dot(way, plane.across[0]), Dot(way, plane.across[1]) };
    }
  }
  section.place = toLps(plane.origin);
  section.axis = TurnedToLps(geometry, plane.axis);
  section.centre = section.place;
  if (lines.empty())
  {
    section.area = kUnknown;
    section.perimeter = kUnknown;
    section.leastDiameter = kUnknown;
    section.greatestDiameter = kUnknown;
    return;
  }
  const OutlineNumbers numbers = MeasureOutline(lines);
  const auto           wayInLps = [&](const Vector2 & way) {
    return TurnedToLps(geometry, AddScaled(AddScaled({}, way[0], plane.across[0]), way[1], plane.across[1]));
  };
  section.area = numbers.area;
  section.perimeter = numbers.perimeter;
  section.leastDiameter = numbers.leastWidth;
  section.leastWay = wayInLps(numbers.leastWay);
  section.greatestDiameter = numbers.greatestWidth;
  section.greatestWay = wayInLps(numbers.greatestWay);
  section.centre = toLps(plane.At(numbers.centre));
  std::vector<Vector3> places;
  for (const auto & line : lines)
  {
    section.contours.emplace_back();
    for (const Vector2 & at : line)
    {
      const Vector3 place = plane.At(at);
      places.push_back(place);
      section.contours.back().push_back(toLps(place));
      section.isCut = section.isCut || (body.scan && IsAtBorder(*body.scan, Over(place, geometry.spacing)));
    }
  }
  section.runsInto = nearest.Other(section.branch, places);
}

} // namespace

double
BranchSection::EquivalentDiameter() const
{
  return 2 * std::sqrt(area / std::numbers::pi);
}

double
BranchSection::Circularity() const
{
  return 4 * std::numbers::pi * area / (perimeter * perimeter);
}

std::vector<BranchSection>
MeasureSections(const SkeletonGraph & graph, const SectionBody & body, std::optional<double> every)
{
  const double                   side = VoxelSide(body.geometry);
  const std::vector<DenseBranch> dense = DenseBranches(graph, body.geometry);
  const Branches                 branches(dense, side);
  std::vector<BranchSection>     sections;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const DenseBranch & line = dense[branch];
    std::vector<double> arcs = line.arcOfPoint;
    if (every)
    {
      const double parts = std::max(1.0, std::round(line.Length() / *every));
      arcs.clear();
      for (double part = 0; part <= parts; ++part)
      {
        arcs.push_back(line.Length() * part / parts);
      }
    }
    for (const double arc : arcs)
    {
      sections.emplace_back();
      sections.back().branch = static_cast<ElementIndex>(branch);
      sections.back().arc = arc;
    }
  }
  const NearestBranch nearest(dense, kOtherIsNearer * side);
  RunEach(sections.size(), [&](std::size_t i) {
    BranchSection &    section = sections[i];
    const OnBranch     on = branches.At(section.branch, section.arc);
    const SectionPlane plane(on.place, on.axis, std::clamp(on.radius / kInRadius, kFinest * side, kCoarsest * side));
    const Vector3 &    spacing = body.geometry.spacing;
    const auto         astray = static_cast<std::int32_t>(std::max(1.0, kAstray * side / plane.step));
    if (body.surface != nullptr)
    {
      SidesOfSurface sides(*body.shape, *body.surface, spacing, plane);
      Measure(body, plane, sides, astray, nearest, section);
    }
    else
    {
      SidesOfVoxels sides(*body.shape, spacing, plane, kReachInRadii * on.wide);
      Measure(body, plane, sides, astray, nearest, section);
    }
  });
  return sections;
}

} // namespace voxelcore
