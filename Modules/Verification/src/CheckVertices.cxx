// Whether vertices lie inside the shape, as far from the boundary vertices as they say.
#include "Checks.h"

#include <cmath>
#include <limits>

namespace voxelcore::verification
{
/** A position within the tolerance of a plane between voxels must have the voxels on both sides in. No true vertex is
 *  that close to the boundary: the lattice points nearest to a point less than half a voxel above a boundary square are
 *  corners of that square alone, which lie in a plane. */
bool
IsInside(const VoxelShape & shape, const Position & position, double tolerance)
{
  std::array<std::array<std::int32_t, 2>, 3> range{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double lower = std::floor(position[a] - tolerance);
    const double upper = std::floor(position[a] + tolerance);
    const double limit = std::numeric_limits<std::int32_t>::max();
    if (!(lower > -limit && upper < limit && upper - lower <= 1))
    {
      return false;
    }
    range[a] = { static_cast<std::int32_t>(lower), static_cast<std::int32_t>(upper) };
  }
  for (const std::int32_t x : range[0])
  {
    for (const std::int32_t y : range[1])
    {
      for (const std::int32_t z : range[2])
      {
        if (!shape.Contains(x, y, z))
        {
          return false;
        }
      }
    }
  }
  return true;
}

void
CheckVertices(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const std::size_t         count = subject.cells.vertexCount;
  const double              unit = input.weights.unit;
  AddCheck(
    report,
    "vertices inside",
    count,
    [&](std::size_t v) { return !IsInside(*input.shape, input.positions[v], subject.tolerance); },
    [&](std::size_t v) { return DescribeVertex(subject, v) + " is not inside the shape."; });
  AddCheck(
    report,
    "vertices equidistant",
    count,
    [&](std::size_t v) { return !subject.sets.IsKnown(v); },
    [&](std::size_t v) {
      return DescribeVertex(subject, v) +
             " is not equally far from four affinely independent nearest boundary vertices.";
    });
  // The distance of a rounded position is off by no more than the position is.
  const double reach = Reach(input.weights, subject.tolerance) * unit;
  AddCheck(
    report,
    "nothing nearer",
    count,
    [&](std::size_t v) {
      return !(subject.sets.distance[v] * unit >= input.radius[v] * (1 - kMeasureTolerance) - reach);
    },
    [&](std::size_t v) {
      return "A boundary vertex is " + Describe(subject.sets.distance[v] * unit) + " mm from " +
             DescribeVertex(subject, v) + ", whose radius is " + Describe(input.radius[v]) + " mm.";
    });
  const auto radius = [&](std::size_t v) {
    return subject.sets.IsKnown(v)
             ? Radius(CentreOf(subject.sets, subject.tree, input.weights, v), input.weights) * unit
             : subject.sets.distance[v] * unit;
  };
  AddCheck(
    report,
    "radius",
    count,
    [&](std::size_t v) { return !Agree(input.radius[v], radius(v)); },
    [&](std::size_t v) {
      return DescribeVertex(subject, v) + " has radius " + Describe(input.radius[v]) + " mm instead of " +
             Describe(radius(v)) + " mm.";
    });
}

} // namespace voxelcore::verification
