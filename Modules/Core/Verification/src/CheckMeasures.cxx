// Radius measures, and what pruning by them should have left.
#include "Checks.h"
#include "SmallestBall.h"

#include <cmath>

namespace voxelcore::verification
{
namespace
{

Position
Weighted(const Subject & subject, const LatticePoint & point, const LatticePoint & origin)
{
  const auto & weight = subject.input.weights.weight;
  return { static_cast<double>(weight[0]) * (static_cast<double>(point.x) - origin.x),
           static_cast<double>(weight[1]) * (static_cast<double>(point.y) - origin.y),
           static_cast<double>(weight[2]) * (static_cast<double>(point.z) - origin.z) };
}

/** The measure that counts: the stored one, else the recomputed one. */
double
EdgeMeasure(const Subject & subject, std::size_t edge)
{
  const double stored = subject.input.edgeLambda[edge];
  return std::isnan(stored) ? EdgeMeasureOf(subject, edge) : stored;
}

std::string
Instead(const std::string & what, double stored, double recomputed)
{
  return what + " has measure " + Describe(stored) + " mm instead of " + Describe(recomputed) + " mm.";
}

/** Per element, how many elements of the next dimension it bounds and the exclusive-or of their indices: where it is
 *  one, that is the one. */
struct Degrees
{
  std::vector<ElementIndex> count;
  std::vector<ElementIndex> combined;

  explicit Degrees(std::size_t elements)
    : count(elements, 0)
    , combined(elements, 0)
  {}

