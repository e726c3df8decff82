// Whether edges and faces are dual to facets and edges of the Delaunay cells, and polygons are planar, convex,
// oriented.
#include "Checks.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <numbers>

namespace voxelcore::verification
{
namespace
{

/** A polygon in the metric of the weights, relative to its first corner. */
struct Polygon
{
  std::vector<Position> corners;
  Position              normal{ 0, 0, 0 }; ///< twice the area vector (Newell)
  double                perimeter = 0;
  double                tolerance = 0; ///< how far a corner may be from where it should
};

Polygon
PolygonOf(const Subject & subject, std::size_t face)
{
  const auto             corners = subject.cells.FaceVertices(face);
  const SpacingWeights & weights = subject.input.weights;
  const Position &       origin = subject.input.positions[corners[0]];
  Polygon                polygon;
  polygon.tolerance = 2 * Reach(weights, subject.tolerance);
  for (const ElementIndex v : corners)
  {
    Position p = Minus(subject.input.positions[v], origin);
    for (std::size_t a = 0; a < 3; ++a)
    {
      p[a] *= static_cast<double>(weights.weight[a]);
    }
    polygon.corners.push_back(p);
  }
  for (std::size_t i = 0; i < polygon.corners.size(); ++i)
  {
    const Position & p = polygon.corners[i];
    const Position & q = polygon.corners[i + 1 == polygon.corners.size() ? 0 : i + 1];
    const Position   cross = Cross(p, q);
    for (std::size_t a = 0; a < 3; ++a)
    {
      polygon.normal[a] += cross[a];
    }
    polygon.perimeter += Length(Minus(q, p));
  }
  return polygon;
}

/** How wrong the normal may be: moving the corners by the tolerance sweeps at most this area twice. */
double
NormalError(const Polygon & polygon)
{
  return 2 * polygon.tolerance * (polygon.perimeter + polygon.tolerance);
}

bool
IsPlanar(const Polygon & polygon)
{
  // The heights above the plane through the first corner, times the length of the normal. An error of the normal
  // counts as far as a corner is away.
  const double allowed = 2 * polygon.tolerance * Length(polygon.normal) + NormalError(polygon) * polygon.perimeter;
  return std::all_of(polygon.corners.begin(), polygon.corners.end(), [&](const Position & p) {
    return std::abs(Dot(p, polygon.normal)) <= allowed;
  });
}

/** Turns left at every corner, and once round in all (a star turns left too, but twice round). */
bool
IsConvex(const Polygon & polygon)
{
  const double size = Length(polygon.normal);
  if (size <= NormalError(polygon))
  {
    return true; // a sliver that the rounding of positions cannot tell from a line
  }
  // Sides shorter than the rounding have no direction of their own.
  std::vector<Position> sides;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i)
  {
    const Position side = Minus(polygon.corners[i + 1 == polygon.corners.size() ? 0 : i + 1], polygon.corners[i]);
    if (Length(side) > 4 * polygon.tolerance)
    {
      sides.push_back(side);
    }
  }
  double turn = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const Position & a = sides[i];
    const Position & b = sides[i + 1 == sides.size() ? 0 : i + 1];
    const double     sine = Dot(Cross(a, b), polygon.normal) / size;
    if (sine < -2 * polygon.tolerance * (Length(a) + Length(b)))
    {
      return false;
    }
    turn += std::atan2(sine, Dot(a, b));
  }
  return turn < 3 * std::numbers::pi;
}

/** Whether the normal points from the smaller to the greater of the two boundary vertices. */
bool
IsOriented(const Subject & subject, std::size_t face, const Polygon & polygon)
{
  const auto [a, b] = subject.dualEdges[face];
  if (a == kNoPoint || Length(polygon.normal) <= NormalError(polygon))
  {
    return true;
  }
  const auto [lower, upper] = std::minmax(subject.Point(a), subject.Point(b));
  const SpacingWeights & weights = subject.input.weights;
  const Position         direction{ static_cast<double>(weights.weight[0]) * (static_cast<double>(upper.x) - lower.x),
                            static_cast<double>(weights.weight[1]) * (static_cast<double>(upper.y) - lower.y),
                            static_cast<double>(weights.weight[2]) * (static_cast<double>(upper.z) - lower.z) };
  return (Dot(direction, polygon.normal) > 0) != subject.input.polygonsReversed;
}

} // namespace

void
FindDualEdges(Subject & subject)
{
  const CellComplex & cells = subject.cells;
  subject.dualEdges.assign(cells.FaceCount(), { kNoPoint, kNoPoint });
  FirstFailure failure;
#pragma omp parallel if (cells.FaceCount() > 4096)
  {
    std::vector<std::uint32_t> common;
    std::vector<std::uint32_t> next;
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t f = 0; f < cells.FaceCount(); ++f)
    {
      failure.Guard(f, [&] {
        const auto corners = cells.FaceVertices(f);
        const auto first = subject.sets.Of(corners[0]);
        common.assign(first.begin(), first.end());
        for (const ElementIndex v : corners.subspan(1))
        {
          Intersect(common, subject.sets.Of(v), next);
          common.swap(next);
        }
        if (common.size() == 2)
        {
          subject.dualEdges[f] = { common[0], common[1] };
        }
      });
    }
  }
  failure.Rethrow();
}

void
CheckDuals(VerificationReport & report, const Subject & subject)
{
  const CellComplex & cells = subject.cells;
  const auto          known = [&](ElementIndex v) { return subject.sets.IsKnown(v); };
  // An element with a vertex whose own set is not known is left to that vertex' check.
  AddCheck(
    report,
    "edges dual",
    cells.edges.size(),
    [&](std::size_t e) {
      const auto [v, w] = cells.edges[e];
      std::vector<std::uint32_t> common;
      Intersect(subject.sets.Of(v), subject.sets.Of(w), common);
      return known(v) && known(w) && common.size() < 3;
    },
    [&](std::size_t e) {
      return "The ends of " + DescribeEdge(subject, e) + " do not share three nearest boundary vertices.";
    });
  AddCheck(
    report,
    "faces dual",
    cells.FaceCount(),
    [&](std::size_t f) {
      const auto corners = cells.FaceVertices(f);
      return subject.dualEdges[f][0] == kNoPoint && std::all_of(corners.begin(), corners.end(), known);
    },
    [&](std::size_t f) {
      return "The corners of " + DescribeFace(subject, f) + " do not share exactly two nearest boundary vertices.";
    });
}

void
CheckPolygons(VerificationReport & report, const Subject & subject)
{
  const std::size_t count = subject.cells.FaceCount();
  AddCheck(
    report,
    "faces planar",
    count,
    [&](std::size_t f) { return !IsPlanar(PolygonOf(subject, f)); },
    [&](std::size_t f) { return DescribeFace(subject, f) + " is not planar."; });
  AddCheck(
    report,
    "faces convex",
    count,
    [&](std::size_t f) { return !IsConvex(PolygonOf(subject, f)); },
    [&](std::size_t f) { return DescribeFace(subject, f) + " is not convex."; });
  AddCheck(
    report,
    "faces oriented",
    count,
    [&](std::size_t f) { return !IsOriented(subject, f, PolygonOf(subject, f)); },
    [&](std::size_t f) {
      return "The normal of " + DescribeFace(subject, f) +
             " points from the greater to the smaller of its two nearest " + "boundary vertices " +
             Describe(subject.Point(subject.dualEdges[f][0])) + " and " +
             Describe(subject.Point(subject.dualEdges[f][1])) + ".";
    });
}

} // namespace voxelcore::verification
