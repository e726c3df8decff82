// Whether anything is missing beside a vertex that is there. The set of a vertex spans its Delaunay cell. Each facet of
// the cell that is no boundary square leads to another cell inside the shape, so the core has an edge there; each edge
// of the cell that does not lie on the boundary is dual to a face of the core with this corner (Theorem 3.1 and
// Corollary 3.8). Cells of a component of the shape hang together by facets: a core that is complete at each vertex and
// has as many components as the shape is the whole core.
#include "CellFacets.h"
#include "Checks.h"

#include <bit>

namespace voxelcore::verification
{
namespace
{

/** For each vertex, the edges that end there or the faces that have it as a corner. */
struct Cofaces
{
  std::vector<std::uint64_t> offsets;
  std::vector<ElementIndex>  elements;

  std::span<const ElementIndex>
  Of(std::size_t vertex) const
  {
    return { elements.data() + offsets[vertex], elements.data() + offsets[vertex + 1] };
  }
};

/** `corners(i)` lists the vertices of element i. */
template <typename Corners>
Cofaces
FindCofaces(std::size_t vertexCount, std::size_t elementCount, Corners corners)
{
  Cofaces cofaces;
  cofaces.offsets.assign(vertexCount + 2, 0);
  for (std::size_t i = 0; i < elementCount; ++i)
  {
    for (const ElementIndex v : corners(i))
    {
      ++cofaces.offsets[v + 2];
    }
  }
  for (std::size_t v = 0; v < vertexCount; ++v)
  {
    cofaces.offsets[v + 2] += cofaces.offsets[v + 1];
  }
  cofaces.elements.resize(cofaces.offsets.back());
  for (std::size_t i = 0; i < elementCount; ++i)
  {
    for (const ElementIndex v : corners(i))
    {
      cofaces.elements[cofaces.offsets[v + 1]++] = static_cast<ElementIndex>(i);
    }
  }
  return cofaces;
}

std::array<std::int32_t, 3>
AsArray(const LatticePoint & p)
{
  return { p.x, p.y, p.z };
}

/** Whether a facet is a boundary square: a unit square with one of its two voxels in. */
bool
IsBoundarySquare(const VoxelShape & shape, std::span<const LatticePoint> facet)
{
  if (facet.size() != 4)
  {
    return false;
  }
  std::array<std::int32_t, 3> lower = AsArray(facet[0]);
  std::array<std::int32_t, 3> upper = lower;
  for (const LatticePoint & point : facet)
  {
    const auto p = AsArray(point);
    for (std::size_t a = 0; a < 3; ++a)
    {
      lower[a] = std::min(lower[a], p[a]);
      upper[a] = std::max(upper[a], p[a]);
    }
  }
  std::size_t flat = 3;
  int         extent = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    flat = lower[a] == upper[a] ? a : flat;
    extent += upper[a] - lower[a] > 1 ? 3 : upper[a] - lower[a];
  }
  if (flat == 3 || extent != 2)
  {
    return false;
  }
  const bool above = shape.Contains(lower[0], lower[1], lower[2]);
  --lower[flat];
  return above != shape.Contains(lower[0], lower[1], lower[2]);
}

/** Whether a cell's edge lies on the boundary: a unit edge with one of its four voxels out. */
bool
IsBoundaryEdge(const VoxelShape & shape, const LatticePoint & a, const LatticePoint & b)
{
  const auto  p = AsArray(std::min(a, b));
  const auto  q = AsArray(std::max(a, b));
  std::size_t along = 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int32_t d = q[axis] - p[axis];
    if (d != 0 && (d != 1 || along != 3))
    {
      return false;
    }
    along = d == 1 ? axis : along;
  }
  const std::size_t s = (along + 1) % 3;
  const std::size_t t = (along + 2) % 3;
  for (std::int32_t i = 0; i < 2; ++i)
  {
    for (std::int32_t j = 0; j < 2; ++j)
    {
      auto voxel = p;
      voxel[s] -= i;
      voxel[t] -= j;
      if (!shape.Contains(voxel[0], voxel[1], voxel[2]))
      {
        return true;
      }
    }
  }
  return false;
}

/** Compares the Delaunay cell of one vertex with the edges and faces the complex has there. */
class CellComparison
{
public:
  CellComparison(const Subject & subject, const Cofaces & edges, const Cofaces & faces)
    : m_Subject(subject)
    , m_Edges(edges)
    , m_Faces(faces)
    , m_Threshold(subject.input.threshold.value_or(0.0) * (1 + kMeasureTolerance))
  {}