  void
  Add(std::size_t element, std::size_t coface)
  {
    ++count[element];
    combined[element] ^= static_cast<ElementIndex>(coface);
  }
};

} // namespace

double
MeasureOf(const Subject & subject, std::span<const std::uint32_t> points)
{
  thread_local std::vector<Position> weighted;
  weighted.clear();
  for (const std::uint32_t place : points)
  {
    weighted.push_back(Weighted(subject, subject.Point(place), subject.Point(points[0])));
  }
  return std::sqrt(SmallestBallSquaredRadius(weighted)) * subject.input.weights.unit;
}

double
EdgeMeasureOf(const Subject & subject, std::size_t edge)
{
  thread_local std::vector<std::uint32_t> common;
  const auto [v, w] = subject.cells.edges[edge];
  Intersect(subject.sets.Of(v), subject.sets.Of(w), common);
  return MeasureOf(subject, common);
}

double
HalfDistance(const Subject & subject, std::uint32_t a, std::uint32_t b)
{
  const Position d = Weighted(subject, subject.Point(a), subject.Point(b));
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 2 * subject.input.weights.unit;
}

bool
Agree(double stored, double recomputed)
{
  return std::abs(stored - recomputed) <= kMeasureTolerance * recomputed;
}

void
CheckMeasures(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const CellComplex &       cells = subject.cells;
  const auto                vertexMeasure = [&](std::size_t v) { return MeasureOf(subject, subject.sets.Of(v)); };
  AddCheck(
    report,
    "vertex measures",
    cells.vertexCount,
    [&](std::size_t v) { return subject.sets.IsKnown(v) && !Agree(input.vertexLambda[v], vertexMeasure(v)); },
    [&](std::size_t v) { return Instead(DescribeVertex(subject, v), input.vertexLambda[v], vertexMeasure(v)); });
  AddCheck(
    report,
    "edge measures",
    cells.edges.size(),
    [&](std::size_t e) {
      const auto [v, w] = cells.edges[e];
      return !std::isnan(input.edgeLambda[e]) && subject.sets.IsKnown(v) && subject.sets.IsKnown(w) &&
             !Agree(input.edgeLambda[e], EdgeMeasureOf(subject, e));
    },
    [&](std::size_t e) { return Instead(DescribeEdge(subject, e), input.edgeLambda[e], EdgeMeasureOf(subject, e)); });
  const auto faceMeasure = [&](std::size_t f) {
    return HalfDistance(subject, subject.dualEdges[f][0], subject.dualEdges[f][1]);
  };
  AddCheck(
    report,
    "face measures",
    cells.FaceCount(),
    [&](std::size_t f) { return subject.dualEdges[f][0] != kNoPoint && !Agree(input.faceLambda[f], faceMeasure(f)); },
    [&](std::size_t f) { return Instead(DescribeFace(subject, f), input.faceLambda[f], faceMeasure(f)); });
  // Stored numbers come from exact ones by monotone roundings, so these comparisons need no tolerance.
  const auto edgeExceeds = [&](std::size_t e) {
    const auto [v, w] = cells.edges[e];
    return input.edgeLambda[e] > std::min(input.vertexLambda[v], input.vertexLambda[w]);
  };
  const auto faceExceeds = [&](std::size_t f) {
    const auto corners = cells.FaceVertices(f);
    const auto edges = cells.FaceEdges(f);
    return std::any_of(edges.begin(),
                       edges.end(),
                       [&](ElementIndex e) { return input.faceLambda[f] > input.edgeLambda[e]; }) ||
           std::any_of(corners.begin(), corners.end(), [&](ElementIndex v) {
             return input.faceLambda[f] > input.vertexLambda[v];
           });
  };
  const std::size_t edgeCount = cells.edges.size();
  AddCheck(
    report,
    "measures monotone",
    edgeCount + cells.FaceCount(),
    [&](std::size_t i) { return i < edgeCount ? edgeExceeds(i) : faceExceeds(i - edgeCount); },
    [&](std::size_t i) {
      return i < edgeCount
               ? DescribeEdge(subject, i) + " has a greater measure than one of its vertices."
               : DescribeFace(subject, i - edgeCount) + " has a greater measure than one of its edges or vertices.";
    });
}

void
CheckPruning(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const CellComplex &       cells = subject.cells;
  Degrees                   vertexDegrees(cells.vertexCount);
  Degrees                   edgeDegrees(cells.edges.size());
  for (std::size_t e = 0; e < cells.edges.size(); ++e)
  {
    vertexDegrees.Add(cells.edges[e][0], e);
    vertexDegrees.Add(cells.edges[e][1], e);
  }
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    for (const ElementIndex edge : cells.FaceEdges(f))
    {
      edgeDegrees.Add(edge, f);
    }
  }
  // Recomputed measures within a rounding of the threshold may equal it, and what equals it stays.
  const double threshold = input.threshold.value_or(0.0);
  const auto   isBelow = [&](std::size_t edge) {
    const double stored = input.edgeLambda[edge];
    return std::isnan(stored) ? EdgeMeasure(subject, edge) < threshold * (1 - kMeasureTolerance) : stored < threshold;
  };
  const auto vertexRemovable = [&](std::size_t v) {
    return vertexDegrees.count[v] == 1 && input.vertexLambda[v] < threshold && isBelow(vertexDegrees.combined[v]);
  };
  const auto edgeRemovable = [&](std::size_t e) {
    return edgeDegrees.count[e] == 1 && input.faceLambda[edgeDegrees.combined[e]] < threshold && isBelow(e);
  };
  const std::size_t vertexCount = cells.vertexCount;
  AddCheck(
    report,
    "pruning",
    vertexCount + cells.edges.size(),
    [&](std::size_t i) { return i < vertexCount ? vertexRemovable(i) : edgeRemovable(i - vertexCount); },
    [&](std::size_t i) {
      const std::string pair =
        i < vertexCount ? DescribeVertex(subject, i) + " with " + DescribeEdge(subject, vertexDegrees.combined[i])
                        : DescribeEdge(subject, i - vertexCount) + " with " +
                            DescribeFace(subject, edgeDegrees.combined[i - vertexCount]);
      return pair + " is a simple pair below the threshold of " + Describe(threshold) + " mm.";
    });
}

} // namespace voxelcore::verification
