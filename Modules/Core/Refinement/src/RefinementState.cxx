#include "RefinementState.h"

#include "MoveGuard.h"
#include "Rims.h"
#include "SmoothRims.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

// Least squares: the step after which the foot points of each pair are equally far. What no pair asks for stays: a
// sheet moves along its normal, a seam of sheets in two directions.
Vector3
Step(const Vector3 & place, std::span<const PointPair> pairs, std::span<const FootPoint> footPoints)
{
  constexpr double      regular = 0.02;
  std::array<double, 6> a{ 0, 0, 0, 0, 0, 0 }; // xx yy zz xy xz yz
  Vector3               b{ 0, 0, 0 };
  for (const PointPair & pair : pairs)
  {
    const FootPoint & p = FootPointOf(footPoints, pair[0]);
    const FootPoint & q = FootPointOf(footPoints, pair[1]);
    if (!(p.distance > 0) || !(q.distance > 0))
    {
      continue;
    }
    const Vector3 up = AddScaled({ 0, 0, 0 }, 1 / p.distance, Minus(place, p.position));
    const Vector3 uq = AddScaled({ 0, 0, 0 }, 1 / q.distance, Minus(place, q.position));
    const Vector3 g = Minus(up, uq);
    const double  r = q.distance - p.distance;
    a = { a[0] + g[0] * g[0], a[1] + g[1] * g[1], a[2] + g[2] * g[2],
          a[3] + g[0] * g[1], a[4] + g[0] * g[2], a[5] + g[1] * g[2] };
    b = AddScaled(b, r, g);
  }
  const double count = static_cast<double>(pairs.size());
  for (double & value : a)
  {
    value /= count;
  }
  a[0] += regular;
  a[1] += regular;
  a[2] += regular;
  b = AddScaled({ 0, 0, 0 }, 1 / count, b);
  // The inverse of a symmetric matrix by its adjugate.
  const Vector3 x{ a[1] * a[2] - a[5] * a[5], a[4] * a[5] - a[3] * a[2], a[3] * a[5] - a[4] * a[1] };
  const Vector3 y{ x[1], a[0] * a[2] - a[4] * a[4], a[3] * a[4] - a[0] * a[5] };
  const Vector3 z{ x[2], y[2], a[0] * a[1] - a[3] * a[3] };
  const double  determinant = a[0] * x[0] + a[3] * x[1] + a[4] * x[2];
  return AddScaled({ 0, 0, 0 }, 1 / determinant, Vector3{ Dot(x, b), Dot(y, b), Dot(z, b) });
}

std::vector<double>
Pick(const std::vector<double> & values, const std::vector<ElementIndex> & ids)
{
  std::vector<double> some;
  some.reserve(ids.size());
  std::transform(ids.begin(), ids.end(), std::back_inserter(some), [&](ElementIndex id) { return values[id]; });
  return some;
}

} // namespace

RefinementState::RefinementState(const RefinementInput & input, CorePart part)
  : m_Input(input)
  , m_Pairs(*input.core, *input.edgePoints, part.cells, part.vertices, part.edges)
{
  const MedialComplex & core = *input.core;
  m_Positions.reserve(part.vertices.size());
  for (const ElementIndex vertex : part.vertices)
  {
    m_Positions.push_back(core.positions[vertex]);
  }
  m_FormerRadius = Pick(core.radius, part.vertices);
  m_FormerLambda = Pick(core.vertexLambda, part.vertices);
  m_Displacement.assign(m_Positions.size(), Vector3{ 0, 0, 0 });
  TriangleComplex cut = CutIntoTriangles(part.cells, m_Positions, input.spacing);
  m_Cells = std::move(cut.cells);
  const auto faces = static_cast<std::ptrdiff_t>(m_Cells.FaceCount());
  m_CornerWidths.resize(m_Cells.faceVertices.size());
#pragma omp parallel for schedule(static) if (faces > 4096)
  for (std::ptrdiff_t i = 0; i < faces; ++i)
  {
    const auto face = static_cast<std::size_t>(i);
    const auto corners = m_Cells.FaceVertices(face);
    for (std::size_t k = 0; k < 3; ++k)
    {
      m_CornerWidths[3 * face + k] =
        static_cast<std::uint32_t>(m_Pairs.Find(corners[k], m_Pairs.OfFace(cut.polygons[face])));
    }
  }
  m_Polygons = std::move(cut.polygons);
  for (const ElementIndex edge : m_Pairs.LooseEdges())
  {
    const auto found = std::lower_bound(m_Cells.edges.begin(), m_Cells.edges.end(), part.cells.edges[edge]);
    AddPairsAround(input.edgePoints->Of(part.edges[edge]), m_LoosePairs);
    m_LooseEdges.emplace_back(static_cast<ElementIndex>(found - m_Cells.edges.begin()), m_LoosePairs.size());
  }
}

