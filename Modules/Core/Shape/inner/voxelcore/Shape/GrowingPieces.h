#pragma once
// The components of a shape while voxels are put in.

#include "voxelcore/Shape/PaddedShape.h"
#include "voxelcore/Shape/ShapeRuns.h"
#include "voxelcore/Shape/SimpleVoxel.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace voxelcore
{

/** Components, 6-connected, by one run of each; voxels as PaddedShape counts them. */
class GrowingPieces
{
public:
  explicit GrowingPieces(const VoxelShape & shape)
    : m_Runs(VoxelRuns(shape))
    , m_Components(UniteRuns(m_Runs, false))
    , m_RowsX(static_cast<std::uint64_t>(shape.Box().size[0]) + 2 * PaddedShape::kRoom)
    , m_RowsY(static_cast<std::uint64_t>(shape.Box().size[1]) + 2 * PaddedShape::kRoom)
  {}

  std::int64_t
  Count() const
  {
    return static_cast<std::int64_t>(m_Components.Count());
  }

  /** Sets of runs that touched over faces, edges or corners before any voxel was put in. */
  UnionFind
  Touching() const
  {
    return UniteRuns(m_Runs, true);
  }

  /** That of a voxel of the shape. */
  std::uint32_t
  Of(const Voxel & voxel)
  {
    return m_Components.Find(RunOf(voxel));
  }

  /** Those that a voxel would join, by the pieces around it (ShapePieces); none when two are of the same. */
  std::optional<std::vector<std::uint32_t>>
  Apart(const Voxel & voxel, const Pieces & pieces)
  {
    std::vector<std::uint32_t> components;
    for (std::size_t piece = 0; piece < pieces.count; ++piece)
    {
      const auto   faces = FaceNeighbours(voxel);
      const auto * next = std::find_if(faces.begin(), faces.end(), [&](const Voxel & face) {
        return pieces.sets[piece] >>
                 (face[0] - voxel[0] + 1 + 3 * (face[1] - voxel[1] + 1) + 9 * (face[2] - voxel[2] + 1)) &
               1U;
      });
      components.push_back(Of(*next));
    }
    std::vector<std::uint32_t> sorted = components;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() ? std::optional(components) : std::nullopt;
  }

  /** Joins components, of which Apart() was not none, over a voxel that is in the shape now. */
  void
  Join(const Voxel & voxel, const std::vector<std::uint32_t> & components)
  {
    for (const std::uint32_t component : components)
    {
      m_Components.Unite(components.front(), component);
    }
    m_Added[Index(voxel)] = components.front();
  }

  /** Forgets a voxel that joined nothing to its one component. */
  void
  Forget(const Voxel & voxel)
  {
    m_Added.erase(Index(voxel));
  }

private:
  std::uint32_t
  RunOf(const Voxel & voxel) const
  {
    if (const auto added = m_Added.find(Index(voxel)); added != m_Added.end())
    {
      return added->second;
    }
    constexpr std::int32_t room = PaddedShape::kRoom;
    const auto             row = static_cast<std::size_t>(voxel[2] - room) * static_cast<std::size_t>(m_Runs.rowsY) +
                     static_cast<std::size_t>(voxel[1] - room);
    const auto first = m_Runs.begin.begin() + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row]);
    const auto last = m_Runs.begin.begin() + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row + 1]);
    return static_cast<std::uint32_t>(std::upper_bound(first, last, voxel[0] - room) - m_Runs.begin.begin() - 1);
  }

  std::uint64_t
  Index(const Voxel & voxel) const
  {
    return (static_cast<std::uint64_t>(voxel[2]) * m_RowsY + static_cast<std::uint64_t>(voxel[1])) * m_RowsX +
           static_cast<std::uint64_t>(voxel[0]);
  }

  Runs          m_Runs;
  UnionFind     m_Components; ///< of runs
  std::uint64_t m_RowsX;
  std::uint64_t m_RowsY;

  std::unordered_map<std::uint64_t, std::uint32_t> m_Added; ///< voxels put in, with a run of their component
};

} // namespace voxelcore
