#pragma once
// The facets of the convex hull of cospherical points.

#include "voxelcore/LatticePoint.h"

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace voxelcore
{

/** Polygons as indices into the points, each counter-clockwise seen from outside. */
struct HullFacets
{
  std::vector<std::uint16_t> offsets{ 0 };
  std::vector<std::uint16_t> corners;

  std::size_t
  Count() const
  {
    return offsets.size() - 1;
  }
  std::span<const std::uint16_t>
  Polygon(std::size_t facet) const
  {
    return { corners.data() + offsets[facet], corners.data() + offsets[facet + 1] };
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
  /** The hull of points sorted by (z, y, x), differing by less than 32 along each axis. The reference holds until the
   *  next call. */
  const HullFacets &
  Get(std::span<const LatticePoint> points);

private:
  struct Hash
  {
    std::size_t
    operator()(const std::u32string & key) const
    {
      std::uint64_t h = 0x9E3779B97F4A7C15U;
      for (const char32_t c : key)
      {
        h = (h ^ c) * 0xD6E8FEB86659FD93U;
        h ^= h >> 32;
      }
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<std::u32string, HullFacets, Hash> m_Hulls;
  std::u32string                                       m_Key;
  HullFacets                                           m_Last;
};

} // namespace voxelcore
