// Whether the data fit together, cells are distinct, and their order is the canonical one.
#include "Checks.h"

#include <cmath>
#include <numeric>

namespace voxelcore::verification
{
namespace
{

std::string
FirstArrayFault(const VerificationInput & input)
{
  const CellComplex & cells = *input.cells;
  const auto          sizes = [](const char * what, std::size_t is, std::size_t should) {
    return std::string(what) + " are " + std::to_string(is) + " instead of " + std::to_string(should) + ".";
  };
  const std::size_t vertices = cells.vertexCount;
  if (input.positions.size() != vertices)
  {
    return sizes("Positions", input.positions.size(), vertices);
  }
  if (input.radius.size() != vertices)
  {
    return sizes("Radii", input.radius.size(), vertices);
  }
  if (input.vertexLambda.size() != vertices)
  {
    return sizes("Measures of vertices", input.vertexLambda.size(), vertices);
  }
  if (input.edgeLambda.size() != cells.edges.size())
  {
    return sizes("Measures of edges", input.edgeLambda.size(), cells.edges.size());
  }
  if (cells.faceOffsets.empty() || cells.faceOffsets.front() != 0 ||
      !std::is_sorted(cells.faceOffsets.begin(), cells.faceOffsets.end()))
  {
    return "The offsets of the faces do not increase from 0.";
  }
  if (input.faceLambda.size() != cells.FaceCount())
  {
    return sizes("Measures of faces", input.faceLambda.size(), cells.FaceCount());
  }
  if (cells.faceOffsets.back() != cells.faceVertices.size())
  {
    return sizes("Corners of faces", cells.faceVertices.size(), cells.faceOffsets.back());
  }
  if (cells.faceEdges.size() != cells.faceVertices.size())
  {
    return sizes("Edges of faces", cells.faceEdges.size(), cells.faceVertices.size());
  }
  for (std::size_t e = 0; e < cells.edges.size(); ++e)
  {
    if (std::max(cells.edges[e][0], cells.edges[e][1]) >= vertices)
    {
      return "Edge " + std::to_string(e) + " ends at a vertex that does not exist.";
    }
  }
  for (std::size_t i = 0; i < cells.faceVertices.size(); ++i)
  {
    if (cells.faceVertices[i] >= vertices || cells.faceEdges[i] >= cells.edges.size())
    {
      return "The polygon with corner " + std::to_string(i) +
             " of the list refers to a vertex or edge that does not exist.";
    }
  }
  return {};
}

bool
IsMeasure(double value)
{
  return std::isfinite(value) && value >= 0;
}

std::string
FirstNumberFault(const VerificationInput & input)
{
  const CellComplex & cells = *input.cells;
  for (std::size_t v = 0; v < cells.vertexCount; ++v)
  {
    const Position & p = input.positions[v];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      return "Vertex " + std::to_string(v) + " has a position that is not finite.";
    }
    if (!IsMeasure(input.radius[v]) || !IsMeasure(input.vertexLambda[v]))
    {
      return "Vertex " + std::to_string(v) + " has a radius or measure that is not finite or negative.";
    }
  }
  std::vector<bool> onFace(cells.edges.size(), false);
  for (const ElementIndex edge : cells.faceEdges)
  {
    onFace[edge] = true;
  }
  for (std::size_t e = 0; e < cells.edges.size(); ++e)
  {
    if (!IsMeasure(input.edgeLambda[e]) && !(std::isnan(input.edgeLambda[e]) && onFace[e]))
    {
      return "Edge " + std::to_string(e) + " has no usable measure.";
    }
  }
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    if (!IsMeasure(input.faceLambda[f]))
    {
      return "Face " + std::to_string(f) + " has no usable measure.";
    }
  }
  return {};
}

/** The corners of each face, sorted, in the layout of the corners. */
std::vector<ElementIndex>
SortedCorners(const CellComplex & cells)
{
  std::vector<ElementIndex> corners = cells.faceVertices;
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    std::sort(corners.begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[f]),
              corners.begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[f + 1]));
  }
  return corners;
}

