#include "MoveGuard.h"

#include "voxelcore/Lattice/Vectors.h"


#include <algorithm>

namespace voxelcore
{

Vector3
KeepInShape(const VoxelShape & shape, const Vector3 & place, const Vector3 & displacement)
{
  constexpr int halvings = 8;
  Vector3       kept = displacement;
  const double  length = Length(kept);
  if (length > 1)
  {
    kept = AddScaled({ 0, 0, 0 }, (1 - 1e-9) / length, kept);
  }
  for (int i = 0; i < halvings; ++i)
  {
    if (ContainsInside(shape, AddScaled(place, 1, kept)))
    {
      return kept;
    }
    kept = AddScaled({ 0, 0, 0 }, 0.5, kept);
  }
  return { 0, 0, 0 };
}

namespace
{

class Guard
{
public:
  Guard(const VoxelShape &           shape,
        const CellComplex &          cells,
        const std::vector<Vector3> & positions,
        const Vector3 &              spacing,
        std::vector<Vector3> &       displacement)
    : m_Shape(shape)
    , m_Cells(cells)
    , m_Positions(positions)
    , m_Spacing(spacing)
    , m_Displacement(displacement)
    , m_Moved(positions.size(), 1)
    , m_Sum(positions.size())
    , m_Count(positions.size())
  {}

  void
  Run()
  {
    // What moves as one does not turn over, so corners of a triangle that does are first moved more alike. That keeps
    // the move; the last resort does not.
    constexpr int evening = 8;
    constexpr int halving = 8;
    for (int pass = 0;; ++pass)
    {
      if (!CollectTurned())
      {
        return;
      }
      for (std::size_t vertex = 0; vertex < m_Positions.size(); ++vertex)
      {
        m_Moved[vertex] = m_Count[vertex] > 0 ? 1 : 0;
        if (m_Count[vertex] == 0)
        {
          continue;
        }
        Vector3 & move = m_Displacement[vertex];
        if (pass < evening)
        {
          move =
            KeepInShape(m_Shape, m_Positions[vertex], AddScaled({ 0, 0, 0 }, 1.0 / m_Count[vertex], m_Sum[vertex]));
        }
        else if (pass < evening + halving)
        {
          move = KeepInShape(m_Shape, m_Positions[vertex], AddScaled({ 0, 0, 0 }, 0.5, move));
        }
        else
        {
          move = { 0, 0, 0 };
        }
      }
    }
  }

private:
  Vector3
  Normal(std::span<const ElementIndex> corners, bool moved) const
  {
    std::array<Vector3, 3> at;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector3 & place = m_Positions[corners[i]];
      at[i] = Times(moved ? AddScaled(place, 1, m_Displacement[corners[i]]) : place, m_Spacing);
    }
    return Cross(Minus(at[1], at[0]), Minus(at[2], at[0]));
  }

  // For each vertex of triangles that turned over, the sum of their mean moves; false when there are none.
  bool
  CollectTurned()
  {
    const auto                faces = static_cast<std::ptrdiff_t>(m_Cells.FaceCount());
    std::vector<std::uint8_t> turned(m_Cells.FaceCount(), 0);
#pragma omp parallel for schedule(static) if (faces > 4096)
    for (std::ptrdiff_t face = 0; face < faces; ++face)
    {
      const auto corners = m_Cells.FaceVertices(static_cast<std::size_t>(face));
      const bool again =
        std::any_of(corners.begin(), corners.end(), [&](ElementIndex corner) { return m_Moved[corner] != 0; });
      const bool moves = again && std::any_of(corners.begin(), corners.end(), [&](ElementIndex corner) {
                           return m_Displacement[corner] != Vector3{ 0, 0, 0 };
                         });
      turned[static_cast<std::size_t>(face)] = moves && !(Dot(Normal(corners, false), Normal(corners, true)) > 0);
    }
    std::fill(m_Sum.begin(), m_Sum.end(), Vector3{ 0, 0, 0 });
    std::fill(m_Count.begin(), m_Count.end(), 0);
    bool any = false;
    for (std::size_t face = 0; face < turned.size(); ++face)
    {
      if (turned[face] == 0)
      {
        continue;
      }
      any = true;
      Vector3 mean{ 0, 0, 0 };
      for (const ElementIndex corner : m_Cells.FaceVertices(face))
      {
        mean = AddScaled(mean, 1.0 / 3, m_Displacement[corner]);
      }
      for (const ElementIndex corner : m_Cells.FaceVertices(face))
      {
        m_Sum[corner] = AddScaled(m_Sum[corner], 1, mean);
        ++m_Count[corner];
      }
    }
    return any;
  }

  const VoxelShape &           m_Shape;
  const CellComplex &          m_Cells;
  const std::vector<Vector3> & m_Positions;
  const Vector3 &              m_Spacing;
  std::vector<Vector3> &       m_Displacement;
  std::vector<std::uint8_t>    m_Moved; ///< since triangles were last looked at
  std::vector<Vector3>         m_Sum;
  std::vector<int>             m_Count;
};

} // namespace

void
GuardMoves(const VoxelShape &           shape,
           const CellComplex &          cells,
           const std::vector<Vector3> & positions,
           const Vector3 &              spacing,
           std::vector<Vector3> &       displacement)
{
  Guard(shape, cells, positions, spacing, displacement).Run();
}

} // namespace voxelcore
