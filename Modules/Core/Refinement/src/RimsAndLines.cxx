// Rims of sheets and lines go on when it is known what is left.

#include "MoveGuard.h"
#include "RefinementState.h"
#include "Rims.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace voxelcore
{

std::vector<std::uint8_t>
VerticesOnLines(const CellComplex & cells)
{
  std::vector<std::uint8_t> onLine(cells.vertexCount, 0);
  for (const auto & [from, to] : cells.edges)
  {
    onLine[from] = onLine[to] = 1;
  }
  for (const ElementIndex corner : cells.faceVertices)
  {
    onLine[corner] = 0;
  }
  return onLine;
}

// Of a part that is a line the pairs of a vertex may all lie on one side: those of its neighbours lie around it.
// Returns what was moved.
std::vector<ElementIndex>
RefinementState::MoveLines(const FootPointFinder & finder, const CorePart & part, const std::vector<Vector3> & wanted)
{
  const std::vector<std::uint8_t> onLine = VerticesOnLines(part.cells);
  std::vector<ElementIndex>       lines;
  for (std::size_t vertex = 0; vertex < part.vertices.size(); ++vertex)
  {
    if (onLine[vertex] != 0)
    {
      lines.push_back(static_cast<ElementIndex>(vertex));
    }
  }
  if (lines.empty())
  {
    return lines;
  }
  std::vector<std::uint8_t> isAsked = onLine; // and what is beside them
  for (const auto & [from, to] : part.cells.edges)
  {
    isAsked[from] |= onLine[to];
    isAsked[to] |= onLine[from];
  }
  std::vector<std::vector<ElementIndex>> near(part.vertices.size());
  for (const auto & [from, to] : part.cells.edges)
  {
    if (isAsked[from] != 0)
    {
      near[from].push_back(to);
    }
    if (isAsked[to] != 0)
    {
      near[to].push_back(from);
    }
  }
  const auto   count = static_cast<std::ptrdiff_t>(lines.size());
  FirstFailure failure;
#pragma omp parallel if (count > 64)
  {
    std::vector<FootPoint> footPoints;
    std::vector<PointPair> pairs;
#pragma omp for schedule(dynamic, 16)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      failure.Guard(static_cast<std::size_t>(i), [&] {
        const ElementIndex line = lines[static_cast<std::size_t>(i)];
        const ElementIndex vertex = part.vertices[line];
        pairs.clear();
        const auto add = [&](ElementIndex one) {
          const auto own = Pairs(part.vertices[one]);
          pairs.insert(pairs.end(), own.begin(), own.end());
        };
        add(line);
        for (const ElementIndex next : near[line])
        {
          add(next);
          std::for_each(near[next].begin(), near[next].end(), add);
        }
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        m_Displacement[vertex] = wanted[vertex];
        MoveInPasses(finder, vertex, pairs, footPoints);
      });
    }
  }
  failure.Rethrow();
  for (ElementIndex & vertex : lines)
  {
    vertex = part.vertices[vertex];
  }
  return lines;
}

std::vector<std::uint8_t>
OnWideSheets(const CellComplex & cells, const std::vector<Cofaces> & facesAtEdges)
{
  constexpr int             rings = 4;
  constexpr int             back = 7; // what stands out of a rim lies more than the rings from what is left
  std::vector<std::uint8_t> wide(cells.vertexCount, 1);
  for (std::size_t edge = 0; edge < facesAtEdges.size(); ++edge)
  {
    if (facesAtEdges[edge].count < 2)
    {
      wide[cells.edges[edge][0]] = wide[cells.edges[edge][1]] = 0;
    }
  }
  const auto spread = [&](std::uint8_t flag) {
    std::vector<std::uint8_t> next = wide;
    for (std::size_t edge = 0; edge < facesAtEdges.size(); ++edge)
    {
      const auto & [from, to] = cells.edges[edge];
      if (facesAtEdges[edge].count > 0 && (wide[from] == flag || wide[to] == flag))
      {
        next[from] = next[to] = flag;
      }
    }
    wide = std::move(next);
  };
  for (int ring = 1; ring < rings; ++ring)
  {
    spread(0);
  }
  for (int ring = 0; ring < back; ++ring)
  {
    spread(1);
  }
  return wide;
}

namespace
{

// A vertex of the rim of one sheet.
struct RimVertex
{
  ElementIndex           vertex = 0; ///< of the part
  Vector3                outwards{}; ///< mm, along its sheet; of any length
  std::vector<PointPair> pairs;      ///< of its triangles
};

std::vector<RimVertex>
RimVerticesOf(const CellComplex & cells, const std::vector<Cofaces> & facesAtEdges)
{
  std::vector<std::uint8_t> onWide = OnWideSheets(cells, facesAtEdges);
  std::vector<int>          rimEdges(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < facesAtEdges.size(); ++edge)
  {
    for (const ElementIndex end : cells.edges[edge])
    {
      rimEdges[end] += facesAtEdges[edge].count == 1 ? 1 : 0;
      onWide[end] = facesAtEdges[edge].count > 2 ? 0 : onWide[end];
    }
  }
  std::vector<RimVertex> rims;
  for (ElementIndex vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    if (rimEdges[vertex] == 2 && onWide[vertex] != 0)
    {
      rims.push_back({ vertex, {}, {} });
    }
  }
  return rims;
}

} // namespace