bool
CornersBefore(const CellComplex & cells, const std::vector<ElementIndex> & corners, std::size_t f, std::size_t g)
{
  const ElementIndex * data = corners.data();
  return std::lexicographical_compare(data + cells.faceOffsets[f],
                                      data + cells.faceOffsets[f + 1],
                                      data + cells.faceOffsets[g],
                                      data + cells.faceOffsets[g + 1]);
}

/** Whether vertex `v` comes strictly before `v + 1`, as far as can be told. */
bool
InOrder(const Subject & subject, std::size_t v)
{
  const Position & p = subject.input.positions[v];
  const Position & q = subject.input.positions[v + 1];
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (std::abs(p[a] - q[a]) > 2 * subject.tolerance)
    {
      return p[a] < q[a];
    }
    // Too close for rounded positions: the exact centres decide. A vertex without one offends elsewhere.
    if (subject.sets.IsKnown(v) && subject.sets.IsKnown(v + 1))
    {
      const SpacingWeights & weights = subject.input.weights;
      return CompareCentres(CentreOf(subject.sets, subject.tree, weights, v),
                            CentreOf(subject.sets, subject.tree, weights, v + 1),
                            weights) < 0;
    }
  }
  return true;
}

/** Indices 0 .. count-1 that are followed, in the given strict weak order, by an equal one. */
template <typename Before>
std::vector<std::size_t>
FindRepeated(std::size_t count, Before before)
{
  std::vector<ElementIndex> order(count);
  std::iota(order.begin(), order.end(), ElementIndex{ 0 });
  if (!std::is_sorted(order.begin(), order.end(), before))
  {
    std::sort(order.begin(), order.end(), before);
  }
  std::vector<std::size_t> repeated;
  for (std::size_t i = 0; i + 1 < count; ++i)
  {
    if (!before(order[i], order[i + 1]))
    {
      repeated.push_back(std::max(order[i], order[i + 1]));
    }
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

} // namespace

bool
CheckArrays(VerificationReport & report, const VerificationInput & input)
{
  std::string fault = FirstArrayFault(input);
  const bool  fits = fault.empty();
  report.checks.push_back({ "arrays", fits, fits ? 0U : 1U, std::move(fault) });
  if (!fits)
  {
    return false;
  }
  fault = FirstNumberFault(input);
  const bool usable = fault.empty();
  report.checks.push_back({ "numbers", usable, usable ? 0U : 1U, std::move(fault) });
  return usable;
}

bool
CheckIncidences(VerificationReport & report, const CellComplex & cells)
{
  const std::size_t before = report.checks.size();
  AddCheck(
    report,
    "edge ends",
    cells.edges.size(),
    [&](std::size_t e) { return cells.edges[e][0] >= cells.edges[e][1]; },
    [&](std::size_t e) {
      return "Edge " + std::to_string(e) +
             " does not go from a smaller to a greater vertex: " + std::to_string(cells.edges[e][0]) + ", " +
             std::to_string(cells.edges[e][1]) + ".";
    });
  const std::vector<ElementIndex> corners = SortedCorners(cells);
  AddCheck(
    report,
    "polygons",
    cells.FaceCount(),
    [&](std::size_t f) {
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[f]);
      const auto last = corners.begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[f + 1]);
      return last - first < 3 || std::adjacent_find(first, last) != last;
    },
    [&](std::size_t f) {
      return "Face " + std::to_string(f) + " with " + std::to_string(cells.FaceVertices(f).size()) +
             " corners has fewer than 3 or meets one twice.";
    });
  const auto edgeFits = [&](std::size_t f) {
    const auto polygon = cells.FaceVertices(f);
    const auto edges = cells.FaceEdges(f);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const ElementIndex next = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      const auto &       ends = cells.edges[edges[i]];
      if (std::minmax(polygon[i], next) != std::minmax(ends[0], ends[1]))
      {
        return false;
      }
    }
    return true;
  };
  AddCheck(
    report,
    "polygon edges",
    cells.FaceCount(),
    [&](std::size_t f) { return !edgeFits(f); },
    [&](std::size_t f) { return "Face " + std::to_string(f) + " has a side that is not the edge given for it."; });
  return std::all_of(report.checks.begin() + static_cast<std::ptrdiff_t>(before),
                     report.checks.end(),
                     [](const VerificationCheck & check) { return check.passed; });
}

