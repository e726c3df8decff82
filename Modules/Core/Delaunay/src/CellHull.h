#pragma once
// The facets of the convex hull of cospherical points.

#include "voxelcore/Lattice/LatticePoint.h"

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Polygons as indices into the points, each counter-clockwise seen from outside. */
struct HullFacets
{
  std::vector<std::uint32_t> offsets{ 0 };
  std::vector<std::uint32_t> corners;

  std::size_t
  Count() const
  {
    return offsets.size() - 1;
  }
  std::span<const std::uint32_t>
  Polygon(std::size_t facet) const
  {
    return { corners.data() + offsets[facet], corners.data() + offsets[facet + 1] };
  }
  void
  Clear()
  {
    offsets.resize(1);
    corners.clear();
  }
};

/** The hull of points on one sphere, at least four and not all in one plane; so every point is a corner of it.
 *  Coordinates may differ by up to 2^19; the volume of three differences stays below 2^62. */
HullFacets
ComputeHull(std::span<const LatticePoint> points);

/** Hulls of small point sets, remembered by relative coordinates. Not for use by two threads at once. */
class HullMemo
{
public:
  /** Polygons one after the other, each as the number of its corners and then the corners. */
  using Polygons = std::span<const std::uint16_t>;

  /** A point of a box of 64, as a number: they are in the order of z, y, x. */
  static std::uint32_t
  Pack(const LatticePoint & p)
  {
    return static_cast<std::uint32_t>(p.z << 14 | p.y << 7 | p.x);
  }

  /** The hull of packed points, ascending. Holds until the next call. */
  Polygons
  Get(std::span<const std::uint32_t> points);

private:
  struct Slot
  {
    std::uint64_t hash = 0;
    std::uint32_t key = 0;  // where in m_Keys
    std::uint32_t hull = 0; // where in m_Polygons
    std::uint16_t keySize = 0;
    std::uint16_t hullSize = 0; // 0: empty
  };

  std::vector<Slot>          m_Slots = std::vector<Slot>(1U << 12);
  std::size_t                m_Used = 0;
  std::vector<std::uint32_t> m_Keys;
  std::vector<std::uint16_t> m_Polygons;
  std::vector<LatticePoint>  m_Points;
  HullFacets                 m_Hull;
  std::vector<std::uint16_t> m_Last;
};

} // namespace voxelcore
