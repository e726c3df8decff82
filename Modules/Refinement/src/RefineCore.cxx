#include "voxelcore/Refinement.h"

#include "Feet.h"
#include "MoveGuard.h"
#include "Triangles.h"
#include "Vectors.h"
#include "VertexPairs.h"

#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

EdgePoints
NearestToEdges(const DelaunayCells & cells)
{
  EdgePoints edges;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    if (cells.facetCells[facet][1] != kOutside)
    {
      const auto polygon = cells.FacetPoints(facet);
      edges.points.insert(edges.points.end(), polygon.begin(), polygon.end());
      edges.offsets.push_back(edges.points.size());
    }
  }
  return edges;
}

namespace
{

// More is moved than is left in the end, as measures that are taken again may be greater.
constexpr double kWorkingPart = 0.75;

constexpr double kMet = 0.5;

// The part of a core that is worked on, and between which boundary vertices each of its elements lies.
class WorkingCore
{
public:
  WorkingCore(const RefinementInput & input, const LiveElements & live)
    : m_Input(input)
  {
    const MedialComplex & core = *input.core;
    m_Cells = ExtractLive(core.cells, live, m_VertexIds, m_EdgeIds, m_FaceIds);
    for (const ElementIndex vertex : m_VertexIds)
    {
      m_Positions.push_back(core.positions[vertex]);
    }
    m_Pairs = VertexPairs(core, *input.edgePoints, m_Cells, m_VertexIds, m_EdgeIds);
    m_Displacement.assign(m_Positions.size(), Vector3{ 0, 0, 0 });
  }

  void
  Move(const FootFinder & finder, const ProgressCallback & progress);
  MedialComplex
  Measured(const FootFinder & finder) const;
  RefinedCore
  Finish(const FootFinder & finder, double threshold) const;

  std::vector<std::uint8_t>
  UsedPoints() const
  {
    std::vector<std::uint8_t> used(m_Input.points->size(), 0);
    for (const PointPair & pair : m_Pairs.All())
    {
      used[pair[0]] = 1;
      used[pair[1]] = 1;
    }
    return used;
  }

private:
  std::span<const PointPair>
  Pairs(std::size_t vertex) const
  {
    return m_Pairs.Of(vertex);
  }

  Vector3
  Place(std::size_t vertex) const
  {
    return Times(Along(m_Positions[vertex], 1, m_Displacement[vertex]), m_Input.spacing);
  }

  Vector3
  Step(const Vector3 & place, std::span<const PointPair> pairs, std::span<const Foot> feet) const;

