#include "voxelcore/VoxelCore/SoundCore.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace voxelcore
{

namespace
{

// See the header. Exact cores have 1. In refined ones edges of a voxel were seen whose ends both had radii of a
// fortieth. Few scans have voxels more than 20 times as long as wide, and edges are about half a width.
constexpr double kMostOfTwoSides = 2;
constexpr double kMostEdges = 100;

// Of scans no coordinate is more than 2^36 of the finest spacings (RequireDistinctPositions), and the greatest of a
// core's radii is more than half of one; a bit more for refined ones.
constexpr double kMostRadii = 0x1p38;

bool
IsLength(double value)
{
  return value >= 0 && value < std::numeric_limits<double>::infinity();
}

std::string
FaultOfMeasures(const std::vector<double> & measures, const char * elements, bool mayLack)
{
  const bool areFit = std::all_of(measures.begin(), measures.end(), [&](double measure) {
    return IsLength(measure) || (mayLack && std::isnan(measure));
  });
  return areFit ? std::string() : Text("a measure Lambda of its ", elements, " is below 0 or no finite number");
}

/** Of all edges; 0 where there are none. */
double
MiddleLength(const MedialComplex & core)
{
  std::vector<double> lengths;
  lengths.reserve(core.cells.edges.size());
  for (const auto & edge : core.cells.edges)
  {
    lengths.push_back(Distance(core.positions[edge[0]], core.positions[edge[1]]));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return lengths.empty() ? 0 : *middle;
}

} // namespace

std::string
FaultOfNumbers(const MedialComplex & core, const NumbersFrom & from)
{
  const std::size_t firstPoint = from.firstPoint;
  for (std::size_t v = 0; v < core.positions.size(); ++v)
  {
    const auto & place = core.positions[v];
    if (!std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }))
    {
      return Text("point ", firstPoint + v, " has a coordinate that is no finite number");
    }
    if (!IsLength(core.radius[v]))
    {
      return Text("point ", firstPoint + v, " has the Radius ", RoundTripText(core.radius[v]), ", which is no length");
    }
  }
  const double most = core.radius.empty() ? 0 : kMostRadii * *std::max_element(core.radius.begin(), core.radius.end());
  for (std::size_t v = 0; v < core.positions.size(); ++v)
  {
    for (const double x : core.positions[v])
    {
      if (!(std::abs(x) <= most))
      {
        return Text("point ", firstPoint + v, " has the coordinate ", RoundTripText(x), ", which is too far off");
      }
    }
  }
  const double slack = from.rounding + (from.isRefined ? kMostEdges * MiddleLength(core) : 0);
  for (const auto & edge : core.cells.edges)
  {
    const double          length = Distance(core.positions[edge[0]], core.positions[edge[1]]);
    std::array<double, 3> sides{ core.radius[edge[0]], core.radius[edge[1]], length };
    std::sort(sides.begin(), sides.end());
    if (!(sides[2] <= kMostOfTwoSides * (sides[0] + sides[1]) + slack))
    {
      return Text("points ",
                  firstPoint + edge[0],
                  " and ",
                  firstPoint + edge[1],
                  " of an edge are ",
                  RoundTripText(length),
                  " apart and have the radii ",
                  RoundTripText(core.radius[edge[0]]),
                  " and ",
                  RoundTripText(core.radius[edge[1]]),
                  ", as in no medial surface");
    }
  }
  std::string fault = FaultOfMeasures(core.vertexLambda, "points", false);
  fault = fault.empty() ? FaultOfMeasures(core.edgeLambda, "edges", true) : fault;
  return fault.empty() ? FaultOfMeasures(core.faceLambda, "faces", false) : fault;
}

} // namespace voxelcore
