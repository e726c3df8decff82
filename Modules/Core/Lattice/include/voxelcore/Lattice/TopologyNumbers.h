#pragma once
// The numbers a certificate compares.

#include <array>
#include <cstdint>

namespace voxelcore
{

/** Euler number and Betti numbers: components (b0), independent loops (b1), cavities (b2). euler = b0 - b1 + b2. */
struct TopologyNumbers
{
  std::int64_t                euler = 0;
  std::array<std::int64_t, 3> betti{ 0, 0, 0 };

  friend bool
  operator==(const TopologyNumbers &, const TopologyNumbers &) = default;
};

} // namespace voxelcore