  const RefinementInput &   m_Input;
  CellComplex               m_Cells;
  std::vector<ElementIndex> m_VertexIds;
  std::vector<ElementIndex> m_EdgeIds;
  std::vector<ElementIndex> m_FaceIds;
  VertexPairs               m_Pairs;
  std::vector<Vector3>      m_Positions;
  std::vector<Vector3>      m_Displacement;
};

// Least squares: the step after which the feet of each pair are equally far. What no pair asks for stays: a sheet moves
// along its normal, a seam of sheets in two directions.
Vector3
WorkingCore::Step(const Vector3 & place, std::span<const PointPair> pairs, std::span<const Foot> feet) const
{
  constexpr double      regular = 0.02;
  std::array<double, 6> a{ 0, 0, 0, 0, 0, 0 }; // xx yy zz xy xz yz
  Vector3               b{ 0, 0, 0 };
  for (const PointPair & pair : pairs)
  {
    const Foot & p = FootOf(feet, pair[0]);
    const Foot & q = FootOf(feet, pair[1]);
    if (!(p.distance > 0) || !(q.distance > 0))
    {
      continue;
    }
    const Vector3 up = Along({ 0, 0, 0 }, 1 / p.distance, Minus(place, p.position));
    const Vector3 uq = Along({ 0, 0, 0 }, 1 / q.distance, Minus(place, q.position));
    const Vector3 g = Minus(up, uq);
    const double  r = q.distance - p.distance;
    a = { a[0] + g[0] * g[0], a[1] + g[1] * g[1], a[2] + g[2] * g[2],
          a[3] + g[0] * g[1], a[4] + g[0] * g[2], a[5] + g[1] * g[2] };
    b = Along(b, r, g);
  }
  const double count = static_cast<double>(pairs.size());
  for (double & value : a)
  {
    value /= count;
  }
  a[0] += regular;
  a[1] += regular;
  a[2] += regular;
  b = Along({ 0, 0, 0 }, 1 / count, b);
  // The inverse of a symmetric matrix by its adjugate.
  const Vector3 x{ a[1] * a[2] - a[5] * a[5], a[4] * a[5] - a[3] * a[2], a[3] * a[5] - a[4] * a[1] };
  const Vector3 y{ x[1], a[0] * a[2] - a[4] * a[4], a[3] * a[4] - a[0] * a[5] };
  const Vector3 z{ x[2], y[2], a[0] * a[1] - a[3] * a[3] };
  const double  determinant = a[0] * x[0] + a[3] * x[1] + a[4] * x[2];
  return Along({ 0, 0, 0 }, 1 / determinant, Vector3{ Dot(x, b), Dot(y, b), Dot(z, b) });
}

void
WorkingCore::Move(const FootFinder & finder, const ProgressCallback & progress)
{
  constexpr int    passes = 3;
  constexpr double longest = 0.5; // voxels a pass
  const auto       count = static_cast<std::ptrdiff_t>(m_Positions.size());
  for (int pass = 0; pass < passes; ++pass)
  {
    ReportProgress(progress, "refining", static_cast<double>(pass + 1) / (passes + 2));
#pragma omp parallel if (count > 512)
    {
      std::vector<Foot> feet;
#pragma omp for schedule(dynamic, 256)
      for (std::ptrdiff_t i = 0; i < count; ++i)
      {
        const auto vertex = static_cast<std::size_t>(i);
        if (Pairs(vertex).empty())
        {
          continue;
        }
        const Vector3 place = Place(vertex);
        finder.Find(place, Pairs(vertex), feet);
        Vector3      step = Over(Step(place, Pairs(vertex), feet), m_Input.spacing);
        const double length = Length(step);
        step = Along({ 0, 0, 0 }, length > longest ? longest / length : 1.0, step);
        m_Displacement[vertex] =
          KeepInShape(*m_Input.shape, m_Positions[vertex], Along(m_Displacement[vertex], 1, step));
      }
    }
  }
}

// Radii and measures at the places moved to. Measures do not fall from faces to edges to vertices.
MedialComplex
WorkingCore::Measured(const FootFinder & finder) const
{
  MedialComplex core;
  core.cells = m_Cells;
  core.positions = m_Positions;
  core.radius.assign(m_Positions.size(), 0);
  core.vertexLambda.assign(m_Positions.size(), 0);
  core.edgeLambda.assign(m_Cells.edges.size(), 0);
  core.faceLambda.assign(m_Cells.FaceCount(), 0);
  std::vector<double> pairWidth(m_Pairs.All().size(), 0);
  const auto          count = static_cast<std::ptrdiff_t>(m_Positions.size());
#pragma omp parallel if (count > 512)
  {
    std::vector<Foot> feet;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      const auto pairs = Pairs(vertex);
      if (pairs.empty())
      {
        core.radius[vertex] = m_Input.core->radius[m_VertexIds[vertex]];
        core.vertexLambda[vertex] = m_Input.core->vertexLambda[m_VertexIds[vertex]];
        continue;
      }
      finder.Settle(Place(vertex), pairs, feet);
      core.radius[vertex] = NearestFoot(feet);
      for (std::size_t k = 0; k < pairs.size(); ++k)
      {
        const double width = 0.5 * Distance(FootOf(feet, pairs[k][0]).position, FootOf(feet, pairs[k][1]).position);
        pairWidth[m_Pairs.First(vertex) + k] = width;
        core.vertexLambda[vertex] = std::max(core.vertexLambda[vertex], width);
      }
    }
  }
  const auto widthAt = [&](ElementIndex vertex, const PointPair & pair) {
    const auto pairs = Pairs(vertex);
    const auto found = std::lower_bound(pairs.begin(), pairs.end(), pair);
    return pairWidth[m_Pairs.First(vertex) + static_cast<std::size_t>(found - pairs.begin())];
  };
  for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
  {
    double     sum = 0;
    double     least = std::numeric_limits<double>::infinity();
    const auto corners = m_Cells.FaceVertices(face);
    for (const ElementIndex corner : corners)
    {
      const double width = widthAt(corner, m_Pairs.OfFace(face));
      sum += width;
      least = std::min(least, width);
    }
    // Where the feet of a corner have met there is no sheet, whatever the other corners say.
    const double mean = sum / static_cast<double>(corners.size());
    core.faceLambda[face] = least > kMet * mean ? mean : least;
    for (const ElementIndex edge : m_Cells.FaceEdges(face))
    {
      core.edgeLambda[edge] = std::max(core.edgeLambda[edge], core.faceLambda[face]);
    }
  }
  std::vector<PointPair> pairs;
  for (const ElementIndex edge : m_Pairs.LooseEdges())
  {
    pairs.clear();
    AddPairsAround(m_Input.edgePoints->Of(m_EdgeIds[edge]), pairs);
    for (const PointPair & pair : pairs)
    {
      const double width = 0.5 * (widthAt(m_Cells.edges[edge][0], pair) + widthAt(m_Cells.edges[edge][1], pair));
      core.edgeLambda[edge] = std::max(core.edgeLambda[edge], width);
    }
  }
  for (std::size_t edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    for (const ElementIndex end : m_Cells.edges[edge])
    {
      core.vertexLambda[end] = std::max(core.vertexLambda[end], core.edgeLambda[edge]);
    }
  }
  return core;
}

