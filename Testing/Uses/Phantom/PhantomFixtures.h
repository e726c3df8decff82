#pragma once
// Short ways to ask for phantoms.

#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Phantom/RootScan.h"

#include <ostream>

namespace voxelcore::testing
{

inline PhantomOptions
Options(const std::string & kind, const std::array<std::int32_t, 3> & size, const Vector3 & spacing = { 1, 1, 1 })
{
  PhantomOptions options;
  options.kind = kind;
  options.size = size;
  options.spacing = spacing;
  return options;
}

inline bool
SameVoxels(const VoxelShape & a, const VoxelShape & b)
{
  bool same = a.Box().size == b.Box().size;
  for (std::int32_t z = 0; same && z < a.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; same && y < a.Box().size[1]; ++y)
    {
      const auto rowA = a.Row(y, z);
      const auto rowB = b.Row(y, z);
      same = std::equal(rowA.begin(), rowA.end(), rowB.begin(), rowB.end());
    }
  }
  return same;
}

/** A number that changes when any voxel does (FNV-1a over the words). */
inline std::uint64_t
Fingerprint(const VoxelShape & shape)
{
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        hash = (hash ^ word) * 0x100000001B3U;
        hash ^= hash >> 29;
      }
    }
  }
  return hash;
}

/** The voxels nearer to root than to air. */
inline VoxelShape
Brighter(const RootScan & scan, const PhantomOptions & root)
{
  VoxelShape  shape(VoxelBox{ { 0, 0, 0 }, root.size });
  std::size_t at = 0;
  for (std::int32_t z = 0; z < root.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < root.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < root.size[0]; ++x, ++at)
      {
        if (scan.values[at] >= (kRootScanAir + kRootScanRoot) / 2)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return shape;
}

} // namespace voxelcore::testing
