#include "RefinedTolerances.h"

#include "voxelcore/Error.h"
#include "voxelcore/ExtractPart.h"
#include "voxelcore/TolerancePruning.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

/** The faces at each vertex. */
class FacesAtVertices
{
public:
  explicit FacesAtVertices(const CellComplex & cells)
    : m_Cells(cells)
    , m_Offsets(cells.vertexCount + 1, 0)
    , m_Faces(cells.faceVertices.size())
  {
    for (const ElementIndex vertex : cells.faceVertices)
    {
      ++m_Offsets[vertex + 1];
    }
    std::partial_sum(m_Offsets.begin(), m_Offsets.end(), m_Offsets.begin());
    std::vector<std::size_t> next(m_Offsets.begin(), m_Offsets.end() - 1);
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      for (const ElementIndex vertex : cells.FaceVertices(face))
      {
        m_Faces[next[vertex]++] = static_cast<ElementIndex>(face);
      }
    }
  }

  /** Two polygons of a core share no three corners. */
  ElementIndex
  WithCorners(std::span<const ElementIndex> corners) const
  {
    const auto first = m_Faces.begin() + static_cast<std::ptrdiff_t>(m_Offsets[corners[0]]);
    const auto last = m_Faces.begin() + static_cast<std::ptrdiff_t>(m_Offsets[corners[0] + 1]);
    const auto found = std::find_if(first, last, [&](ElementIndex face) {
      const auto own = m_Cells.FaceVertices(face);
      return std::all_of(corners.begin() + 1, corners.end(), [&](ElementIndex corner) {
        return std::find(own.begin(), own.end(), corner) != own.end();
      });
    });
    if (found == last)
    {
      throw Error("a refined core has a triangle that is part of no face");
    }
    return *found;
  }

private:
  const CellComplex &       m_Cells;
  std::vector<std::size_t>  m_Offsets;
  std::vector<ElementIndex> m_Faces;
};

} // namespace

ToleranceValues
TolerancesOfTriangles(const CellComplex & triangles, const MedialComplex & whole, double height)
{
  PartElements      left;
  const CellComplex polygons =
    ExtractLive(whole.cells, LeftByTolerance(whole, height), left.vertices, left.edges, left.faces);
  if (polygons.vertexCount != triangles.vertexCount)
  {
    throw Error("a refined core has other vertices than its tolerance leaves");
  }
  ToleranceValues       values;
  const FacesAtVertices faces(polygons);
  values.vertices.reserve(left.vertices.size());
  for (const ElementIndex vertex : left.vertices)
  {
    values.vertices.push_back(whole.tolerances.vertices[vertex]);
  }
  values.faces.resize(triangles.FaceCount());
  values.edges.resize(triangles.edges.size());
  for (std::size_t face = 0; face < values.faces.size(); ++face)
  {
    values.faces[face] = whole.tolerances.faces[left.faces[faces.WithCorners(triangles.FaceVertices(face))]];
    for (const ElementIndex edge : triangles.FaceEdges(face))
    {
      values.edges[edge] = values.faces[face];
    }
  }
  // Those that are no cuts are edges of the core.
  std::size_t edge = 0;
  for (std::size_t own = 0; own < polygons.edges.size(); ++own)
  {
    while (edge < values.edges.size() && triangles.edges[edge] < polygons.edges[own])
    {
      ++edge;
    }
    if (edge == values.edges.size() || triangles.edges[edge] != polygons.edges[own])
    {
      throw Error("a refined core lacks an edge that its tolerance leaves");
    }
    values.edges[edge] = whole.tolerances.edges[left.edges[own]];
  }
  return values;
}

} // namespace voxelcore