  /** What is missing at the vertex; empty when nothing is. */
  std::string
  FirstMissing(std::size_t vertex)
  {
    const auto set = m_Subject.sets.Of(vertex);
    m_Points.clear();
    for (const std::uint32_t place : set)
    {
      m_Points.push_back(m_Subject.Point(place));
    }
    FindFacets(m_Points, m_Facets);
    FindEdgeMasks(vertex, set);
    for (std::size_t f = 0; f < m_Facets.Count(); ++f)
    {
      const auto mask = m_Facets.Mask(f);
      if (!HasEdge(mask) && IsEdgeExpected(mask, set))
      {
        return "the edge across the facet with boundary vertex " + Describe(m_Members.front());
      }
    }
    for (std::size_t f = 0; f < m_Facets.Count(); ++f)
    {
      for (std::size_t g = f + 1; g < m_Facets.Count(); ++g)
      {
        std::array<std::uint32_t, 2> shared{};
        if (!ShareTwo(m_Facets.Mask(f), m_Facets.Mask(g), set, shared))
        {
          continue;
        }
        if (!HasFace(vertex, shared) && IsFaceExpected(shared))
        {
          return "the face between boundary vertices " + Describe(m_Subject.Point(shared[0])) + " and " +
                 Describe(m_Subject.Point(shared[1]));
        }
      }
    }
    return {};
  }

private:
  void
  FindEdgeMasks(std::size_t vertex, std::span<const std::uint32_t> set)
  {
    m_EdgeMasks.clear();
    for (const ElementIndex edge : m_Edges.Of(vertex))
    {
      const auto & ends = m_Subject.cells.edges[edge];
      const auto   other = m_Subject.sets.Of(ends[0] == vertex ? ends[1] : ends[0]);
      const auto   start = m_EdgeMasks.size();
      m_EdgeMasks.resize(start + m_Facets.stride, 0);
      for (std::size_t i = 0; i < set.size(); ++i)
      {
        if (std::binary_search(other.begin(), other.end(), set[i]))
        {
          m_EdgeMasks[start + i / 64] |= std::uint64_t{ 1 } << (i % 64);
        }
      }
    }
  }

  bool
  HasEdge(std::span<const std::uint64_t> mask) const
  {
    for (std::size_t start = 0; start < m_EdgeMasks.size(); start += m_Facets.stride)
    {
      if (std::equal(mask.begin(), mask.end(), m_EdgeMasks.begin() + static_cast<std::ptrdiff_t>(start)))
      {
        return true;
      }
    }
    return false;
  }

  bool
  IsEdgeExpected(std::span<const std::uint64_t> mask, std::span<const std::uint32_t> set)
  {
    m_Members.clear();
    m_Places.clear();
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      if (((mask[i / 64] >> (i % 64)) & 1U) != 0)
      {
        m_Members.push_back(m_Points[i]);
        m_Places.push_back(set[i]);
      }
    }
    return !IsBoundarySquare(*m_Subject.input.shape, m_Members) &&
           (m_Threshold <= 0 || MeasureOf(m_Subject, m_Places) >= m_Threshold);
  }

  /** Two facets of a cell meet in an edge when they share two points. */
  static bool
  ShareTwo(std::span<const std::uint64_t> f,
           std::span<const std::uint64_t> g,
           std::span<const std::uint32_t> set,
           std::array<std::uint32_t, 2> & shared)
  {
    std::size_t count = 0;
    for (std::size_t word = 0; word < f.size(); ++word)
    {
      for (std::uint64_t bits = f[word] & g[word]; bits != 0; bits &= bits - 1)
      {
        if (count == 2)
        {
          return false;
        }
        shared[count++] = set[word * 64 + static_cast<std::size_t>(std::countr_zero(bits))];
      }
    }
    return count == 2;
  }

  bool
  HasFace(std::size_t vertex, const std::array<std::uint32_t, 2> & ends) const
  {
    const auto faces = m_Faces.Of(vertex);
    return std::any_of(faces.begin(), faces.end(), [&](ElementIndex face) {
      return m_Subject.dualEdges[face] == ends;
    });
  }

  bool
  IsFaceExpected(const std::array<std::uint32_t, 2> & ends) const
  {
    return !IsBoundaryEdge(*m_Subject.input.shape, m_Subject.Point(ends[0]), m_Subject.Point(ends[1])) &&
           (m_Threshold <= 0 || HalfDistance(m_Subject, ends[0], ends[1]) >= m_Threshold);
  }

  const Subject &            m_Subject;
  const Cofaces &            m_Edges;
  const Cofaces &            m_Faces;
  double                     m_Threshold;
  CellFacets                 m_Facets;
  std::vector<LatticePoint>  m_Points;
  std::vector<std::uint64_t> m_EdgeMasks;
  std::vector<LatticePoint>  m_Members;
  std::vector<std::uint32_t> m_Places;
};

} // namespace

void
CheckCompleteness(VerificationReport & report, const Subject & subject)
{
  const CellComplex & cells = subject.cells;
  const Cofaces       edges = FindCofaces(cells.vertexCount, cells.edges.size(), [&](std::size_t e) {
    return std::span<const ElementIndex>(cells.edges[e]);
  });
  const Cofaces       faces =
    FindCofaces(cells.vertexCount, cells.FaceCount(), [&](std::size_t f) { return cells.FaceVertices(f); });
  AddCheck(
    report,
    "completeness",
    cells.vertexCount,
    [&](std::size_t v) {
      return subject.sets.IsKnown(v) && !CellComparison(subject, edges, faces).FirstMissing(v).empty();
    },
    [&](std::size_t v) {
      return "At " + DescribeVertex(subject, v) + " misses " + CellComparison(subject, edges, faces).FirstMissing(v) +
             ".";
    });
}

} // namespace voxelcore::verification
