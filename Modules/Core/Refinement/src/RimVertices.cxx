#include "RimVertices.h"

#include <numeric>

namespace voxelcore
{

RimVertices::RimVertices(const CellComplex & cells, const std::vector<std::uint8_t> & faces)
  : m_FacesAtEdges(cells.edges.size(), 0)
{
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      m_FacesAtEdges[edge] += faces[face];
    }
  }
  std::vector<ElementIndex> at(cells.vertexCount, 0); // rim edges, and then its number among rim vertices and one
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (const ElementIndex end : cells.edges[edge])
    {
      at[end] += m_FacesAtEdges[edge] == 1 ? 1 : 0;
    }
  }
  for (ElementIndex vertex = 0; vertex < at.size(); ++vertex)
  {
    const bool isOnRim = at[vertex] == 2;
    if (isOnRim)
    {
      m_Vertices.push_back(vertex);
    }
    at[vertex] = isOnRim ? static_cast<ElementIndex>(m_Vertices.size()) : 0;
  }
  m_Ends.resize(m_Vertices.size());
  std::vector<std::uint8_t> found(m_Vertices.size(), 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (std::size_t k = 0; k < 2 && m_FacesAtEdges[edge] == 1; ++k)
    {
      if (const ElementIndex number = at[cells.edges[edge][k]])
      {
        m_Ends[number - 1][found[number - 1]++] = cells.edges[edge][1 - k];
      }
    }
  }
  const auto forCorners = [&](auto use) {
    for (ElementIndex face = 0; face < cells.FaceCount(); ++face)
    {
      for (const ElementIndex corner : cells.FaceVertices(face))
      {
        if (faces[face] != 0 && at[corner] != 0)
        {
          use(face, at[corner]);
        }
      }
    }
  };
  m_Offsets.assign(m_Vertices.size() + 1, 0);
  forCorners([&](ElementIndex, ElementIndex number) { ++m_Offsets[number]; });
  std::partial_sum(m_Offsets.begin(), m_Offsets.end(), m_Offsets.begin());
  m_Faces.resize(m_Offsets.back());
  std::vector<std::size_t> next(m_Offsets.begin(), m_Offsets.end() - 1);
  forCorners([&](ElementIndex face, ElementIndex number) { m_Faces[next[number - 1]++] = face; });
}

double
CosineOfTurn(const Vector3 & a, const Vector3 & v, const Vector3 & b)
{
  const Vector3 to = Minus(v, a);
  const Vector3 from = Minus(b, v);
  const double  lengths = Length(to) * Length(from);
  return lengths > 0 ? Dot(to, from) / lengths : 1;
}

} // namespace voxelcore