double
PartWithinAVoxel(const Vector3 & displacement, const Vector3 & step)
{
  constexpr double most = 1 - 1e-9;
  const double     a = Dot(step, step);
  const double     b = Dot(displacement, step);
  const double     c = Dot(displacement, displacement) - most * most;
  return c < 0 ? std::min(1.0, (std::sqrt(b * b - a * c) - b) / a) : 0;
}

// Triangles go as a whole, so that a rim lies up to the length of one behind the place where the measure falls below
// the threshold. Its vertices go there, or as far as they may. Returns what was moved.
std::vector<ElementIndex>
RefinementState::MoveRims(const FootPointFinder & finder, const CorePart & part, double threshold)
{
  const CellComplex &        cells = part.cells;
  const std::vector<Cofaces> facesAtEdges = CountEdgeCofaces(cells);
  std::vector<RimVertex>     rims = RimVerticesOf(cells, facesAtEdges);
  std::vector<RimVertex *>   rimAt(cells.vertexCount, nullptr);
  for (RimVertex & rim : rims)
  {
    rimAt[rim.vertex] = &rim;
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto corners = cells.FaceVertices(face);
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (RimVertex * const rim = rimAt[corners[k]])
      {
        rim->pairs.push_back(m_Pairs.All()[m_CornerWidths[3 * part.faces[face] + k]]);
      }
      if (facesAtEdges[cells.FaceEdges(face)[k]].count != 1)
      {
        continue;
      }
      const std::array<ElementIndex, 2> ends{ corners[k], corners[(k + 1) % 3] };
      const Vector3                     from = Place(part.vertices[ends[0]]);
      const Vector3                     way = Minus(Place(part.vertices[ends[1]]), from);
      const Vector3                     third = Minus(Place(part.vertices[corners[(k + 2) % 3]]), from);
      const Vector3 outwards = AddScaled(AddScaled({ 0, 0, 0 }, Dot(third, way), way), -Dot(way, way), third);
      const double  length = Length(outwards);
      for (const ElementIndex end : ends)
      {
        if (rimAt[end] != nullptr && length > 0)
        {
          rimAt[end]->outwards = AddScaled(rimAt[end]->outwards, 1 / length, outwards);
        }
      }
    }
  }
  std::vector<std::uint8_t> hasMoved(rims.size(), 0);
  const auto                count = static_cast<std::ptrdiff_t>(rims.size());
  FirstFailure              failure;
#pragma omp parallel for schedule(dynamic, 16) if (count > 64)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    failure.Guard(at, [&] {
      RimVertex & rim = rims[at];
      hasMoved[at] = MoveRimVertex(finder, threshold, part.vertices[rim.vertex], rim.outwards, rim.pairs) ? 1 : 0;
    });
  }
  failure.Rethrow();
  std::vector<ElementIndex> moved;
  for (std::size_t i = 0; i < rims.size(); ++i)
  {
    if (hasMoved[i] != 0)
    {
      moved.push_back(part.vertices[rims[i].vertex]);
    }
  }
  return moved;
}

// Along the sheet up to where its measure falls below the threshold, and then to where its balls touch alike, which
// lies beside it where the sheet is bent. A shorter way where there is no sheet.
bool
RefinementState::MoveRimVertex(const FootPointFinder &  finder,
                               double                   threshold,
                               ElementIndex             vertex,
                               const Vector3 &          outwards,
                               std::vector<PointPair> & pairs)
{
  constexpr int    halvings = 4;
  constexpr int    tries = 3;
  constexpr double straight = 1e-3; // of two unit vectors: else it is a tip, whose way is not known
  const double     length = Length(outwards);
  if (!(length > straight))
  {
    return false;
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<FootPoint> footPoints;
  std::vector<double>    widths(pairs.size());
  const Vector3          former = m_Displacement[vertex];
  const auto             isAbove = [&] {
    double swelling = 0;
    footPoints.clear();
    MeasureAt(finder, Place(vertex), pairs, footPoints, widths, swelling);
    return MeasureOf(widths) >= threshold;
  };
  const double  voxel = std::cbrt(m_Input.spacing[0] * m_Input.spacing[1] * m_Input.spacing[2]);
  const Vector3 way = Over(AddScaled({ 0, 0, 0 }, 2 * voxel / length, outwards), m_Input.spacing);
  const double  most = PartWithinAVoxel(former, way);
  const auto    goTo = [&](double far) {
    m_Displacement[vertex] = AddScaled(former, far, way);
    return ContainsInside(*m_Input.shape, AddScaled(m_Positions[vertex], 1, m_Displacement[vertex])) && isAbove();
  };
  double far = 0;
  if (isAbove())
  {
    double step = most;
    for (int halving = 0; far < most && halving <= halvings; ++halving)
    {
      far += goTo(far + step) ? step : 0;
      step *= 0.5;
    }
  }
  for (int i = 0; far > 0 && i < tries; ++i)
  {
    m_Displacement[vertex] = KeepInShape(*m_Input.shape, m_Positions[vertex], AddScaled(former, far, way));
    footPoints.clear();
    MoveVertex(finder, vertex, Pairs(vertex), footPoints);
    if (isAbove())
    {
      return true;
    }
    far *= 0.5;
  }
  m_Displacement[vertex] = former;
  return false;
}

} // namespace voxelcore
