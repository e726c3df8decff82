#pragma once
// The branches of a root system as they grow: lines with radii, in mm.

#include "RoundCone.h"

namespace voxelcore
{

/** A point of a growing root. */
struct GrownPoint : ConeEnd
{
  std::int64_t parent = -1;
  std::int32_t branch = 0;
  std::int32_t order = 0;
};

/** Where a branch touches another; in mm. */
struct GrownContact
{
  Vector3                     position{};
  std::array<std::int32_t, 2> branches{};
};

struct GrownRoot
{
  std::vector<GrownPoint>   points;
  std::vector<GrownContact> contacts;
};

/** Stem, laterals and their laterals. Depends on the sides of the grid and the options alone (and on the spacing where
 *  no detail is given). \throws UsageError when not even the stem fits. */
GrownRoot
GrowRoot(const PhantomOptions & options);

} // namespace voxelcore
