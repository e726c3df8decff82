// What the elements of a working core measure where they have moved to.

#include "RefinementState.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

// How much of a wall there is about a vertex: 1 between two parallel sides, 0 on the axis of a round tube and where two
// sides meet.
double
WallPart(std::span<const PointPair> pairs, std::span<const FootPoint> footPoints)
{
  std::array<double, 6> sums{};
  for (const PointPair & pair : pairs)
  {
    const FootPoint & one = FootPointOf(footPoints, pair[0]);
    const FootPoint & other = FootPointOf(footPoints, pair[1]);
    const double      unit = 0.5 / std::max(one.distance, other.distance);
    const Vector3     across = Minus(one.position, other.position);
    const Vector3     half{ unit * across[0], unit * across[1], unit * across[2] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sums[axis] += half[axis] * half[axis];
      sums[3 + axis] += half[axis] * half[(axis + 1) % 3];
    }
  }
  const double trace = sums[0] + sums[1] + sums[2];
  if (!(trace > 0))
  {
    return 0;
  }
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    squares += sums[axis] * sums[axis] + 2 * sums[3 + axis] * sums[3 + axis];
  }
  // Of two directions alone, with shares a and b: the square of (a - b) / (a + b).
  const double single = 2 * squares / (trace * trace) - 1;
  return std::clamp(single * trace / static_cast<double>(pairs.size()), 0.0, 1.0);
}

} // namespace

std::vector<double>
RefinementState::GreatestRadii() const
{
  std::vector<double> radii(m_Input.points->size(), 0.0);
  for (std::size_t vertex = 0; vertex < m_Positions.size(); ++vertex)
  {
    const double radius = m_FormerRadius[vertex];
    for (const PointPair & pair : Pairs(vertex))
    {
      for (const std::uint32_t point : pair)
      {
        radii[point] = std::max(radii[point], radius);
      }
    }
  }
  return radii;
}

// How wide the foot points of each pair are apart, and how far the nearest one is, which is returned; they are sought
// from `footPoints`.
double
RefinementState::MeasureAt(const FootPointFinder &    finder,
                           const Vector3 &            place,
                           std::span<const PointPair> pairs,
                           std::vector<FootPoint> &   footPoints,
                           std::span<double>          widths,
                           double &                   swelling) const
{
  finder.Settle(place, pairs, footPoints);
  const FootPoint & nearest = NearestFoot(footPoints);
  double            part = 1; // of the widths, that is the body's
  swelling = m_Input.surface->Swelling(Minus(nearest.position, place));
  if (swelling > 0)
  {
    swelling *= WallPart(pairs, footPoints);
    part -= swelling / nearest.distance;
  }
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    widths[k] = part * 0.5 *
                Distance(FootPointOf(footPoints, pairs[k][0]).position, FootPointOf(footPoints, pairs[k][1]).position);
  }
  return nearest.distance;
}

void
RefinementState::MeasureVertex(const FootPointFinder & finder, std::size_t vertex, std::vector<FootPoint> & footPoints)
{
  const auto pairs = Pairs(vertex);
  if (pairs.empty())
  {
    m_Radius[vertex] = m_FormerRadius[vertex];
    return;
  }
  const std::span<double> widths(m_Widths.data() + m_Pairs.First(vertex), pairs.size());
  m_Radius[vertex] = MeasureAt(finder, Place(vertex), pairs, footPoints, widths, m_Swelling[vertex]);
}

void
RefinementState::MeasureVertices(const FootPointFinder & finder, const std::vector<ElementIndex> & vertices)
{
  const auto   count = static_cast<std::ptrdiff_t>(vertices.size());
  FirstFailure failure;
#pragma omp parallel if (count > 512)
  {
    std::vector<FootPoint> footPoints;
#pragma omp for schedule(dynamic, 256)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      footPoints.clear();
      const auto at = static_cast<std::size_t>(i);
      failure.Guard(at, [&] { MeasureVertex(finder, vertices[at], footPoints); });
    }
  }
  failure.Rethrow();
}

double
RefinementState::WidthAt(ElementIndex vertex, const PointPair & pair) const
{
  return m_Widths[m_Pairs.Find(vertex, pair)];
}

// Where the foot points of one corner have met there is nothing, whatever the others say.
double
MeasureOf(std::span<const double> widths)
{
  constexpr double met = 0.5;
  const double     least = *std::min_element(widths.begin(), widths.end());
  const double     mean = std::accumulate(widths.begin(), widths.end(), 0.0) / static_cast<double>(widths.size());
  return least > met * mean ? mean : least;
}

// Measures do not fall from faces to edges to vertices.
void
RefinementState::MeasureElements(const CellComplex & cells)
{
  m_VertexMeasure.assign(m_Positions.size(), 0);
  m_EdgeMeasure.assign(cells.edges.size(), 0);
  m_FaceMeasure.assign(cells.FaceCount(), 0);
  const auto vertices = static_cast<std::ptrdiff_t>(m_Positions.size());
  const auto faces = static_cast<std::ptrdiff_t>(m_FaceMeasure.size());
#pragma omp parallel if (faces > 4096)
  {
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < vertices; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      const auto first = m_Widths.begin() + static_cast<std::ptrdiff_t>(m_Pairs.First(vertex));
      const auto count = static_cast<std::ptrdiff_t>(Pairs(vertex).size());
      m_VertexMeasure[vertex] =
        count == 0 ? m_FormerLambda[vertex] : std::max(0.0, *std::max_element(first, first + count));
    }
#pragma omp for schedule(static)
    for (std::ptrdiff_t face = 0; face < faces; ++face)
    {
      std::array<double, 3> widths;
      for (std::size_t i = 0; i < 3; ++i)
      {
        widths[i] = m_Widths[m_CornerWidths[3 * static_cast<std::size_t>(face) + i]];
      }
      m_FaceMeasure[static_cast<std::size_t>(face)] = MeasureOf(widths);
    }
  }
  for (std::size_t face = 0; face < m_FaceMeasure.size(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      m_EdgeMeasure[edge] = std::max(m_EdgeMeasure[edge], m_FaceMeasure[face]);
    }
  }
  std::size_t at = 0;
  for (const auto & [edge, end] : m_LooseEdges)
  {
    for (; at < end; ++at)
    {
      const PointPair &           pair = m_LoosePairs[at];
      const std::array<double, 2> widths{ WidthAt(cells.edges[edge][0], pair), WidthAt(cells.edges[edge][1], pair) };
      m_EdgeMeasure[edge] = std::max(m_EdgeMeasure[edge], MeasureOf(widths));
    }
  }
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (const ElementIndex end : cells.edges[edge])
    {
      m_VertexMeasure[end] = std::max(m_VertexMeasure[end], m_EdgeMeasure[edge]);
    }
  }
}

} // namespace voxelcore