RefinedCore
WorkingCore::Finish(const FootFinder & finder, double threshold) const
{
  const MedialComplex working = Measured(finder);
  SimplePairCollapse  collapse(working.cells, working.vertexLambda, working.edgeLambda, working.faceLambda);
  collapse.CollapseBelow(threshold);
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  MedialComplex             left;
  left.cells = ExtractLive(working.cells, collapse.Live(), vertices, edges, faces);
  std::vector<Vector3> moves;
  for (const ElementIndex vertex : vertices)
  {
    left.positions.push_back(m_Positions[vertex]);
    left.vertexLambda.push_back(working.vertexLambda[vertex]);
    left.radius.push_back(working.radius[vertex]);
    moves.push_back(m_Displacement[vertex]);
  }
  for (const ElementIndex edge : edges)
  {
    left.edgeLambda.push_back(working.edgeLambda[edge]);
  }
  for (const ElementIndex face : faces)
  {
    left.faceLambda.push_back(working.faceLambda[face]);
  }
  RefinedCore refined{ CutIntoTriangles(left, m_Input.spacing), std::move(moves) };
  GuardMoves(*m_Input.shape, refined.core.cells, refined.core.positions, m_Input.spacing, refined.displacement);
  const auto count = static_cast<std::ptrdiff_t>(vertices.size());
#pragma omp parallel if (count > 512)
  {
    std::vector<Foot> feet;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      Vector3 &  position = refined.core.positions[vertex];
      position = Along(position, 1, refined.displacement[vertex]);
      const auto pairs = Pairs(vertices[vertex]);
      if (refined.displacement[vertex] != m_Displacement[vertices[vertex]] && !pairs.empty())
      {
        finder.Settle(Times(position, m_Input.spacing), pairs, feet);
        refined.core.radius[vertex] = NearestFoot(feet);
      }
    }
  }
  return refined;
}

} // namespace

std::vector<RefinedCore>
RefineCore(const RefinementInput & input, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  std::vector<RefinedCore> refined;
  SimplePairCollapse       collapse(input.core->cells,
                              input.core->vertexLambda,
                              input.core->edgeLambda,
                              input.core->faceLambda);
  for (const double threshold : thresholds)
  {
    collapse.CollapseBelow(kWorkingPart * threshold, progress);
    WorkingCore      working(input, collapse.Live());
    const FootFinder finder(input, working.UsedPoints(), progress);
    working.Move(finder, progress);
    refined.push_back(working.Finish(finder, threshold));
  }
  return refined;
}

} // namespace voxelcore
