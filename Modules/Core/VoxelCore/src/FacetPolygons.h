#pragma once
// The points of the facets that a core's faces are made from.

#include "voxelcore/Base/SpentMemory.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Polygons one after the other. Where each begins takes four bytes, as it is counted from where its block of polygons
 *  begins. The points of a polygon are points of a lattice on one circle; these are few, so four bytes are enough. */
class FacetPolygons
{
public:
  FacetPolygons() = default;

  /** Of one offset more than there are polygons; they are given back on the way. */
  FacetPolygons(std::vector<std::uint64_t> offsets, std::vector<std::uint32_t> points)
    : m_Points(std::move(points))
  {
    constexpr std::size_t step = std::size_t{ 1 } << 20;
    SpentFront            spent(offsets);
    m_Starts.reserve(offsets.size());
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      if (i % kBlock == 0)
      {
        m_Blocks.push_back(offsets[i]);
      }
      m_Starts.push_back(static_cast<std::uint32_t>(offsets[i] - m_Blocks.back()));
      if ((i + 1) % step == 0)
      {
        spent.SpendTo(i + 1);
      }
    }
  }

  std::size_t
  Count() const
  {
    return m_Starts.size() - 1;
  }
  std::uint64_t
  Start(std::size_t polygon) const
  {
    return m_Blocks[polygon / kBlock] + m_Starts[polygon];
  }
  std::span<const std::uint32_t>
  operator[](std::size_t polygon) const
  {
    return { m_Points.data() + Start(polygon), m_Points.data() + Start(polygon + 1) };
  }
  std::span<std::uint32_t>
  operator[](std::size_t polygon)
  {
    return { m_Points.data() + Start(polygon), m_Points.data() + Start(polygon + 1) };
  }

  /** Arrays to be used up from their fronts on. */
  std::vector<std::uint32_t> &
  Starts()
  {
    return m_Starts;
  }
  std::vector<std::uint32_t> &
  Points()
  {
    return m_Points;
  }

private:
  static constexpr std::size_t kBlock = std::size_t{ 1 } << 16;

  std::vector<std::uint64_t> m_Blocks; ///< where each block begins
  std::vector<std::uint32_t> m_Starts;
  std::vector<std::uint32_t> m_Points;
};

} // namespace voxelcore
