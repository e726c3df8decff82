#pragma once
// Where the rays along one axis through all centres cross a mesh.

#include "ExactTriangle.h"
#include "MeshSurface.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Centres of one ray with first <= index < end. */
struct RayRun
{
  std::int32_t inner;
  std::int32_t first;
  std::int32_t end;
};

/** What the rays of one plane say. */
struct PlaneRuns
{
  std::vector<RayRun> in;      ///< by all that was crossed before, from the low end
  std::vector<RayRun> inBack;  ///< the same from the high end; only by rule Votes
  std::vector<RayRun> several; ///< by rule Winding: winding number beyond what `in` means
};

/** The crossings of rays along an axis, a plane of them at a time: planes lie across `outer`, the greater of the other
 *  two axes. Planes of several slabs may be asked for at the same time by several threads. */
class AxisCrossings
{
public:
  static constexpr std::int64_t kSlab = 8; ///< planes that share a list of triangles

  AxisCrossings(const IndexMesh & mesh, const MeshSurface & surface, const VoxelGrid & grid, std::size_t axis);

  std::size_t
  SlabCount() const
  {
    return m_Offsets.size() - 1;
  }

  /** The runs of each plane of a slab, sorted by inner and first. */
  std::vector<PlaneRuns>
  Runs(std::size_t slab) const;

private:
  using Crossing = std::uint64_t; ///< inner, index, and whether the surface is left there, from high bits to low

  PlaneRuns
  RunsOfPlane(const std::vector<Crossing> & crossings) const;

  const IndexMesh &          m_Mesh;
  const MeshSurface &        m_Surface;
  std::size_t                m_Axis;
  std::int64_t               m_InnerSize;
  std::int64_t               m_OuterSize;
  std::int64_t               m_Length;
  std::vector<std::size_t>   m_Offsets;   ///< of a slab's triangles in m_Triangles
  std::vector<std::uint32_t> m_Triangles; ///< slab after slab
};

} // namespace voxelcore