void
CheckDistinct(VerificationReport & report, const Subject & subject)
{
  const CellComplex & cells = subject.cells;
  const auto          add = [&](const char * name, const std::vector<std::size_t> & repeated, const auto & describe) {
    const bool passed = repeated.empty();
    report.checks.push_back({ name, passed, repeated.size(), passed ? std::string() : describe(repeated.front()) });
  };
  // Different Voronoi vertices have different nearest sets, the same have the same, whatever rounding did to positions.
  // Vertices without a set are told apart by position; they offend elsewhere already.
  const auto setBefore = [&](ElementIndex v, ElementIndex w) {
    const auto a = subject.sets.Of(v);
    const auto b = subject.sets.Of(w);
    if (a.empty() && b.empty())
    {
      return subject.input.positions[v] < subject.input.positions[w];
    }
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  add("distinct vertices", FindRepeated(cells.vertexCount, setBefore), [&](std::size_t v) {
    return "A vertex occurs again as " + DescribeVertex(subject, v) + ".";
  });
  const auto edgeBefore = [&](ElementIndex e, ElementIndex f) {
    return std::minmax(cells.edges[e][0], cells.edges[e][1]) < std::minmax(cells.edges[f][0], cells.edges[f][1]);
  };
  add("distinct edges", FindRepeated(cells.edges.size(), edgeBefore), [&](std::size_t e) {
    return "An edge occurs again as " + DescribeEdge(subject, e) + ".";
  });
  const std::vector<ElementIndex> corners = SortedCorners(cells);
  std::vector<std::size_t>        repeated = FindRepeated(cells.FaceCount(), [&](ElementIndex f, ElementIndex g) {
    return CornersBefore(cells, corners, f, g);
  });
  if (repeated.empty())
  {
    // A polygon cut in two has different corners but the same dual edge.
    std::vector<ElementIndex> known;
    for (std::size_t f = 0; f < subject.dualEdges.size(); ++f)
    {
      if (subject.dualEdges[f][0] != kNoPoint)
      {
        known.push_back(static_cast<ElementIndex>(f));
      }
    }
    for (const std::size_t i : FindRepeated(known.size(), [&](ElementIndex i, ElementIndex j) {
           return subject.dualEdges[known[i]] < subject.dualEdges[known[j]];
         }))
    {
      repeated.push_back(known[i]);
    }
  }
  add("distinct faces", repeated, [&](std::size_t f) {
    return "A face occurs again, or lies between the same two boundary vertices as another: " +
           DescribeFace(subject, f) + ".";
  });
}

void
CheckOrder(VerificationReport & report, const Subject & subject)
{
  const CellComplex & cells = subject.cells;
  const auto          pairs = [](std::size_t count) { return count == 0 ? 0 : count - 1; };
  AddCheck(
    report,
    "vertex order",
    pairs(cells.vertexCount),
    [&](std::size_t v) { return !InOrder(subject, v); },
    [&](std::size_t v) { return DescribeVertex(subject, v) + " does not come before its successor."; });
  AddCheck(
    report,
    "edge order",
    pairs(cells.edges.size()),
    [&](std::size_t e) { return !(cells.edges[e] < cells.edges[e + 1]); },
    [&](std::size_t e) { return DescribeEdge(subject, e) + " does not come before its successor."; });
  const std::vector<ElementIndex> corners = SortedCorners(cells);
  AddCheck(
    report,
    "face order",
    cells.FaceCount(),
    [&](std::size_t f) {
      const auto polygon = cells.FaceVertices(f);
      const bool startsRight = polygon.front() == corners[cells.faceOffsets[f]];
      return !startsRight || (f + 1 < cells.FaceCount() && !CornersBefore(cells, corners, f, f + 1));
    },
    [&](std::size_t f) {
      return DescribeFace(subject, f) + " does not start at its smallest vertex or does not come before its successor.";
    });
}

} // namespace voxelcore::verification