double
RefinementState::MoveVertex(const FootPointFinder &    finder,
                            std::size_t                vertex,
                            std::span<const PointPair> pairs,
                            std::vector<FootPoint> &   footPoints)
{
  constexpr double                           longest = 0.5; // voxels a pass
  const Vector3                              place = Place(vertex);
  static thread_local std::vector<PointPair> apart; // filled anew for each vertex
  apart.clear();
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(apart), [&](const PointPair & pair) {
    return !finder.Meet(place, pair);
  });
  if (apart.empty())
  {
    return 0;
  }
  pairs = apart;
  finder.Find(place, pairs, footPoints);
  Vector3      step = Over(Step(place, pairs, footPoints), m_Input.spacing);
  const double length = Length(step);
  step = AddScaled({ 0, 0, 0 }, length > longest ? longest / length : 1.0, step);
  m_Displacement[vertex] = KeepInShape(*m_Input.shape, m_Positions[vertex], AddScaled(m_Displacement[vertex], 1, step));
  return length;
}

void
RefinementState::MoveInPasses(const FootPointFinder &    finder,
                              std::size_t                vertex,
                              std::span<const PointPair> pairs,
                              std::vector<FootPoint> &   footPoints)
{
  constexpr int passes = 3;
  footPoints.clear();
  for (int pass = 0; pass < passes && !pairs.empty(); ++pass)
  {
    if (MoveVertex(finder, vertex, pairs, footPoints) < finder.Ripples()) // the next step is much shorter
    {
      break;
    }
  }
}

void
RefinementState::Move(const FootPointFinder & finder, bool isPruned, const ProgressCallback & progress)
{
  const auto count = static_cast<std::ptrdiff_t>(m_Positions.size());
  m_Widths.assign(m_Pairs.All().size(), 0);
  m_Radius.assign(m_Positions.size(), 0);
  m_Swelling.assign(m_Positions.size(), 0);
  const std::vector<std::uint8_t> isOnLine =
    isPruned ? std::vector<std::uint8_t>(m_Positions.size(), 0) : VerticesOnLines(m_Cells);
  ReportProgress(progress, "refining", 0.2);
  FirstFailure failure;
#pragma omp parallel if (count > 512)
  {
    std::vector<FootPoint> footPoints;
#pragma omp for schedule(dynamic, 64)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      failure.Guard(vertex, [&] {
        MoveInPasses(finder, vertex, Pairs(vertex), footPoints);
        if (isOnLine[vertex] == 0)
        {
          MeasureVertex(finder, vertex, footPoints);
        }
      });
    }
  }
  failure.Rethrow();
  ReportProgress(progress, "refining", 0.8);
}

// All of it, lent out.
CorePart
RefinementState::LendAll()
{
  CorePart part;
  part.vertices.resize(m_Cells.vertexCount);
  part.edges.resize(m_Cells.edges.size());
  part.faces.resize(m_Cells.FaceCount());
  std::iota(part.vertices.begin(), part.vertices.end(), 0);
  std::iota(part.edges.begin(), part.edges.end(), 0);
  std::iota(part.faces.begin(), part.faces.end(), 0);
  part.cells = std::move(m_Cells);
  return part;
}

// Below the threshold the greater radius stays, not the greater measure: beside the axis of a tube all foot points
// meet, and measures no longer tell what is nearest to it. So a line that topology holds is the one in the middle.
LiveElements
RefinementState::Collapse(const CorePart & part, double threshold) const
{
  auto         vertexMeasure = Pick(m_VertexMeasure, part.vertices);
  auto         edgeMeasure = Pick(m_EdgeMeasure, part.edges);
  auto         faceMeasure = Pick(m_FaceMeasure, part.faces);
  const auto   radius = Pick(m_Radius, part.vertices);
  const double greatest =
    std::accumulate(radius.begin(), radius.end(), 0.0, [](double a, double b) { return std::max(a, b); });
  const auto order = [&](double & measure, std::span<const ElementIndex> corners) {
    if (measure < threshold)
    {
      double least = greatest;
      for (const ElementIndex corner : corners)
      {
        least = std::min(least, radius[corner]);
      }
      measure = 0.5 * threshold * (greatest > 0 ? least / greatest : 1);
    }
  };
  for (ElementIndex vertex = 0; vertex < radius.size(); ++vertex)
  {
    order(vertexMeasure[vertex], { &vertex, 1 });
  }
  for (std::size_t edge = 0; edge < edgeMeasure.size(); ++edge)
  {
    order(edgeMeasure[edge], part.cells.edges[edge]);
  }
  for (std::size_t face = 0; face < faceMeasure.size(); ++face)
  {
    order(faceMeasure[face], part.cells.FaceVertices(face));
  }
  return CollapsePart(part, std::move(vertexMeasure), std::move(edgeMeasure), std::move(faceMeasure), threshold);
}

// What has moved is guarded, and then measured where it is: so more may go, and what held it back with it.
RefinedCore
RefinementState::Finish(const FootPointFinder & finder, double threshold, FormerBalls & former)
{
  const bool stays = !(threshold > 0); // no measure is below
  CorePart   part = LendAll();
  if (!stays)
  {
    CorePart all = std::move(part);
    MeasureElements(all.cells);
    part = PartOf(all.cells, Collapse(all, threshold));
    m_Cells = std::move(all.cells);
  }
  bool                 measured = !stays; ///< the elements, where they are
  std::vector<Vector3> wanted = m_Displacement;
  RefinedCore          refined;
  const auto           settle = [&](std::vector<ElementIndex> changed) {
    for (bool again = true; again;)
    {
      refined.displacement.clear();
      refined.core.positions.clear();
      for (const ElementIndex vertex : part.vertices)
      {
        refined.core.positions.push_back(m_Positions[vertex]);
        refined.displacement.push_back(wanted[vertex]);
      }
      GuardMoves(*m_Input.shape, part.cells, refined.core.positions, m_Input.spacing, refined.displacement);
      for (std::size_t vertex = 0; vertex < part.vertices.size(); ++vertex)
      {
        Vector3 & move = m_Displacement[part.vertices[vertex]];
        if (move != refined.displacement[vertex])
        {
          move = refined.displacement[vertex];
          changed.push_back(part.vertices[vertex]);
        }
      }
      std::sort(changed.begin(), changed.end());
      changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
      if (measured && changed.empty())
      {
        return; // nothing measures otherwise, so that nothing more goes
      }
      measured = true;
      MeasureVertices(finder, changed);
      changed.clear();
      if (stays)
      {
        return;
      }
      MeasureElements(m_Cells);
      const std::size_t before = part.vertices.size() + part.edges.size();
      KeepLive(part, Collapse(part, threshold));
      again = part.vertices.size() + part.edges.size() < before;
    }
  };
  settle({});
  const auto goOn = [&](std::vector<ElementIndex> moved, bool areMeasured) {
    for (const ElementIndex vertex : moved)
    {
      wanted[vertex] = m_Displacement[vertex];
    }
    if (!moved.empty() || refined.core.positions.size() != part.vertices.size())
    {
      measured = measured && moved.empty();
      settle(areMeasured ? std::vector<ElementIndex>{} : std::move(moved));
    }
  };
  if (!stays)
  {
    goOn(MoveRims(finder, part, threshold), false);
    goOn(TakeBackAtRims(finder, part, threshold), true);
  }
  goOn(MoveLines(finder, part, wanted), false);
  refined.core.radius = Pick(m_Radius, part.vertices);
  std::vector<std::uint8_t> onFace(part.vertices.size(), 0); // lines are of tubes, which have no sides
  for (const ElementIndex corner : part.cells.faceVertices)
  {
    onFace[corner] = 1;
  }
  for (std::size_t vertex = 0; vertex < onFace.size(); ++vertex)
  {
    refined.core.radius[vertex] -= onFace[vertex] != 0 ? m_Swelling[part.vertices[vertex]] : 0;
  }
  former = {};
  for (const ElementIndex vertex : part.vertices)
  {
    former.positions.push_back(m_Positions[vertex]);
    former.radius.push_back(m_FormerRadius[vertex]);
  }
  if (stays)
  {
    refined.polygons = std::move(m_Polygons);
  }
  else
  {
    refined.core.vertexLambda = Pick(m_VertexMeasure, part.vertices);
    refined.core.edgeLambda = Pick(m_EdgeMeasure, part.edges);
    refined.core.faceLambda = Pick(m_FaceMeasure, part.faces);
  }
  refined.core.cells = std::move(part.cells);
  for (std::size_t vertex = 0; vertex < part.vertices.size(); ++vertex)
  {
    refined.core.positions[vertex] = AddScaled(refined.core.positions[vertex], 1, refined.displacement[vertex]);
  }
  return refined;
}

void
RefinementState::MoveRims(const FootPointFinder & finder, const FormerBalls & former, RefinedCore & refined)
{
  const std::vector<ElementIndex> moved = SmoothRims(m_Input, former, refined);
  for (const ElementIndex vertex : moved)
  {
    m_Displacement[vertex] = refined.displacement[vertex];
  }
  MeasureVertices(finder, moved);
  for (const ElementIndex vertex : moved)
  {
    refined.core.radius[vertex] = m_Radius[vertex] - m_Swelling[vertex];
  }
}

void
RefinementState::MeasureAgain(const FootPointFinder &           finder,
                              const std::vector<ElementIndex> & moved,
                              const RefinedCore &               refined)
{
  for (const ElementIndex vertex : moved)
  {
    m_Displacement[vertex] = refined.displacement[vertex];
  }
  MeasureVertices(finder, moved);
}

void
RefinementState::GiveMeasures(MedialComplex & core)
{
  MeasureElements(core.cells);
  core.vertexLambda = std::move(m_VertexMeasure);
  core.edgeLambda = std::move(m_EdgeMeasure);
  core.faceLambda = std::move(m_FaceMeasure);
}

} // namespace voxelcore
